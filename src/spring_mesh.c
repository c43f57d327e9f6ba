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
#include "spring_solve.h"
#include <cairn/spring_mesh.h>

/* Beyond this stiffness in units of the reduced mass a spring is a rod: as in spring_map.c. */
#define STIFFNESS_MAX cairn_wide_from_int(4096)
/*
 * The factors are made anew when the springs may have turned by the least body's sqrt(m / (m + sum w)), over this. Old
 * directions resist, with all of the springs' stiffness, what turns the mesh as a whole: w (turn)^2 has to stay small against m.
 */
#define STALE 8
/* The least square on the factors' diagonal; what is below it is rounding. */
#define PIVOT_MIN CAIRN_SHARE(2.4e-7)
/* The most entries of a row: keeps the sums of their products in 64 bits. */
enum { ROW_MAX = 255 };

/* A part, and where it lies in the memory. */
typedef struct web {
    cairn_world *world;
    cairn_mesh *mesh;
    cairn_mesh_part *part;
    cairn_mesh_node *nodes, *node_end;
    cairn_mesh_row *rows, *row_end;
    cairn_mesh_link *links, *link_end;
} web;

CAIRN_ONCE web web_of(cairn_world *world, cairn_mesh_part *part)
{
    web w;
    w.world = world;
    w.mesh = world->springs->mesh;
    w.part = part;
    w.nodes = w.mesh->nodes + part->node;
    w.node_end = w.nodes + part->nodes;
    w.rows = w.mesh->rows + part->row;
    w.row_end = w.rows + part->rows;
    w.links = w.mesh->links + part->link;
    w.link_end = w.links + part->links;
    return w;
}

CAIRN_ONCE cairn_spring *spring_of(const web *w, const cairn_mesh_link *link) { return &w->world->springs->springs[link->spring]; }
CAIRN_ONCE const cairn_body *body_of(const web *w, const cairn_mesh_node *node) { return &w->world->bodies[node->body]; }

/* ---- which bodies, in which order ---- */

static uint16_t node_of(const web *w, uint16_t body)
{
    for (const cairn_mesh_node *node = w->nodes; node != w->node_end; node++) {
        if (node->body == body) {
            return (uint16_t)(node - w->mesh->nodes);
        }
    }
    return CAIRN_NONE;
}

static bool add_node(web *w, uint16_t body)
{
    if (!cairn_body_is_dynamic(&w->world->bodies[body]) || node_of(w, body) != CAIRN_NONE) {
        return true;
    }
    if (w->node_end == w->mesh->nodes + w->mesh->body_capacity) {
        return false;
    }
    cairn_clear(w->node_end, sizeof *w->node_end);
    w->node_end++->body = body;
    return true;
}

static bool collect(web *w)
{
    const cairn_spring_pool *pool = w->world->springs;
    for (uint16_t i = w->part->network; i < pool->end; i++) {
        const cairn_spring *spring = &pool->springs[i];
        if (!cairn_spring_is_used(spring) || spring->network != w->part->network) {
            continue;
        }
        if (w->link_end == w->mesh->links + w->mesh->link_capacity || !add_node(w, spring->a) || !add_node(w, spring->b)) {
            return false;
        }
        w->link_end++->spring = i;
        w->part->has_levers = w->part->has_levers || cairn_spring_is_off_centre(spring);
    }
    w->part->nodes = (uint16_t)(w->node_end - w->nodes);
    w->part->links = (uint16_t)(w->link_end - w->links);
    return true;
}

/* The node that a link goes to from another one, CAIRN_NONE if it does not begin there or goes to none. */
static uint16_t across(const cairn_mesh_link *link, uint16_t node)
{
    return link->node[0] == node ? link->node[1] : link->node[1] == node ? link->node[0] : (uint16_t)CAIRN_NONE;
}

/* The first of the nodes that a node is linked to, itself included. */
static uint16_t first_neighbour(const web *w, const cairn_mesh_node *node)
{
    uint16_t place = (uint16_t)(node - w->mesh->nodes), first = place;
    for (const cairn_mesh_link *link = w->links; link != w->link_end; link++) {
        uint16_t other = across(link, place);
        first = other < first ? other : first;
    }
    return first;
}

/* Put the nodes in the order of their ranks, of which nothing is known yet but their bodies; how far the entries then reach. */
static uint32_t arrange(const web *w)
{
    uint32_t size = 0;
    for (cairn_mesh_node *node = w->nodes; node != w->node_end; node++) {
        uint16_t body = node->body, rank = node->rank;
        cairn_mesh_node *k = node;
        for (; k != w->nodes && k[-1].rank > rank; k--) {
            k->body = k[-1].body;
            k->rank = k[-1].rank;
        }
        k->body = body;
        k->rank = rank;
    }
    for (cairn_mesh_link *link = w->links; link != w->link_end; link++) {
        link->node[0] = node_of(w, spring_of(w, link)->a);
        link->node[1] = node_of(w, spring_of(w, link)->b);
    }
    for (const cairn_mesh_node *node = w->nodes; node != w->node_end; node++) {
        size += (uint32_t)(node - w->mesh->nodes) - first_neighbour(w, node);
    }
    return size;
}

CAIRN_ONCE uint32_t arrange_by_bodies(const web *w)
{
    for (cairn_mesh_node *node = w->nodes; node != w->node_end; node++) {
        node->rank = node->body;
    }
    return arrange(w);
}

/* Number the nodes in rings about one of them; the last that was reached. */
static cairn_mesh_node *rank_from(const web *w, cairn_mesh_node *start)
{
    uint16_t count = 1;
    for (cairn_mesh_node *node = w->nodes; node != w->node_end; node++) {
        node->rank = CAIRN_NONE;
    }
    start->rank = 0;
    for (uint16_t rank = 0; rank < count; rank++) {
        start = w->nodes;
        while (start->rank != rank) {
            start++;
        }
        for (const cairn_mesh_link *link = w->links; link != w->link_end; link++) {
            uint16_t other = across(link, (uint16_t)(start - w->mesh->nodes));
            if (other != CAIRN_NONE && w->mesh->nodes[other].rank == CAIRN_NONE) {
                w->mesh->nodes[other].rank = count++;
            }
        }
    }
    return start;
}

/* By the bodies' own order, or in rings about an end of the network (Cuthill and McKee), whichever has fewer entries. */
static void order(const web *w)
{
    uint32_t plain = arrange_by_bodies(w);
    rank_from(w, rank_from(w, w->nodes));
    if (arrange(w) >= plain) {
        arrange_by_bodies(w);
    }
}

/* ---- weights and scales ---- */

static cairn_wide least(cairn_wide a, cairn_wide b) { return cairn_wide_less(b, a) ? b : a; }
static cairn_wide square(cairn_wide a) { return cairn_wide_mul(a, a); }

/* The square of an anchor's greatest lever, at least 1. */
static cairn_wide leverage(const cairn_body *body, const cairn_offset2 *anchor)
{
    cairn_wide one = cairn_wide_from_int(1);
    cairn_wide arm = cairn_wide_add(square(cairn_wide_from_offset(anchor->x)), square(cairn_wide_from_offset(anchor->y)));
    cairn_wide lever = cairn_wide_mul(arm, square(cairn_body_inverse_gyration(body)));
    return cairn_wide_less(lever, one) ? one : lever;
}

/* k h^2 or c h, in kg, no more than a rod's. */
static cairn_wide rod(cairn_wide amount, cairn_wide power, cairn_wide mass)
{
    return least(cairn_wide_mul(amount, power), cairn_wide_mul(mass, STIFFNESS_MAX));
}

/* What it weighs with in all; *stiffness: k h^2, *damping: c h. */
static cairn_wide weigh(const web *w, const cairn_spring *spring, cairn_wide *stiffness, cairn_wide *damping)
{
    cairn_wide mass = cairn_bodies_reduced_mass(&w->world->bodies[spring->a], &w->world->bodies[spring->b]);
    *stiffness = rod(cairn_wide_unpack(spring->stiffness), square(cairn_world_substep(w->world)), mass);
    *damping = rod(cairn_wide_unpack(spring->damping), cairn_world_substep(w->world), mass);
    return cairn_wide_add(*stiffness, *damping);
}

static void load(const web *w, uint16_t place, const cairn_offset2 *anchor, cairn_wide weight)
{
    if (place == CAIRN_NONE) {
        return;
    }
    cairn_mesh_node *node = &w->mesh->nodes[place];
    const cairn_body *body = body_of(w, node);
    node->scale = cairn_wide_add(node->scale, weight);
    if ((anchor->x != 0 || anchor->y != 0) && cairn_body_can_turn(body)) {
        node->turning = cairn_wide_add(node->turning, cairn_wide_mul(weight, leverage(body, anchor)));
        node->turns = 1;
    }
}

static cairn_wide root_of(cairn_wide part, cairn_wide whole) { return cairn_wide_sqrt(cairn_wide_div(part, whole)); }
static cairn_share share_of(cairn_wide part, cairn_wide whole) { return cairn_wide_to_share(cairn_wide_div(part, whole)); }

static void weigh_link(const web *w, cairn_mesh_link *link, cairn_wide most)
{
    cairn_wide stiffness, damping, weight = weigh(w, spring_of(w, link), &stiffness, &damping);
    cairn_wide root = root_of(weight, most);
    for (int k = 0; k < 2; k++) {
        if (link->node[k] != CAIRN_NONE) {
            const cairn_mesh_node *node = &w->mesh->nodes[link->node[k]];
            link->shift[k] = cairn_wide_to_share(root_of(weight, node->scale));
            link->turn[k] = cairn_wide_to_share(root_of(weight, node->turning));
        }
    }
    link->position_gain = cairn_wide_mul(root, cairn_wide_div(stiffness, weight));
    link->velocity_gain = cairn_wide_to_share(cairn_wide_mul(root, cairn_wide_div(damping, weight)));
}

CAIRN_ONCE void weigh_links(const web *w)
{
    cairn_wide most = cairn_wide_zero(), softest = cairn_wide_from_int(1), stiffness, damping;
    for (cairn_mesh_node *node = w->nodes; node != w->node_end; node++) {
        node->scale = node->turning = cairn_body_mass_of(body_of(w, node));
    }
    for (const cairn_mesh_link *link = w->links; link != w->link_end; link++) {
        const cairn_spring *spring = spring_of(w, link);
        cairn_wide weight = weigh(w, spring, &stiffness, &damping);
        load(w, link->node[0], &spring->anchor_a, weight);
        load(w, link->node[1], &spring->anchor_b, weight);
    }
    for (const cairn_mesh_node *node = w->nodes; node != w->node_end; node++) {
        most = cairn_wide_less(most, node->scale) ? node->scale : most;
    }
    for (cairn_mesh_link *link = w->links; link != w->link_end; link++) {
        weigh_link(w, link, most);
    }
    for (cairn_mesh_node *node = w->nodes; node != w->node_end; node++) {
        cairn_wide mass = cairn_body_mass_of(body_of(w, node));
        node->mass = share_of(mass, node->scale);
        node->inertia = share_of(mass, node->turning);
        softest = least(softest, cairn_wide_div(mass, node->scale));
        node->scale = root_of(most, node->scale);
        node->turning = root_of(most, node->turning);
    }
    w->part->stale = share_of(cairn_wide_sqrt(softest), cairn_wide_from_int(STALE));
}

/* ---- rows ---- */

static uint16_t rows_of(const cairn_mesh_node *node) { return (uint16_t)(node->shifts + node->turns); }

static bool make_rows(const web *w)
{
    cairn_mesh *mesh = w->mesh;
    uint16_t place = w->part->row;
    for (cairn_mesh_node *node = w->nodes; node != w->node_end; node++) {
        node->shifts = cairn_body_is_free_to_shift(body_of(w, node)) ? 2 : 0;
        node->row = place;
        place = (uint16_t)(place + rows_of(node));
    }
    w->part->rows = (uint16_t)(place - w->part->row);
    for (const cairn_mesh_node *node = w->nodes; node != w->node_end; node++) {
        uint16_t first = mesh->nodes[first_neighbour(w, node)].row;
        for (uint16_t i = node->row; i < node->row + rows_of(node); i++) {
            cairn_mesh_row *row = &mesh->rows[i];
            uint32_t count = (uint32_t)(i - first);
            if (count > ROW_MAX || count > mesh->entry_capacity - mesh->entry_count) {
                return false;
            }
            row->first = first;
            row->entries = mesh->entry_count;
            mesh->entry_count += count;
        }
    }
    return true;
}

CAIRN_ONCE bool add_part(cairn_world *world, cairn_mesh *mesh, uint16_t network)
{
    cairn_mesh_part *part = &mesh->parts[mesh->part_count];
    uint32_t entries = mesh->entry_count;
    if (mesh->part_count == mesh->body_capacity) {
        return false;
    }
    cairn_clear(part, sizeof *part);
    part->network = network;
    part->node = mesh->node_count;
    part->row = mesh->row_count;
    part->link = mesh->link_count;
    part->turned = CAIRN_UNIT(1);
    web w = web_of(world, part);
    if (!collect(&w)) {
        return false;
    }
    order(&w);
    weigh_links(&w);
    if (!make_rows(&w)) {
        mesh->entry_count = entries;
        return false;
    }
    mesh->part_count++;
    mesh->node_count = (uint16_t)(mesh->node_count + part->nodes);
    mesh->row_count = (uint16_t)(mesh->row_count + part->rows);
    mesh->link_count = (uint16_t)(mesh->link_count + part->links);
    return true;
}

static void make(cairn_world *world)
{
    cairn_spring_pool *pool = world->springs;
    cairn_mesh *mesh = pool->mesh;
    mesh->part_count = mesh->node_count = mesh->row_count = mesh->link_count = 0;
    mesh->entry_count = 0;
    for (uint16_t i = 0; i < pool->end; i++) {
        cairn_spring *spring = &pool->springs[i];
        spring->flags &= (uint16_t)~CAIRN_SPRING_MESHED;
        if (cairn_spring_is_used(spring) && (spring->flags & (CAIRN_SPRING_ENTANGLED | CAIRN_SPRING_PINNED)) == CAIRN_SPRING_ENTANGLED && add_part(world, mesh, i)) {
            spring->flags |= CAIRN_SPRING_MESHED;
        }
    }
}

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

static void make_line(const web *w, const cairn_mesh_link *link, line *l)
{
    const cairn_spring *spring = spring_of(w, link);
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
static void assemble(const web *w)
{
    cairn_mesh *mesh = w->mesh;
    for (const cairn_mesh_node *node = w->nodes; node != w->node_end; node++) {
        for (int k = 0; k < rows_of(node); k++) {
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
static cairn_sum less_products(cairn_sum sum, const web *w, const cairn_mesh_row *p, const cairn_mesh_row *q)
{
    int from = p->first > q->first ? p->first : q->first;
    const cairn_share *a = &w->mesh->entries[p->entries + (uint32_t)(from - p->first)];
    const cairn_share *b = &w->mesh->entries[q->entries + (uint32_t)(from - q->first)];
    for (int k = (int)(q - w->mesh->rows) - from; k > 0; k--) {
        sum = cairn_sum_less(sum, *a++, *b++);
    }
    return sum;
}

CAIRN_ONCE void factorise(const web *w)
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
static cairn_motion ask(const web *w)
{
    cairn_motion most = 0;
    cairn_turn turn = 0;
    for (cairn_mesh_link *link = w->links; link != w->link_end; link++) {
        cairn_spring *spring = spring_of(w, link);
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

CAIRN_ONCE void pull(const web *w, int lift)
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
CAIRN_ONCE void substitute(const web *w)
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

static void apply(const web *w, int lift)
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

static bool is_active(const web *w)
{
    for (const cairn_mesh_link *link = w->links; link != w->link_end; link++) {
        if (cairn_spring_is_active(w->world, spring_of(w, link))) {
            return true;
        }
    }
    return false;
}

static void solve(cairn_world *world, int substep)
{
    cairn_mesh *mesh = world->springs->mesh;
    for (uint16_t i = 0; i < mesh->part_count; i++) {
        web w = web_of(world, &mesh->parts[i]);
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

static const cairn_mesh_class class_of_meshes = { make, solve };

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
