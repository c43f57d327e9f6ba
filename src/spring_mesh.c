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

/* ---- which bodies, in which order ---- */

static uint16_t node_of(const cairn_mesh *mesh, const cairn_mesh_part *part, uint16_t body)
{
    for (uint16_t i = part->node; i < part->node + part->nodes; i++) {
        if (mesh->nodes[i].body == body) {
            return i;
        }
    }
    return CAIRN_NONE;
}

static bool add_node(const cairn_world *world, cairn_mesh *mesh, cairn_mesh_part *part, uint16_t body)
{
    if (!cairn_body_is_dynamic(&world->bodies[body]) || node_of(mesh, part, body) != CAIRN_NONE) {
        return true;
    }
    if (part->node + part->nodes == mesh->body_capacity) {
        return false;
    }
    uint16_t place = (uint16_t)(part->node + part->nodes);
    memset(&mesh->nodes[place], 0, sizeof mesh->nodes[place]);
    mesh->nodes[place].body = body;
    part->nodes++;
    return true;
}

static bool collect(const cairn_world *world, cairn_mesh *mesh, cairn_mesh_part *part)
{
    const cairn_spring_pool *pool = world->springs;
    for (uint16_t i = part->network; i < pool->end; i++) {
        const cairn_spring *spring = &pool->springs[i];
        if (!cairn_spring_is_used(spring) || spring->network != part->network) {
            continue;
        }
        if (part->link + part->links == mesh->link_capacity || !add_node(world, mesh, part, spring->a)
            || !add_node(world, mesh, part, spring->b)) {
            return false;
        }
        mesh->links[part->link + part->links].spring = i;
        part->links++;
        part->has_levers = part->has_levers || cairn_spring_is_off_centre(spring);
    }
    return true;
}

/* Sort by rank. */
static void arrange(cairn_mesh *mesh, const cairn_mesh_part *part)
{
    cairn_mesh_node *nodes = &mesh->nodes[part->node];
    for (int i = 1; i < part->nodes; i++) {
        cairn_mesh_node node = nodes[i];
        int k = i;
        for (; k > 0 && nodes[k - 1].rank > node.rank; k--) {
            nodes[k] = nodes[k - 1];
        }
        nodes[k] = node;
    }
}

static void bind(const cairn_world *world, cairn_mesh *mesh, const cairn_mesh_part *part)
{
    for (uint16_t i = part->link; i < part->link + part->links; i++) {
        cairn_mesh_link *link = &mesh->links[i];
        const cairn_spring *spring = &world->springs->springs[link->spring];
        link->node_a = node_of(mesh, part, spring->a);
        link->node_b = node_of(mesh, part, spring->b);
    }
}

/* The first of the nodes that a node is linked to, itself included. */
static uint16_t first_neighbour(const cairn_mesh *mesh, const cairn_mesh_part *part, uint16_t node)
{
    uint16_t first = node;
    for (uint16_t i = part->link; i < part->link + part->links; i++) {
        const cairn_mesh_link *link = &mesh->links[i];
        uint16_t other = link->node_a == node ? link->node_b : link->node_b == node ? link->node_a : CAIRN_NONE;
        first = other < first ? other : first;
    }
    return first;
}

/* How far the entries reach in this order of the nodes. */
static uint32_t envelope(const cairn_mesh *mesh, const cairn_mesh_part *part)
{
    uint32_t size = 0;
    for (uint16_t i = part->node; i < part->node + part->nodes; i++) {
        size += (uint32_t)(i - first_neighbour(mesh, part, i));
    }
    return size;
}

/* Number the nodes in rings about one of them; the last that was reached. */
static uint16_t rank_from(cairn_mesh *mesh, const cairn_mesh_part *part, uint16_t start)
{
    uint16_t last = start, count = 1;
    for (uint16_t i = part->node; i < part->node + part->nodes; i++) {
        mesh->nodes[i].rank = CAIRN_NONE;
    }
    mesh->nodes[start].rank = 0;
    for (uint16_t rank = 0; rank < count; rank++) {
        uint16_t node = part->node;
        while (mesh->nodes[node].rank != rank) {
            node++;
        }
        last = node;
        for (uint16_t i = part->link; i < part->link + part->links; i++) {
            const cairn_mesh_link *link = &mesh->links[i];
            uint16_t other = link->node_a == node ? link->node_b : link->node_b == node ? link->node_a : CAIRN_NONE;
            if (other != CAIRN_NONE && mesh->nodes[other].rank == CAIRN_NONE) {
                mesh->nodes[other].rank = count++;
            }
        }
    }
    return last;
}

/* By the bodies' own order, or in rings about an end of the network (Cuthill and McKee), whichever has fewer entries. */
static void order(const cairn_world *world, cairn_mesh *mesh, const cairn_mesh_part *part)
{
    for (uint16_t i = part->node; i < part->node + part->nodes; i++) {
        mesh->nodes[i].rank = mesh->nodes[i].body;
    }
    arrange(mesh, part);
    bind(world, mesh, part);
    uint32_t plain = envelope(mesh, part);
    rank_from(mesh, part, rank_from(mesh, part, part->node));
    arrange(mesh, part);
    bind(world, mesh, part);
    if (envelope(mesh, part) >= plain) {
        for (uint16_t i = part->node; i < part->node + part->nodes; i++) {
            mesh->nodes[i].rank = mesh->nodes[i].body;
        }
        arrange(mesh, part);
        bind(world, mesh, part);
    }
}

/* ---- weights and scales ---- */

static cairn_wide least(cairn_wide a, cairn_wide b) { return cairn_wide_less(b, a) ? b : a; }
static cairn_wide square(cairn_wide a) { return cairn_wide_mul(a, a); }

/* The square of an anchor's greatest lever, at least 1. */
static cairn_wide leverage(const cairn_body *body, cairn_offset x, cairn_offset y)
{
    cairn_wide one = cairn_wide_from_int(1);
    cairn_wide arm = cairn_wide_add(square(cairn_wide_from_offset(x)), square(cairn_wide_from_offset(y)));
    cairn_wide lever = cairn_wide_mul(arm, square(cairn_body_inverse_gyration(body)));
    return cairn_wide_less(lever, one) ? one : lever;
}

/* k h^2 and c h, in kg, no more than a rod's. */
static void weigh(const cairn_world *world, const cairn_spring *spring, cairn_wide *stiffness, cairn_wide *damping)
{
    const cairn_body *a = &world->bodies[spring->a], *b = &world->bodies[spring->b];
    cairn_wide mass = cairn_bodies_reduced_mass(a, b);
    cairn_wide limit = cairn_wide_mul(mass, STIFFNESS_MAX);
    *stiffness = least(cairn_wide_mul(cairn_wide_unpack(spring->stiffness), square(world->substep)), limit);
    *damping = least(cairn_wide_mul(cairn_wide_unpack(spring->damping), world->substep), limit);
}

static void load(const cairn_world *world, cairn_mesh *mesh, uint16_t place, cairn_offset x, cairn_offset y, cairn_wide weight)
{
    if (place == CAIRN_NONE) {
        return;
    }
    cairn_mesh_node *node = &mesh->nodes[place];
    const cairn_body *body = &world->bodies[node->body];
    node->scale = cairn_wide_add(node->scale, weight);
    if ((x != 0 || y != 0) && cairn_body_can_turn(body)) {
        node->turning = cairn_wide_add(node->turning, cairn_wide_mul(weight, leverage(body, x, y)));
        node->turns = 1;
    }
}

static cairn_share root_share(cairn_wide part, cairn_wide whole) { return cairn_wide_to_share(cairn_wide_sqrt(cairn_wide_div(part, whole))); }

static void weigh_links(cairn_world *world, cairn_mesh *mesh, cairn_mesh_part *part)
{
    cairn_wide most = cairn_wide_from_int(0), softest = cairn_wide_from_int(1), stiffness, damping;
    for (uint16_t i = part->node; i < part->node + part->nodes; i++) {
        mesh->nodes[i].scale = mesh->nodes[i].turning = cairn_body_mass_of(&world->bodies[mesh->nodes[i].body]);
    }
    for (uint16_t i = part->link; i < part->link + part->links; i++) {
        const cairn_mesh_link *link = &mesh->links[i];
        const cairn_spring *spring = &world->springs->springs[link->spring];
        weigh(world, spring, &stiffness, &damping);
        cairn_wide weight = cairn_wide_add(stiffness, damping);
        load(world, mesh, link->node_a, spring->anchor_a.x, spring->anchor_a.y, weight);
        load(world, mesh, link->node_b, spring->anchor_b.x, spring->anchor_b.y, weight);
    }
    for (uint16_t i = part->node; i < part->node + part->nodes; i++) {
        most = cairn_wide_less(most, mesh->nodes[i].scale) ? mesh->nodes[i].scale : most;
    }
    for (uint16_t i = part->link; i < part->link + part->links; i++) {
        cairn_mesh_link *link = &mesh->links[i];
        weigh(world, &world->springs->springs[link->spring], &stiffness, &damping);
        cairn_wide weight = cairn_wide_add(stiffness, damping);
        cairn_wide root = cairn_wide_sqrt(cairn_wide_div(weight, most));
        link->shift_a = link->node_a == CAIRN_NONE ? 0 : root_share(weight, mesh->nodes[link->node_a].scale);
        link->shift_b = link->node_b == CAIRN_NONE ? 0 : root_share(weight, mesh->nodes[link->node_b].scale);
        link->turn_a = link->node_a == CAIRN_NONE ? 0 : root_share(weight, mesh->nodes[link->node_a].turning);
        link->turn_b = link->node_b == CAIRN_NONE ? 0 : root_share(weight, mesh->nodes[link->node_b].turning);
        link->position_gain = cairn_wide_mul(root, cairn_wide_div(stiffness, weight));
        link->velocity_gain = cairn_wide_to_share(cairn_wide_mul(root, cairn_wide_div(damping, weight)));
    }
    for (uint16_t i = part->node; i < part->node + part->nodes; i++) {
        cairn_mesh_node *node = &mesh->nodes[i];
        cairn_wide mass = cairn_body_mass_of(&world->bodies[node->body]);
        node->mass = cairn_wide_to_share(cairn_wide_div(mass, node->scale));
        node->inertia = cairn_wide_to_share(cairn_wide_div(mass, node->turning));
        softest = cairn_wide_less(cairn_wide_div(mass, node->scale), softest) ? cairn_wide_div(mass, node->scale) : softest;
        node->scale = cairn_wide_sqrt(cairn_wide_div(most, node->scale));
        node->turning = cairn_wide_sqrt(cairn_wide_div(most, node->turning));
    }
    part->stale = cairn_wide_to_share(cairn_wide_div(cairn_wide_sqrt(softest), cairn_wide_from_int(STALE)));
}

/* ---- rows ---- */

static bool make_rows(const cairn_world *world, cairn_mesh *mesh, cairn_mesh_part *part)
{
    for (uint16_t i = part->node; i < part->node + part->nodes; i++) {
        cairn_mesh_node *node = &mesh->nodes[i];
        node->shifts = cairn_body_is_free_to_shift(&world->bodies[node->body]) ? 2 : 0;
        node->row = (uint16_t)(part->row + part->rows);
        part->rows = (uint16_t)(part->rows + node->shifts + node->turns);
    }
    for (uint16_t i = part->node; i < part->node + part->nodes; i++) {
        const cairn_mesh_node *node = &mesh->nodes[i];
        uint16_t first = mesh->nodes[first_neighbour(mesh, part, i)].row;
        for (uint16_t row = node->row; row < node->row + node->shifts + node->turns; row++) {
            uint32_t count = (uint32_t)(row - first);
            if (count > ROW_MAX || count > mesh->entry_capacity - mesh->entry_count) {
                return false;
            }
            mesh->rows[row].first = first;
            mesh->rows[row].entries = mesh->entry_count;
            mesh->entry_count += count;
        }
    }
    return true;
}

static bool add_part(cairn_world *world, cairn_mesh *mesh, uint16_t network)
{
    cairn_mesh_part *part = &mesh->parts[mesh->part_count];
    uint32_t entries = mesh->entry_count;
    if (mesh->part_count == mesh->body_capacity) {
        return false;
    }
    memset(part, 0, sizeof *part);
    part->network = network;
    part->node = mesh->node_count;
    part->row = mesh->row_count;
    part->link = mesh->link_count;
    part->turned = CAIRN_UNIT(1);
    if (!collect(world, mesh, part)) {
        return false;
    }
    order(world, mesh, part);
    weigh_links(world, mesh, part);
    if (!make_rows(world, mesh, part)) {
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
        if (cairn_spring_is_used(spring) && (spring->flags & CAIRN_SPRING_ENTANGLED) && add_part(world, mesh, i)) {
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

static void add_end(line *l, const cairn_mesh_node *node, const cairn_spring *spring, cairn_share shift, cairn_share turn, cairn_lever lever)
{
    if (node->shifts > 0) {
        l->row[l->count] = node->row;
        l->g[l->count++] = cairn_motion_dir(shift, spring->direction_x);
        l->row[l->count] = (uint16_t)(node->row + 1);
        l->g[l->count++] = cairn_motion_dir(shift, spring->direction_y);
    }
    if (node->turns > 0) {
        l->row[l->count] = (uint16_t)(node->row + node->shifts);
        l->g[l->count++] = cairn_motion_lever(turn, lever);
    }
}

static void make_line(const cairn_world *world, const cairn_mesh *mesh, const cairn_mesh_link *link, line *l)
{
    const cairn_spring *spring = &world->springs->springs[link->spring];
    l->count = 0;
    if (link->node_a != CAIRN_NONE) {
        add_end(l, &mesh->nodes[link->node_a], spring, -link->shift_a, -link->turn_a, spring->lever_a);
    }
    if (link->node_b != CAIRN_NONE) {
        add_end(l, &mesh->nodes[link->node_b], spring, link->shift_b, link->turn_b, spring->lever_b);
    }
}

/* The matrix: its diagonal in the rows' values until it is factorised. */
static void assemble(const cairn_world *world, cairn_mesh *mesh, const cairn_mesh_part *part)
{
    for (uint16_t i = part->node; i < part->node + part->nodes; i++) {
        const cairn_mesh_node *node = &mesh->nodes[i];
        for (int k = 0; k < node->shifts + node->turns; k++) {
            cairn_mesh_row *row = &mesh->rows[node->row + k];
            row->value = k < node->shifts ? node->mass : node->inertia;
            memset(&mesh->entries[row->entries], 0, (size_t)(node->row + k - row->first) * sizeof(cairn_share));
        }
    }
    for (uint16_t i = part->link; i < part->link + part->links; i++) {
        line l;
        make_line(world, mesh, &mesh->links[i], &l);
        for (int p = 0; p < l.count; p++) {
            mesh->rows[l.row[p]].value += cairn_share_mul(l.g[p], l.g[p]);
            for (int q = 0; q < l.count; q++) {
                if (l.row[q] < l.row[p]) {
                    mesh->entries[mesh->rows[l.row[p]].entries + l.row[q] - mesh->rows[l.row[p]].first] += cairn_share_mul(l.g[p], l.g[q]);
                }
            }
        }
    }
}

/* The sum so far less the products of two rows' entries, in the columns from..to. */
static cairn_sum less_products(cairn_sum sum, const cairn_mesh *mesh, const cairn_mesh_row *p, const cairn_mesh_row *q, int from, int to)
{
    if (from < to) {
        const cairn_share *a = &mesh->entries[p->entries + (uint32_t)(from - p->first)];
        const cairn_share *b = &mesh->entries[q->entries + (uint32_t)(from - q->first)];
        for (int k = 0; k < to - from; k++) {
            sum = cairn_sum_less(sum, a[k], b[k]);
        }
    }
    return sum;
}

static void factorise(const cairn_world *world, cairn_mesh *mesh, cairn_mesh_part *part)
{
    assemble(world, mesh, part);
    for (int i = part->row; i < part->row + part->rows; i++) {
        cairn_mesh_row *row = &mesh->rows[i];
        cairn_share *entries = &mesh->entries[row->entries];
        for (int j = row->first; j < i; j++) {
            const cairn_mesh_row *column = &mesh->rows[j];
            int from = row->first > column->first ? row->first : column->first;
            cairn_sum sum = less_products(cairn_sum_of(entries[j - row->first]), mesh, row, column, from, j);
            entries[j - row->first] = cairn_motion_scale(cairn_sum_share(sum), column->inverse);
        }
        cairn_share left = cairn_sum_share(less_products(cairn_sum_of(row->value), mesh, row, row, row->first, i));
        left = left < PIVOT_MIN ? PIVOT_MIN : left;
        row->inverse = cairn_wide_div(cairn_wide_from_int(1), cairn_wide_sqrt(cairn_wide_from_share(left)));
    }
    part->turned = 0;
}

/* ---- the sub-step ---- */

/* The springs' pulls: sqrt(w) (B C* + D u); their greatest size. */
static cairn_motion ask(cairn_world *world, cairn_mesh *mesh, cairn_mesh_part *part)
{
    cairn_motion most = 0;
    cairn_turn turn = 0;
    for (uint16_t i = part->link; i < part->link + part->links; i++) {
        cairn_mesh_link *link = &mesh->links[i];
        cairn_spring *spring = &world->springs->springs[link->spring];
        const cairn_body *a = &world->bodies[spring->a], *b = &world->bodies[spring->b];
        cairn_turn turned;
        cairn_offset length = cairn_spring_aim(spring, a, b, true, &turned);
        turn = turned > turn ? turned : turn;
        link->pull = cairn_motion_from_offset_wide(length - spring->rest_length, link->position_gain);
        if (link->velocity_gain != 0) {
            link->pull = cairn_motion_add(link->pull, cairn_motion_share(cairn_spring_speed(spring, a, b), link->velocity_gain));
        }
        most = link->pull > most ? link->pull : -link->pull > most ? -link->pull : most;
    }
    part->turned += cairn_unit_from_turn(turn);
    return most;
}

static void pull(const cairn_world *world, cairn_mesh *mesh, const cairn_mesh_part *part, int lift)
{
    for (int i = part->row; i < part->row + part->rows; i++) {
        mesh->rows[i].value = 0;
    }
    for (uint16_t i = part->link; i < part->link + part->links; i++) {
        line l;
        cairn_motion pull = cairn_motion_lift(mesh->links[i].pull, lift);
        make_line(world, mesh, &mesh->links[i], &l);
        for (int p = 0; p < l.count; p++) {
            mesh->rows[l.row[p]].value -= cairn_motion_share(pull, l.g[p]);
        }
    }
}

/* Forwards by the factors, backwards by their transpose. */
static void substitute(cairn_mesh *mesh, const cairn_mesh_part *part)
{
    for (int i = part->row; i < part->row + part->rows; i++) {
        cairn_mesh_row *row = &mesh->rows[i];
        const cairn_share *entries = &mesh->entries[row->entries];
        cairn_sum sum = cairn_sum_of(row->value);
        for (int k = row->first; k < i; k++) {
            sum = cairn_sum_less(sum, entries[k - row->first], mesh->rows[k].value);
        }
        row->value = cairn_motion_clamp(cairn_motion_scale(cairn_sum_share(sum), row->inverse), CAIRN_MOTION_LIFTED);
    }
    for (int i = part->row + part->rows - 1; i >= part->row; i--) {
        cairn_mesh_row *row = &mesh->rows[i];
        const cairn_share *entries = &mesh->entries[row->entries];
        row->value = cairn_motion_scale(row->value, row->inverse);
        for (int k = row->first; k < i; k++) {
            mesh->rows[k].value = cairn_motion_add(mesh->rows[k].value, -cairn_motion_share(row->value, entries[k - row->first]));
        }
    }
}

static void apply(cairn_world *world, const cairn_mesh *mesh, const cairn_mesh_part *part, int lift)
{
    for (uint16_t i = part->node; i < part->node + part->nodes; i++) {
        const cairn_mesh_node *node = &mesh->nodes[i];
        const cairn_mesh_row *rows = &mesh->rows[node->row];
        cairn_motion x = 0, y = 0, turn = 0;
        if (node->shifts > 0) {
            x = cairn_motion_lower(rows[0].value, node->scale, lift);
            y = cairn_motion_lower(rows[1].value, node->scale, lift);
        }
        if (node->turns > 0) {
            turn = cairn_motion_lower(rows[node->shifts].value, node->turning, lift);
        }
        cairn_spring_push(&world->bodies[node->body], x, y, turn);
    }
}

static bool is_active(const cairn_world *world, const cairn_mesh *mesh, const cairn_mesh_part *part)
{
    for (uint16_t i = part->link; i < part->link + part->links; i++) {
        const cairn_spring *spring = &world->springs->springs[mesh->links[i].spring];
        if (cairn_body_is_active(&world->bodies[spring->a]) || cairn_body_is_active(&world->bodies[spring->b])) {
            return true;
        }
    }
    return false;
}

static void solve(cairn_world *world, int substep)
{
    cairn_mesh *mesh = world->springs->mesh;
    for (uint16_t i = 0; i < mesh->part_count; i++) {
        cairn_mesh_part *part = &mesh->parts[i];
        if (!is_active(world, mesh, part)) {
            continue;
        }
        cairn_motion most = ask(world, mesh, part);
        if (part->turned > part->stale || (part->has_levers && substep == 0)) {
            factorise(world, mesh, part);
        }
        int lift = cairn_motion_headroom(most);
        pull(world, mesh, part, lift);
        substitute(mesh, part);
        apply(world, mesh, part, lift);
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
    memset(mesh, 0, sizeof *mesh);
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
