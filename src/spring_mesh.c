/*
 * Meshes: an entangled network solved as a whole, by implicit Euler. With x the velocity changes of its bodies,
 *
 *     (M + sum w g g^T) x = -sum w g (B C* + D u),    w = k h^2 + c h,  B = k h^2 / w,  D = c h / w,
 *
 * g being the spring's direction in the rows of its ends, C* the elongation foreseen for the end of the sub-step and u
 * the velocity along the spring. The matrix is symmetric and positive: Cholesky's factors, kept from the first entry of
 * each row on (an envelope: what lies before it stays zero). They are made anew only when springs have turned.
 *
 * In fixed point everything is at most 1: a body's rows are scaled by 1 / sqrt(m + sum w), so that the diagonal is at most 1,
 * and so are the factors, whose rows are no longer than the diagonal's root. The scales depend on masses and stiffness only.
 * The right side is lifted to a common size before it is solved for, so that small errors keep their bits: its solution
 * half way, y, is no longer than the springs' pulls.
 */
#include "spring_web.h"

/* The least square on the factors' diagonal; what is below it is rounding. */
#define PIVOT_MIN CAIRN_SHARE(2.4e-7)

/* ---- the factors ---- */

/* A spring's direction in the rows of its ends. */
typedef struct line {
    int count;
    uint16_t row[6];
    cairn_share g[6];
} line;

CAIRN_ONCE void add_to(line *l, int row, cairn_share g)
{
    l->row[l->count] = (uint16_t)row;
    l->g[l->count++] = g;
}

static void make_line(const cairn_web *w, const cairn_mesh_link *link, line *l)
{
    const cairn_spring *spring = cairn_web_spring(w, link);
    l->count = 0;
    for (int k = 0; k < 2; k++) {
        if (link->node[k] == CAIRN_NONE) {
            continue;
        }
        const cairn_mesh_node *node = &w->mesh->nodes[link->node[k]];
        cairn_share shift = k == 0 ? -link->shift[k] : link->shift[k], turn = k == 0 ? -link->turn[k] : link->turn[k];
        if (node->shifts > 0) {
            add_to(l, node->row, cairn_motion_dir(shift, spring->direction_x));
            add_to(l, node->row + 1, cairn_motion_dir(shift, spring->direction_y));
        }
        if (node->turns > 0) {
            add_to(l, node->row + node->shifts, cairn_motion_lever(turn, k == 0 ? spring->lever_a : spring->lever_b));
        }
    }
}

/* The matrix: its diagonal in the rows' values until it is factorised. */
static void assemble(const cairn_web *w)
{
    cairn_mesh *mesh = w->mesh;
    for (const cairn_mesh_node *node = w->nodes; node != w->node_end; node++) {
        for (int k = 0; k < cairn_mesh_rows_of(node); k++) {
            cairn_mesh_row *row = &mesh->rows[node->row + k];
            row->value = k < node->shifts ? node->mass : node->inertia;
            cairn_clear(&mesh->entries[row->entries], (size_t)(node->row + k - row->first) * sizeof(cairn_share));
        }
    }
    for (const cairn_mesh_link *link = w->links; link != w->link_end; link++) {
        line l;
        make_line(w, link, &l);
        for (int p = 0; p < l.count; p++) {
            cairn_mesh_row *row = &mesh->rows[l.row[p]];
            for (int q = 0; q < l.count; q++) {
                if (l.row[q] <= l.row[p]) {
                    cairn_share *entry = q == p ? &row->value : &mesh->entries[row->entries + l.row[q] - row->first];
                    *entry += cairn_share_mul(l.g[p], l.g[q]);
                }
            }
        }
    }
}

/* The sum so far less the products of two rows' entries before the column of the second one. */
static cairn_sum less_products(cairn_sum sum, const cairn_web *w, const cairn_mesh_row *p, const cairn_mesh_row *q)
{
    int from = p->first > q->first ? p->first : q->first;
    const cairn_share *a = &w->mesh->entries[p->entries + (uint32_t)(from - p->first)];
    const cairn_share *b = &w->mesh->entries[q->entries + (uint32_t)(from - q->first)];
    for (int k = (int)(q - w->mesh->rows) - from; k > 0; k--) {
        sum = cairn_sum_less(sum, *a++, *b++);
    }
    return sum;
}

CAIRN_ONCE void factorise(const cairn_web *w)
{
    assemble(w);
    for (cairn_mesh_row *row = w->rows; row != w->row_end; row++) {
        cairn_share *entry = &w->mesh->entries[row->entries];
        for (const cairn_mesh_row *column = &w->mesh->rows[row->first]; column != row; column++, entry++) {
            *entry = cairn_motion_scale(cairn_sum_share(less_products(cairn_sum_of(*entry), w, row, column)), column->inverse);
        }
        cairn_share left = cairn_sum_share(less_products(cairn_sum_of(row->value), w, row, row));
        left = left < PIVOT_MIN ? PIVOT_MIN : left;
        row->inverse = cairn_wide_inverse(cairn_wide_sqrt(cairn_wide_from_share(left)));
    }
    w->part->turned = 0;
}

/* ---- the sub-step ---- */

/* The springs' pulls: sqrt(w) (B C* + D u); their greatest size. */
static cairn_motion ask(const cairn_web *w)
{
    cairn_motion most = 0;
    cairn_turn turn = 0;
    for (cairn_mesh_link *link = w->links; link != w->link_end; link++) {
        cairn_spring *spring = cairn_web_spring(w, link);
        const cairn_body *a = &w->world->bodies[spring->a], *b = &w->world->bodies[spring->b];
        cairn_turn turned;
        cairn_offset length = cairn_spring_aim(spring, a, b, true, &turned);
        turn = turned > turn ? turned : turn;
        link->pull = cairn_motion_from_offset_wide(length - spring->rest_length, link->position_gain);
        if (link->velocity_gain != 0) {
            link->pull = cairn_motion_add(link->pull, cairn_motion_share(cairn_spring_speed(spring, a, b), link->velocity_gain));
        }
        most = link->pull > most ? link->pull : -link->pull > most ? -link->pull : most;
    }
    w->part->turned += cairn_unit_from_turn(turn);
    return most;
}

CAIRN_ONCE void pull(const cairn_web *w, int lift)
{
    for (cairn_mesh_row *row = w->rows; row != w->row_end; row++) {
        row->value = 0;
    }
    for (const cairn_mesh_link *link = w->links; link != w->link_end; link++) {
        line l;
        cairn_motion pull = cairn_motion_lift(link->pull, lift);
        make_line(w, link, &l);
        for (int p = 0; p < l.count; p++) {
            w->mesh->rows[l.row[p]].value -= cairn_motion_share(pull, l.g[p]);
        }
    }
}

/* Forwards by the factors, backwards by their transpose. */
CAIRN_ONCE void substitute(const cairn_web *w)
{
    for (cairn_mesh_row *row = w->rows; row != w->row_end; row++) {
        const cairn_share *entry = &w->mesh->entries[row->entries];
        cairn_sum sum = cairn_sum_of(row->value);
        for (const cairn_mesh_row *before = &w->mesh->rows[row->first]; before != row; before++) {
            sum = cairn_sum_less(sum, *entry++, before->value);
        }
        row->value = cairn_motion_clamp(cairn_motion_scale(cairn_sum_share(sum), row->inverse), CAIRN_MOTION_LIFTED);
    }
    for (cairn_mesh_row *row = w->row_end; row-- != w->rows;) {
        const cairn_share *entry = &w->mesh->entries[row->entries];
        row->value = cairn_motion_scale(row->value, row->inverse);
        for (cairn_mesh_row *before = &w->mesh->rows[row->first]; before != row; before++) {
            before->value = cairn_motion_add(before->value, -cairn_motion_share(row->value, *entry++));
        }
    }
}

static void apply(const cairn_web *w, int lift)
{
    for (const cairn_mesh_node *node = w->nodes; node != w->node_end; node++) {
        const cairn_mesh_row *row = &w->mesh->rows[node->row];
        cairn_motion x = 0, y = 0, turn = 0;
        if (node->shifts > 0) {
            x = cairn_motion_lower(row++->value, node->scale, lift);
            y = cairn_motion_lower(row++->value, node->scale, lift);
        }
        if (node->turns > 0) {
            turn = cairn_motion_lower(row->value, node->turning, lift);
        }
        cairn_spring_push(&w->world->bodies[node->body], x, y, turn);
    }
}

static bool is_active(const cairn_web *w)
{
    for (const cairn_mesh_link *link = w->links; link != w->link_end; link++) {
        if (cairn_spring_is_active(w->world, cairn_web_spring(w, link))) {
            return true;
        }
    }
    return false;
}

static void solve(cairn_world *world, int substep)
{
    cairn_mesh *mesh = world->springs->mesh;
    for (uint16_t i = 0; i < mesh->part_count; i++) {
        cairn_web w;
        cairn_web_find(world, &mesh->parts[i], &w);
        if (!is_active(&w)) {
            continue;
        }
        cairn_motion most = ask(&w);
        if (w.part->turned > w.part->stale || (w.part->has_levers && substep == 0)) {
            factorise(&w);
        }
        int lift = cairn_motion_headroom(most);
        pull(&w, lift);
        substitute(&w);
        apply(&w, lift);
    }
}

static const cairn_mesh_class class_of_meshes = { cairn_meshes_make, solve };

cairn_status cairn_meshes_enable(cairn_world *world, const cairn_mesh_storage *storage)
{
    if (world == NULL) {
        return CAIRN_ERROR_NULL;
    }
    if (storage == NULL || storage->mesh == NULL || storage->parts == NULL || storage->nodes == NULL || storage->rows == NULL
        || storage->links == NULL || storage->entries == NULL) {
        return cairn_fail(world, CAIRN_ERROR_NULL);
    }
    if (world->locked) {
        return cairn_fail(world, CAIRN_ERROR_LOCKED);
    }
    if (world->springs == NULL || world->springs->mesh != NULL) {
        return cairn_fail(world, CAIRN_ERROR_KIND);
    }
    if (storage->bodies == 0 || storage->bodies > 20000 || storage->springs == 0 || storage->springs > 65000) {
        return cairn_fail(world, CAIRN_ERROR_RANGE);
    }
    cairn_mesh *mesh = storage->mesh;
    cairn_clear(mesh, sizeof *mesh);
    mesh->kind = &class_of_meshes;
    mesh->parts = storage->parts;
    mesh->nodes = storage->nodes;
    mesh->rows = storage->rows;
    mesh->links = storage->links;
    mesh->entries = storage->entries;
    mesh->body_capacity = storage->bodies;
    mesh->link_capacity = storage->springs;
    mesh->entry_capacity = storage->entry_count;
    world->springs->mesh = mesh;
    world->springs->changed = true;
    return CAIRN_OK;
}
