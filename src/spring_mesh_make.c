/*
 * Making a mesh of an entangled network, when springs have changed: its springs and bodies, the order of these, which keeps the envelope small, the
 * springs' weights and the bodies' scales, and the rows. What it is for, and what is at most 1, spring_mesh.c says.
 */
#include "spring_web.h"

/* Beyond this stiffness in units of the reduced mass a spring is a rod: as in spring_map.c. */
#define STIFFNESS_MAX cairn_wide_from_int(4096)
/*
 * The factors are made anew when the springs may have turned by the least body's sqrt(m / (m + sum w)), over this. Old
 * directions resist, with all of the springs' stiffness, what turns the mesh as a whole: w (turn)^2 has to stay small against m.
 */
#define STALE 8
/* The most entries of a row: keeps the sums of their products in 64 bits. */
enum { ROW_MAX = 255 };

void cairn_web_find(cairn_world *world, cairn_mesh_part *part, cairn_web *out)
{
    cairn_mesh *mesh = world->springs->mesh;
    out->world = world;
    out->mesh = mesh;
    out->part = part;
    out->nodes = mesh->nodes + part->node;
    out->node_end = out->nodes + part->nodes;
    out->rows = mesh->rows + part->row;
    out->row_end = out->rows + part->rows;
    out->links = mesh->links + part->link;
    out->link_end = out->links + part->links;
}

CAIRN_ONCE const cairn_body *body_of(const cairn_web *w, const cairn_mesh_node *node) { return &w->world->bodies[node->body]; }

/* ---- which bodies, in which order ---- */

static uint16_t node_of(const cairn_web *w, uint16_t body)
{
    for (const cairn_mesh_node *node = w->nodes; node != w->node_end; node++) {
        if (node->body == body) {
            return (uint16_t)(node - w->mesh->nodes);
        }
    }
    return CAIRN_NONE;
}

static bool add_node(cairn_web *w, uint16_t body)
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

static bool collect(cairn_web *w)
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
static uint16_t first_neighbour(const cairn_web *w, const cairn_mesh_node *node)
{
    uint16_t place = (uint16_t)(node - w->mesh->nodes), first = place;
    for (const cairn_mesh_link *link = w->links; link != w->link_end; link++) {
        uint16_t other = across(link, place);
        first = other < first ? other : first;
    }
    return first;
}

/* Put the nodes in the order of their ranks, of which nothing is known yet but their bodies; how far the entries then reach. */
static uint32_t arrange(const cairn_web *w)
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
        link->node[0] = node_of(w, cairn_web_spring(w, link)->a);
        link->node[1] = node_of(w, cairn_web_spring(w, link)->b);
    }
    for (const cairn_mesh_node *node = w->nodes; node != w->node_end; node++) {
        size += (uint32_t)(node - w->mesh->nodes) - first_neighbour(w, node);
    }
    return size;
}

CAIRN_ONCE uint32_t arrange_by_bodies(const cairn_web *w)
{
    for (cairn_mesh_node *node = w->nodes; node != w->node_end; node++) {
        node->rank = node->body;
    }
    return arrange(w);
}

/* Number the nodes in rings about one of them; the last that was reached. */
static cairn_mesh_node *rank_from(const cairn_web *w, cairn_mesh_node *start)
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
static void order(const cairn_web *w)
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
static cairn_wide weigh(const cairn_web *w, const cairn_spring *spring, cairn_wide *stiffness, cairn_wide *damping)
{
    cairn_wide mass = cairn_bodies_reduced_mass(&w->world->bodies[spring->a], &w->world->bodies[spring->b]);
    *stiffness = rod(cairn_wide_unpack(spring->stiffness), square(cairn_world_substep(w->world)), mass);
    *damping = rod(cairn_wide_unpack(spring->damping), cairn_world_substep(w->world), mass);
    return cairn_wide_add(*stiffness, *damping);
}

static void load(const cairn_web *w, uint16_t place, const cairn_offset2 *anchor, cairn_wide weight)
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

static void weigh_link(const cairn_web *w, cairn_mesh_link *link, cairn_wide most)
{
    cairn_wide stiffness, damping, weight = weigh(w, cairn_web_spring(w, link), &stiffness, &damping);
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

CAIRN_ONCE void weigh_links(const cairn_web *w)
{
    cairn_wide most = cairn_wide_zero(), softest = cairn_wide_from_int(1), stiffness, damping;
    for (cairn_mesh_node *node = w->nodes; node != w->node_end; node++) {
        node->scale = node->turning = cairn_body_mass_of(body_of(w, node));
    }
    for (const cairn_mesh_link *link = w->links; link != w->link_end; link++) {
        const cairn_spring *spring = cairn_web_spring(w, link);
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

static bool make_rows(const cairn_web *w)
{
    cairn_mesh *mesh = w->mesh;
    uint16_t place = w->part->row;
    for (cairn_mesh_node *node = w->nodes; node != w->node_end; node++) {
        node->shifts = cairn_body_is_free_to_shift(body_of(w, node)) ? 2 : 0;
        node->row = place;
        place = (uint16_t)(place + cairn_mesh_rows_of(node));
    }
    w->part->rows = (uint16_t)(place - w->part->row);
    for (const cairn_mesh_node *node = w->nodes; node != w->node_end; node++) {
        uint16_t first = mesh->nodes[first_neighbour(w, node)].row;
        for (uint16_t i = node->row; i < node->row + cairn_mesh_rows_of(node); i++) {
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
    cairn_web w;
    cairn_web_find(world, part, &w);
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

void cairn_meshes_make(cairn_world *world)
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
