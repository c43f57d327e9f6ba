/*
 * What the engine's own files share, in the order of the step: world.c (step) -> broad_pairs.c or quadtree.c (pairs) -> meet.c,
 * arbiter.c -> collide_*.c (manifold) -> rows.c (prepare) -> idle.c -> solver_soft.c with sweep*.c and slide.c, or solver_small.c, with bounce*.c,
 * spring*.c and block*.c -> motion.c (move) -> hold.c -> sleep.c.
 */
#ifndef CAIRN_ENGINE_H
#define CAIRN_ENGINE_H

#include <cairn/solver.h>

#define CAIRN_NONE 0xFFFFu
/* Of the solvers without sub-steps, as long as nobody has said otherwise. */
#define CAIRN_FIRST_PASSES 10
#define CAIRN_HARD_SLOP CAIRN_F(0.01)

/* Bodies within this reach of one another get an arbiter before they touch. */
#define CAIRN_REACH CAIRN_OFFSET(0.005)
/* Centres of mass stay within this distance of the origin on each axis, m. */
#define CAIRN_WORLD_EDGE CAIRN_F(16000)

/* A body standing on two points that is slower than this, m/s, comes to rest: see motion.c. */
#define CAIRN_REST_SPEED CAIRN_F(0.05)

/* The residues' place in a body. */
#define CAIRN_RESIDUE_BITS 0xFFFu

/* body.flags: the type in the lowest two bits, and: */
enum {
    CAIRN_BODY_TYPE = 3,
    CAIRN_BODY_USED = 1 << 2,
    CAIRN_BODY_WIDE = 1 << 3,     /* its bounding box covers the angles of a wide sector, see motion.c */
    CAIRN_BODY_FACING = 1 << 4,   /* dx and dy are the cosine and sine of its angle */
    CAIRN_BODY_FIXED_POSITION = 1 << 5,
    CAIRN_BODY_ASLEEP = 1 << 6,
    CAIRN_BODY_SPRUNG = 1 << 7,   /* a spring without contact holds it */
    CAIRN_BODY_HELD = 1 << 8,     /* a contact acted on it in this step */
    CAIRN_BODY_SPRING = 1 << 10,  /* an end of a spring */
    CAIRN_BODY_SPRINGS = 1 << 11, /* of more than one */
    CAIRN_BODY_RESTLESS = 1 << 12, /* is in a block of which something moves; in sleep.c, heads a group that may not fall asleep yet */
    CAIRN_BODY_MET = 1 << 13,     /* during the sub-steps: has a contact */
    CAIRN_BODY_UNSTEADY = CAIRN_BODY_MET, /* after them: rests on two points of no contact */
    CAIRN_BODY_GOES = 1 << 14,    /* during the sub-steps: takes part in them; the others coast */
    CAIRN_BODY_GRIPS = CAIRN_BODY_GOES, /* after them: no contact of it is at its friction limit */
    CAIRN_BODY_FAST = 1 << 15,    /* moves by more than a quarter of its size in this step */
    CAIRN_BODY_PLAIN = 1 << 9     /* gravity in full and no damping: the quick path */
};

/* row.feature, beyond the names: it leaves, or closes but not in this sub-step; left to the next impact phase. */
#define CAIRN_ROW_IN_FLIGHT 0x8000u

/* arbiter.flags */
enum {
    CAIRN_ARBITER_FRESH = 1 << 0,    /* found in this step */
    CAIRN_ARBITER_SENSOR = 1 << 1,   /* not solved */
    CAIRN_ARBITER_TOUCHING = 1 << 2,
    CAIRN_ARBITER_TOUCHED = 1 << 3,  /* touching in the step before */
    CAIRN_ARBITER_BOUNCY = 1 << 4,
    CAIRN_ARBITER_SOLVED = 1 << 6,   /* pushes in this step */
    CAIRN_ARBITER_ON_STATIC = 1 << 7, /* a is static */
    CAIRN_ARBITER_CAREFUL = 1 << 5   /* a body of fixed position takes part, or a long lever: not for the quick ways of sweep_quick.c */
};

/* arbiter.block: the number of its block, 0 if it is in none, and: */
enum {
    CAIRN_BLOCK_NUMBER = 127,
    CAIRN_BLOCK_UNEVEN = 128 /* one of the bodies has more than CAIRN_UNEVEN times the other one's mass */
};
#define CAIRN_UNEVEN 30
#define CAIRN_UNEVEN_SHARE CAIRN_SHARE(1.0 / 31) /* the heavy one's share then */

/* arbiter.path: which way its sweeps take, in this order, see sweep.c. Between two steps it is the next one's. */
enum {
    CAIRN_PATH_NONE,      /* none; between two steps: there are no rows */
    CAIRN_PATH_CAREFUL,   /* anything */
    CAIRN_PATH_SLIDING,   /* anything, and levers follow the motion: see slide.c */
    CAIRN_PATH_ON_STATIC, /* two points, none of them apart, and all of a change is b's */
    CAIRN_PATH_CENTRAL,   /* one point, apart or not, on the line through both centres: circles */
    CAIRN_PATH_SINGLE,    /* one point, and any bodies */
    CAIRN_PATH_SHARED,    /* two points, and any bodies; points may be apart */
    CAIRN_PATH_EVEN,      /* two points, none of them apart, of bodies of one mass, each takes half */
    CAIRN_PATH_TURN = 7,  /* these follow one another in this order. With the turns of others come: */
    CAIRN_PATH_IDLE = CAIRN_PATH_NONE + 8, /* in this step it does nothing, see idle.c; and */
    CAIRN_PATH_EVEN_CENTRAL = CAIRN_PATH_CENTRAL + 8, /* balls of one size and mass, whose spins change alike */
    CAIRN_PATH_WAY = 15,
    CAIRN_PATH_FREE = 16,   /* and: a is not static */
    CAIRN_PATH_FRESH = 32,  /* and: the rows are not held, but made in this step */
    CAIRN_PATH_APART = 64,  /* and: no point touched when the step began; the quick ways of one point look for themselves */
    CAIRN_PATH_DOUBTED = 128, /* between two steps: its rows are to be made anew, too, but it may well keep its way */
    CAIRN_PATH_FORMER = 128 /* while blocks are looked for: it was in one */
};

/* Do the levers of contacts follow bodies that slide past one another? See slide.c. */
#define CAIRN_HAS_SLIDES (CAIRN_WITH_SOFT_SOLVER && CAIRN_MAX_POINTS > 1)
static inline bool cairn_arbiter_idles(const cairn_arbiter *arbiter) { return CAIRN_WITH_SHORTCUTS && (arbiter->path & CAIRN_PATH_WAY) == CAIRN_PATH_IDLE; }
static inline bool cairn_arbiter_is_sliding(const cairn_arbiter *arbiter)
{
    return CAIRN_HAS_SLIDES && (arbiter->path & CAIRN_PATH_WAY) == CAIRN_PATH_SLIDING; /* see cairn_world_slides() */
}

/*
 * Do contacts differ in the way they take? Not where all that moves is alike, round, and slides: they are then swept in the order of their
 * bodies, each as CAIRN_PATH_CENTRAL.
 */
#define CAIRN_HAS_WAYS \
    (CAIRN_WITH_SOFT_SOLVER \
     && (CAIRN_MAX_POINTS > 1 || CAIRN_WITH_TURNING || CAIRN_WITH_FRICTION || CAIRN_WITH_MASSES || CAIRN_WITH_SETTINGS || CAIRN_WITH_BOUNCE \
     || CAIRN_WITH_FIXED_POSITION || CAIRN_WITH_BLOCKS || CAIRN_WITH_SENSORS || CAIRN_WITH_SLEEP || CAIRN_WITH_CONTINUOUS || CAIRN_WITH_SHORTCUTS \
     || CAIRN_WITH_HOLD))
/* Where no rows are held and no shapes are cheaply told apart, pairs are looked at first, and their arbiter is found, or made, once they meet. */
#define CAIRN_LOOKS_FIRST (!CAIRN_WITH_HOLD && !CAIRN_WITH_SHORTCUTS)
static inline unsigned cairn_arbiter_turn(const cairn_arbiter *arbiter)
{
    return CAIRN_HAS_WAYS ? arbiter->path & CAIRN_PATH_TURN : CAIRN_PATH_CENTRAL;
}

/* The flag if it is to be set. */
static inline unsigned cairn_flag_if(bool set, unsigned flag) { return set ? flag : 0u; }

static inline cairn_body_type cairn_body_type_of(const cairn_body *body) { return (cairn_body_type)(body->flags & CAIRN_BODY_TYPE); }
static inline bool cairn_body_is_dynamic(const cairn_body *body) { return (body->flags & CAIRN_BODY_TYPE) == CAIRN_DYNAMIC; }
/* Takes part in the step: used, not static, not asleep. */
static inline bool cairn_body_is_active(const cairn_body *body)
{
    return (body->flags & (CAIRN_BODY_USED | CAIRN_BODY_ASLEEP | CAIRN_STATIC)) == CAIRN_BODY_USED; /* only CAIRN_STATIC has that bit */
}

/*
 * Does the step ask which bodies have met something, or hang on a spring? Where it does not, all that is active takes part in the sub-steps alike, and
 * no flag says so.
 */
#define CAIRN_ASKS_WHO_MET \
    (CAIRN_WITH_SHORTCUTS || CAIRN_WITH_SPRINGS || CAIRN_WITH_SLEEP || (CAIRN_WITH_SOFT_SOLVER && (CAIRN_WITH_BOUNCE || CAIRN_WITH_FRICTION)))
static inline bool cairn_body_goes(const cairn_body *body)
{
    return CAIRN_ASKS_WHO_MET ? (body->flags & CAIRN_BODY_GOES) != 0 : cairn_body_is_active(body);
}

/* The same, but for platforms that stand still: moves, or may begin to, and so may wake what it touches. */
static inline bool cairn_body_is_stirring(const cairn_body *body)
{
    return cairn_body_is_active(body) && (cairn_body_is_dynamic(body) || body->vx != 0 || body->vy != 0 || body->w != 0);
}

/* ---- shape_measure.c ---- */
cairn_wide_word cairn_shape_area(const cairn_shape *shape);
cairn_wide_word cairn_shape_gyration(const cairn_shape *shape);
/* Radius of a disc about the centre of mass that the shape covers. */
cairn_real cairn_shape_inradius(const cairn_shape *shape);
/* The outline in the shape's own frame, of what is not round. A box's corners are written to the room for four that is given. */
void cairn_shape_outline(const cairn_shape *shape, cairn_offset2 *room, struct cairn_outline *out);
/* Half sizes of the bounding box of what has an outline, in this rotation: of polygons, and of boxes that are none other. */
void cairn_outline_extents(const cairn_shape *shape, cairn_unit c, cairn_unit s, cairn_real *x, cairn_real *y);
static inline bool cairn_shape_is_round(const cairn_shape *shape) { return shape->kind->rank == 0; }
/* Half sizes of the bounding box about the centre of mass, rounded up, for the rotation (c, s). Where nothing turns they are those of the shape. */
#define CAIRN_HAS_EXTENTS (CAIRN_WITH_SLOPES || CAIRN_WITH_POLYGONS)
static inline void cairn_shape_extents(const cairn_shape *shape, cairn_unit c, cairn_unit s, cairn_real *x, cairn_real *y)
{
    if (CAIRN_HAS_EXTENTS) {
        shape->kind->extents(shape, c, s, x, y);
        return;
    }
    *x = *y = shape->size.x;
    if (!cairn_shape_is_round(shape)) {
        *x = cairn_real_above_offset(cairn_offset_half(cairn_offset_from_real(*x)));
        *y = cairn_real_above_offset(cairn_offset_half(cairn_offset_from_real(shape->size.y)));
    }
}

/* kg; zero if not dynamic. By the model each time, for a mass is asked for where contacts and springs begin and not in the step. */
cairn_wide_word cairn_body_mass_word(const cairn_body *body);
CAIRN_ALWAYS_INLINE cairn_wide cairn_body_mass_of(const cairn_body *body) { return cairn_wide_from_word(cairn_body_mass_word(body)); }

/* mA mB / (mA + mB), or the mass of the one that is dynamic. */
cairn_wide_word cairn_bodies_reduced_mass_word(const cairn_body *a, const cairn_body *b);
CAIRN_ALWAYS_INLINE cairn_wide cairn_bodies_reduced_mass(const cairn_body *a, const cairn_body *b)
{
    return cairn_wide_from_word(cairn_bodies_reduced_mass_word(a, b));
}
/* What the first of two dynamic bodies takes of a change of their relative velocity: mB / (mA + mB). */
cairn_share cairn_bodies_share(const cairn_body *a, const cairn_body *b);

/* What a build may be without (config.h): constants then, and the compiler leaves out what cannot occur. */
static inline struct cairn_spring_pool *cairn_world_springs(const cairn_world *world) { return CAIRN_WITH_SPRINGS ? world->springs : NULL; }
static inline const cairn_bounce_class *cairn_world_bounce(const cairn_world *world)
{
    return CAIRN_WITH_BOUNCE && CAIRN_WITH_SOFT_SOLVER ? world->bounce : NULL;
}
static inline const cairn_continuous_class *cairn_world_continuous(const cairn_world *world)
{
    return CAIRN_WITH_CONTINUOUS ? world->continuous : NULL;
}
static inline unsigned cairn_world_fast(const cairn_world *world) { return CAIRN_WITH_CONTINUOUS ? world->fast : 0; }
static inline struct cairn_block *cairn_world_block(const cairn_world *world) { return CAIRN_WITH_BLOCKS ? world->block : NULL; }
static inline unsigned cairn_world_blocks(const cairn_world *world) { return CAIRN_WITH_BLOCKS ? world->blocks : 0; }
static inline const cairn_sleep_class *cairn_world_sleep(const cairn_world *world) { return CAIRN_WITH_SLEEP ? world->sleep : NULL; }
/*
 * What a world's settings make of its fields. Where these stay what they are at first (CAIRN_WITH_SETTINGS 0) it is constant, and no world keeps it:
 * 60 steps a second of 4 sub-steps, and 3 m/s of push-out. tests/trimmed/same_bits.c holds them to what derive() in world.c finds.
 */
/* What has slipped in a contact that sticks is taken back with this time constant, in steps. */
#define CAIRN_STICK_STEPS 48
#define CAIRN_FIRST_SUBSTEPS (CAIRN_WITH_SOFT_SOLVER ? 4 : 1)
static inline cairn_real cairn_world_rate(const cairn_world *world) { return CAIRN_WITH_SETTINGS ? world->rate : CAIRN_F(60); }
static inline int cairn_world_substeps(const cairn_world *world) { return CAIRN_WITH_SETTINGS ? world->substeps : CAIRN_FIRST_SUBSTEPS; }
static inline int cairn_world_passes(const cairn_world *world) { return CAIRN_WITH_SETTINGS ? world->passes : CAIRN_FIRST_PASSES; }
static inline cairn_motion cairn_world_most_speed(const cairn_world *world)
{
    return CAIRN_WITH_SETTINGS ? world->speed_limit : CAIRN_WITH_SOFT_SOLVER ? CAIRN_MOTION(0.93 / 1.5625) : CAIRN_MOTION(0.93 / 1.140625);
}
static inline cairn_motion cairn_world_rest_limit(const cairn_world *world)
{
    return CAIRN_WITH_SETTINGS ? world->rest_limit : CAIRN_MOTION(3277.0 / 65536 / (60 * CAIRN_FIRST_SUBSTEPS)); /* CAIRN_REST_SPEED */
}
static inline cairn_ratio cairn_world_rest_damping(const cairn_world *world) { return CAIRN_WITH_SETTINGS ? world->rest_damping : CAIRN_RATIO(1.0 / 60); }
static inline cairn_ratio cairn_world_stick(const cairn_world *world)
{
    return CAIRN_WITH_SETTINGS ? world->stick : CAIRN_RATIO(1.0 / (CAIRN_STICK_STEPS * 4));
}
static inline cairn_motion cairn_world_push_out_limit(const cairn_world *world)
{
    return CAIRN_WITH_SETTINGS ? world->push_out_limit : CAIRN_MOTION(3.0 / (60 * CAIRN_FIRST_SUBSTEPS));
}
CAIRN_ALWAYS_INLINE cairn_wide cairn_world_substep(const cairn_world *world)
{
    const cairn_wide at_first = CAIRN_WIDE_SCALED(128.0 / 240, CAIRN_WITH_SOFT_SOLVER ? -7 : -5);
    return CAIRN_WITH_SETTINGS ? world->substep : at_first;
}
CAIRN_ALWAYS_INLINE cairn_wide cairn_world_inverse_substep(const cairn_world *world)
{
    const cairn_wide at_first = CAIRN_WIDE_SCALED(240.0 / 256, CAIRN_WITH_SOFT_SOLVER ? 8 : 6);
    return CAIRN_WITH_SETTINGS ? world->inverse_substep : at_first;
}
/* Where there is one of a kind it is called by its own name. */
#define CAIRN_SOLVER_COUNT (CAIRN_WITH_SOFT_SOLVER + CAIRN_WITH_SLIDES_SOLVER + CAIRN_WITH_SMALL_SOLVER)
#if CAIRN_WITH_SOFT_SOLVER
#define CAIRN_ONLY_SOLVER cairn_solver_soft
#elif CAIRN_WITH_SLIDES_SOLVER
#define CAIRN_ONLY_SOLVER cairn_solver_slides
#else
#define CAIRN_ONLY_SOLVER cairn_solver_small
#endif
static inline const cairn_solver_class *cairn_world_solver(const cairn_world *world) { return CAIRN_SOLVER_COUNT > 1 ? world->solver : &CAIRN_ONLY_SOLVER; }
/* Has the build this one of them? */
static inline bool cairn_solver_is_known(const cairn_solver_class *solver)
{
    static const bool known[] = { CAIRN_WITH_SOFT_SOLVER, CAIRN_WITH_SLIDES_SOLVER, CAIRN_WITH_SMALL_SOLVER };
    return CAIRN_SOLVER_COUNT > 1 ? (unsigned)solver->kind < sizeof known && known[solver->kind] : solver == &CAIRN_ONLY_SOLVER;
}
/* The soft solver has sub-steps, and what corrects its motion: contacts that hold and follow, rest, and bodies that go straight. */
static inline bool cairn_world_is_soft(const cairn_world *world)
{
    return CAIRN_WITH_SOFT_SOLVER && (CAIRN_SOLVER_COUNT == 1 || world->solver->kind == CAIRN_SOLVER_SOFT);
}
/* Does the small solver run, which starts with the impulses of the step before, and not the slides'? */
static inline bool cairn_world_starts_warm(const cairn_world *world)
{
    return CAIRN_WITH_SMALL_SOLVER && (!CAIRN_WITH_SLIDES_SOLVER || world->solver->kind == CAIRN_SOLVER_SMALL);
}
extern const cairn_broad_class cairn_broad_pairs;
static inline const cairn_broad_class *cairn_world_broad(const cairn_world *world) { return CAIRN_WITH_QUADTREE ? world->broad : &cairn_broad_pairs; }

static inline bool cairn_body_is_fixed(const cairn_body *body)
{
    return CAIRN_WITH_FIXED_POSITION && (body->flags & CAIRN_BODY_FIXED_POSITION) != 0;
}
/* Either of them. */
static inline bool cairn_bodies_are_fixed(const cairn_body *a, const cairn_body *b)
{
    return CAIRN_WITH_FIXED_POSITION && ((a->flags | b->flags) & CAIRN_BODY_FIXED_POSITION) != 0;
}
/* Are there dynamic bodies that are not CAIRN_BODY_PLAIN? */
#define CAIRN_HAS_ODD_BODIES (CAIRN_WITH_GRAVITY_SCALE || CAIRN_WITH_DAMPING || CAIRN_WITH_FIXED_POSITION)
/* What gravity gives a dynamic body in a sub-step, along x or y. */
cairn_motion cairn_body_scaled_gravity(const cairn_world *world, cairn_motion gravity, const cairn_body *body);
static inline cairn_motion cairn_body_gravity(const cairn_world *world, cairn_motion gravity, const cairn_body *body)
{
    return CAIRN_HAS_ODD_BODIES && !(body->flags & CAIRN_BODY_PLAIN) ? cairn_body_scaled_gravity(world, gravity, body) : gravity;
}
static inline bool cairn_body_is_sensing(const cairn_body *body) { return CAIRN_WITH_SENSORS && body->model->sensor; }
/* Of two that are round and free to move none slides in the sense of slide.c. */
static inline bool cairn_world_slides(const cairn_world *world) { return CAIRN_HAS_SLIDES && world->slides; }
static inline bool cairn_arbiter_has_two(const cairn_arbiter *arbiter) { return CAIRN_MAX_POINTS > 1 && arbiter->count > 1; }
/* Of one whose shapes meet, and of what they meet in. */
static inline int cairn_arbiter_points(const cairn_arbiter *arbiter) { return CAIRN_MAX_POINTS == 1 && !CAIRN_WITH_BOUNCE ? 1 : arbiter->count; }
static inline int cairn_points_of(int count) { return CAIRN_MAX_POINTS == 1 ? 1 : count; }
/* The place of the second of two rows. */
#define CAIRN_LAST_ROW (CAIRN_MAX_POINTS - 1)
/* All that it presses with. */
static inline cairn_motion cairn_arbiter_pressure(const cairn_arbiter *arbiter)
{
    return arbiter->rows[0].impulse + (cairn_arbiter_has_two(arbiter) ? arbiter->rows[CAIRN_LAST_ROW].impulse : 0);
}
/* Do boxes collide as any polygon does? It takes longer, but no code of their own; the bits are the same. */
#ifndef CAIRN_BOXES_ARE_POLYGONS
#define CAIRN_BOXES_ARE_POLYGONS (CAIRN_SMALL && CAIRN_WITH_POLYGONS)
#endif
/* A function in a table, of contacts of two points: null in builds that know one point only. */
#define CAIRN_OF_TWO(function) (CAIRN_MAX_POINTS > 1 ? (function) : NULL)
/* The same at the end of a table that is shorter then. */
#if CAIRN_MAX_POINTS > 1
#define CAIRN_AND_OF_TWO(function) , (function)
#else
#define CAIRN_AND_OF_TWO(function)
#endif

static inline bool cairn_body_can_turn(const cairn_body *body) { return CAIRN_WITH_TURNING && body->inverse_gyration != 0; }
/* How it turns, in a sub-step and by its displacement. */
static inline cairn_motion cairn_body_spin(const cairn_body *body) { return CAIRN_WITH_TURNING ? body->w : 0; }
static inline cairn_motion cairn_body_turned(const cairn_body *body) { return CAIRN_WITH_TURNING ? body->dw : 0; }
/* What a row gives for a velocity, by its effective mass. Where nothing turns and nothing is held in its place, that is 1. */
static inline cairn_motion cairn_motion_by_mass(cairn_motion u, cairn_ratio mass)
{
    return CAIRN_WITH_TURNING || CAIRN_WITH_FIXED_POSITION ? cairn_motion_ratio(u, mass) : u;
}
CAIRN_ALWAYS_INLINE cairn_wide cairn_body_inverse_gyration(const cairn_body *body) { return cairn_wide_unpack(body->inverse_gyration); }

static inline bool cairn_body_is_round(const cairn_body *body) { return cairn_shape_is_round(body->model->shape); }

/*
 * During the search for contacts dx and dy are the cosine and sine of the angle where the narrow phase has asked for them
 * (CAIRN_BODY_FACING), or what holds the body back (arbiter.c), and dw is how far its surface may come in this step. When it
 * is done all are zero. What is round looks the same from everywhere.
 */
#define CAIRN_KEEPS_FACING (CAIRN_WITH_SLOPES && (CAIRN_WITH_SHORTCUTS || !CAIRN_SMALL)) /* else the narrow phase asks each time: it only saves time */
static inline void cairn_body_facing(const cairn_body *body, cairn_unit *c, cairn_unit *s)
{
    *c = CAIRN_UNIT(1);
    *s = 0;
    if (!CAIRN_WITH_SLOPES) {
        return;
    }
    if (CAIRN_KEEPS_FACING && (body->flags & CAIRN_BODY_FACING)) {
        *c = body->dx;
        *s = body->dy;
    } else if (!cairn_body_is_round(body)) {
        cairn_angle_rotation(body->angle, c, s);
    }
}
CAIRN_SHARED cairn_motion cairn_body_held_x(const cairn_body *body) { return CAIRN_KEEPS_FACING && (body->flags & CAIRN_BODY_FACING) ? 0 : body->dx; }
static inline cairn_motion cairn_body_held_y(const cairn_body *body) { return CAIRN_KEEPS_FACING && (body->flags & CAIRN_BODY_FACING) ? 0 : body->dy; }
static inline cairn_real cairn_body_way(const cairn_body *body) { return (cairn_real)body->dw; }

/* While nothing moves, dw may hold the place of another body: of the next free one, or for a stage of the step that leaves it zero. */
static inline uint16_t cairn_body_link(const cairn_body *body) { return (uint16_t)body->dw; }
static inline void cairn_body_set_link(cairn_body *body, uint16_t place) { body->dw = (cairn_motion)place; }

/* From one body's centre of mass to another one's; both within 512 m of one another. */
static inline cairn_offset cairn_bodies_apart_x(const cairn_body *a, const cairn_body *b)
{
    return cairn_coordinate_offset(a->x, a->x_residue, b->x, b->x_residue);
}
static inline cairn_offset cairn_bodies_apart_y(const cairn_body *a, const cairn_body *b)
{
    return cairn_coordinate_offset(a->y, a->y_residue, b->y, b->y_residue);
}

/* All zero. At -Os by a loop: a C library's own function, made for speed, is ten times as long. */
CAIRN_SHARED void cairn_clear(void *memory, size_t size)
{
    volatile unsigned char *byte = memory; /* or gcc makes a memset of it */
    if (!CAIRN_SMALL) {
        memset(memory, 0, size);
        return;
    }
    while (size != 0) {
        byte[--size] = 0;
    }
}

/* What is larger than some words: else gcc calls a memcpy of 142 bytes. */
CAIRN_SHARED void cairn_copy(void *to, const void *from, size_t size)
{
    volatile unsigned char *byte = to;
    const unsigned char *source = from;
    if (!CAIRN_SMALL) {
        memcpy(to, from, size);
        return;
    }
    while (size-- != 0) {
        byte[size] = source[size];
    }
}

static inline cairn_status cairn_fail(cairn_world *world, cairn_status status)
{
    world->error = (int8_t)status;
    return status;
}

/* ---- body.c ---- */
cairn_body *cairn_body_find(cairn_world *world, cairn_body_id id); /* null and the error set if stale */
/* The same for calls that change the body; *status says why not. */
cairn_body *cairn_body_find_to_change(cairn_world *world, cairn_body_id id, cairn_status *status);
/* The centre of mass relative to the shape's origin, in the world. */
void cairn_body_centroid(const cairn_body *body, cairn_offset *x, cairn_offset *y);
/* A point relative to the centre of mass. */
cairn_vec2 cairn_body_arm(const cairn_body *body, cairn_vec2 point);
/* A point given from the centre of mass, as the game sees it. */
cairn_vec2 cairn_body_point(const cairn_body *body, cairn_offset x, cairn_offset y);
cairn_body_id cairn_body_id_of(const cairn_world *world, const cairn_body *body);
void cairn_body_wake_up(cairn_world *world, cairn_body *body);

/* ---- motion.c ---- */
/* Before the search: bounding boxes with the margin of this step, and which bodies are fast. */
void cairn_bodies_look_ahead(cairn_world *world);
/* For the search: keep the cosine and sine. */
void cairn_body_face(cairn_body *body);
/* After it. */
void cairn_bodies_end_search(cairn_world *world);
/* Half sizes of the bounding box. */
void cairn_body_refresh_extents(cairn_body *body);
/* How far the body's surface can move in this step, and the reach. */
cairn_offset cairn_body_reach(const cairn_world *world, const cairn_body *body);
/* So slow, and moved so little in this step, that the formats cannot tell it from rest. */
bool cairn_body_is_still(const cairn_world *world, const cairn_body *body);
/* Beyond all speeds that may come to rest. */
bool cairn_body_is_under_way(const cairn_world *world, const cairn_body *body);
/* A velocity into the limits, which no slower one meets, whatever the sub-steps; counts what was cut. */
#define CAIRN_SURELY_SLOW CAIRN_MOTION(0.25)
void cairn_body_limit_speed(cairn_world *world, cairn_body *body);

/* The first sub-step's velocity: force, gravity and damping; u keeps the velocity before. */
void cairn_body_start(cairn_world *world, cairn_body *body, cairn_motion gx, cairn_motion gy);
/* The pose moves by the displacement. */
void cairn_body_move(cairn_world *world, cairn_body *body);
/* The end of the step: all that have not moved yet. */
void cairn_bodies_finish(cairn_world *world);

/* Does what nothing touches coast? Where ways may be cut it does so in any build, for the bits: its own is cut after it was straightened. */
#define CAIRN_COASTS (CAIRN_WITH_SHORTCUTS || CAIRN_WITH_CONTINUOUS)

/*
 * During the sub-steps the first of several bodies one after the other that do not take part in them keeps in ux the place behind the last
 * of them, and walks over all bodies skip them at once. What a contact or a spring holds keeps none, since these add to ux.
 */
static inline cairn_body *cairn_body_skip(const cairn_world *world, cairn_body *body)
{
    if (!CAIRN_WITH_SHORTCUTS || (body->flags & (CAIRN_BODY_MET | CAIRN_BODY_SPRING))) {
        return body + 1; /* its velocities are its own: a spring pulls at what sleeps, too */
    }
    cairn_body *next = &world->bodies[(uint16_t)body->ux];
    return next > body ? next : body + 1;
}

/* ---- broad phase ---- */
/* Are the boxes at most so far apart? */
static inline bool cairn_boxes_are_near(const cairn_body *a, const cairn_body *b, cairn_real way)
{
    return cairn_real_is_within(a->x - b->x, cairn_real_from_extents(a->extent_x, b->extent_x) + way)
        && cairn_real_is_within(a->y - b->y, cairn_real_from_extents(a->extent_y, b->extent_y) + way);
}

/* ---- driven.c, landing.c: of worlds with continuous collision, see cairn_continuous_class ---- */
void cairn_arbiters_hold_back(cairn_world *world);
void cairn_arbiters_land(cairn_world *world);

/* ---- narrow phase ---- */
typedef struct cairn_pose {
    const cairn_shape *shape;
    cairn_offset x, y; /* centre of mass, relative to some point near both */
    cairn_unit c, s;
} cairn_pose;

/* Where the corners of a box are, which has none of its own. */
typedef struct cairn_room {
    cairn_offset2 corner[4];
} cairn_room;

/* More than rounding may add to how far two outlines are apart. */
#define CAIRN_OUTLINE_ROUNDING CAIRN_OFFSET(0.000002)

/* A convex polygon in its own frame, counter-clockwise: its own corners and normals, or a box's. */
typedef struct cairn_outline {
    int count;
    cairn_offset inradius; /* of a disc about its centre that it surely covers */
    const cairn_offset2 *vertex;
    const cairn_unit2 *normal; /* outward, of the edge from vertex i to i + 1 */
} cairn_outline;

/* A vector of a shape's own frame in the world, and one of the world in its frame. */
static inline cairn_offset2 cairn_offset2_turned(cairn_offset2 v, cairn_unit c, cairn_unit s)
{
    cairn_offset2 r;
    r.x = cairn_offset_dot(v.x, -v.y, c, s);
    r.y = cairn_offset_dot(v.x, v.y, s, c);
    return r;
}
static inline cairn_offset2 cairn_offset2_turned_back(cairn_offset x, cairn_offset y, cairn_unit c, cairn_unit s)
{
    cairn_offset2 r;
    r.x = CAIRN_WITH_SLOPES ? cairn_offset_dot(x, y, c, s) : x;
    r.y = CAIRN_WITH_SLOPES ? cairn_offset_dot(x, y, -s, c) : y;
    return r;
}
static inline cairn_unit2 cairn_unit2_turned(cairn_unit2 n, cairn_unit c, cairn_unit s)
{
    cairn_unit2 r;
    r.x = CAIRN_WITH_SLOPES ? cairn_unit_dot(n.x, -n.y, c, s) : n.x;
    r.y = CAIRN_WITH_SLOPES ? cairn_unit_dot(n.x, n.y, s, c) : n.y;
    return r;
}

/*
 * Does the step ask where a contact's points lie? Not where there is one and nothing turns: contact.c finds it for the game then, on the line
 * through the centre of what is round.
 */
#define CAIRN_HAS_PLACES (CAIRN_MAX_POINTS > 1 || CAIRN_WITH_TURNING || CAIRN_WITH_SLOPES || CAIRN_WITH_CONTINUOUS)

typedef struct cairn_manifold_point {
    cairn_offset x, y;       /* half way between the surfaces, relative to the first body's centre of mass */
    cairn_offset separation;
    uint16_t feature;
} cairn_manifold_point;

typedef struct cairn_manifold {
    cairn_unit normal_x, normal_y; /* from the first to the second body */
    cairn_offset separation;       /* along the normal; at most the distance, where the shapes are apart */
    int count;
    cairn_offset steady;           /* where there is a contact: moved to one another by less, along x and y, without turning, the two have the same normal */
    cairn_manifold_point points[2];
    cairn_offset x, y; /* the second body's centre of mass as seen from the first one's, at the time: */
    cairn_unit time;   /* of the step, 0 for now */
} cairn_manifold;

/* The second body's face is taken as reference only if it separates by this much more: keeps the choice from flickering. */
#define CAIRN_FACE_PREFERENCE CAIRN_OFFSET(0.0005)

/*
 * The name of a clipped point: the reference edge, the incident edge and which end of it. The same end of the same
 * two edges has the same name whichever of them is the reference.
 */
static inline uint16_t cairn_feature(int reference, int incident, int end, bool swapped)
{
    return (uint16_t)(swapped ? incident << 5 | reference << 1 | (1 - end) : reference << 5 | incident << 1 | end);
}

/* Where it meets what lies in direction n from its centre. */
static inline void cairn_circle_place(cairn_offset r, cairn_unit2 n, cairn_offset separation, cairn_manifold *out)
{
    cairn_offset middle = r + cairn_offset_half(separation);
    out->points[0].x = cairn_offset_mul(middle, n.x);
    out->points[0].y = cairn_offset_mul(middle, n.y);
}

/* How far a point of its frame lies outside of an edge. */
CAIRN_SHARED cairn_offset cairn_outline_outside(const struct cairn_outline *outline, int edge, const cairn_offset2 *p)
{
    const cairn_offset2 *vertex = &outline->vertex[edge];
    return cairn_offset_dot(p->x - vertex->x, p->y - vertex->y, outline->normal[edge].x, outline->normal[edge].y);
}

/* The contact of a circle of radius r with a polygon's surface in direction n from the circle. */
CAIRN_SHARED void cairn_circle_touch(cairn_offset r, cairn_offset separation, cairn_unit2 n, int feature, cairn_offset steady, cairn_manifold *out)
{
    out->normal_x = n.x;
    out->normal_y = n.y;
    if (CAIRN_HAS_PLACES) {
        cairn_circle_place(r, n, separation, out);
    }
    out->points[0].separation = separation;
    out->points[0].feature = (uint16_t)feature;
    if (CAIRN_WITH_CONTINUOUS) {
        out->separation = separation;
        out->steady = steady;
    }
    out->count = 1;
}

void cairn_collide_circles(const cairn_pose *a, const cairn_pose *b, cairn_offset margin, cairn_manifold *out);
void cairn_collide_circle_box(const cairn_pose *a, const cairn_pose *b, cairn_offset margin, cairn_manifold *out);
void cairn_collide_circle_polygon(const cairn_pose *a, const cairn_pose *b, cairn_offset margin, cairn_manifold *out);
void cairn_collide_boxes(const cairn_pose *a, const cairn_pose *b, cairn_offset margin, cairn_manifold *out);
void cairn_collide_polygons(const cairn_pose *a, const cairn_pose *b, cairn_offset margin, cairn_manifold *out);

/* ---- arbiter.c ---- */
/*
 * The arbiter of a pair, null if there is none; and a new one, null if there is no room: where nobody searches first (CAIRN_LOOKS_FIRST), the one that
 * is there already. What is found next is expected after it.
 */
cairn_arbiter *cairn_arbiter_search(cairn_world *world, uint16_t a, uint16_t b);
cairn_arbiter *cairn_arbiter_insert(cairn_world *world, uint16_t a, uint16_t b);
/* May these two collide at all, by kind, layers and springs? */
bool cairn_bodies_may_meet(const cairn_world *world, const cairn_body *a, const cairn_body *b);
/* Before the pairs. */
void cairn_arbiters_begin(cairn_world *world);
/* After the pairs: forget the arbiters that none of them refreshed. */
void cairn_arbiters_sweep(cairn_world *world);
/* Forget the arbiters of a body and wake its partners. */
void cairn_arbiters_remove_body(cairn_world *world, uint16_t body);
/* Wake all that it touches. */
void cairn_arbiters_wake_partners(cairn_world *world, uint16_t body);
/* After a change of a body's material. */
void cairn_arbiters_refresh_materials(cairn_world *world, uint16_t body);
/* After a change of the sub-step. */
void cairn_arbiters_scale_impulses(cairn_world *world, cairn_wide factor);

/* What b takes of a change. */
static inline cairn_share cairn_arbiter_share_b(const cairn_arbiter *arbiter) { return CAIRN_SHARE(1) - arbiter->share_a; }
/* Mixed when it is asked for, which is where a contact is beyond its kinetic cone. */
cairn_factor cairn_arbiter_static_friction(const cairn_world *world, const cairn_arbiter *arbiter);
/* Of its impulses: outside of blocks they are what they are. */
static inline int cairn_arbiter_exponent(const cairn_arbiter *arbiter)
{
    return CAIRN_WITH_BLOCKS && (arbiter->block & CAIRN_BLOCK_NUMBER) ? arbiter->past.block.exponent : 0;
}
static inline cairn_arbiter *cairn_arbiter_at(const cairn_world *world, uint16_t place) { return &world->arbiters[world->order[place]]; }

/* ---- meet.c ---- */
/* Both bodies come within reach of one another's boxes: refresh their arbiter. Each pair once a step. */
void cairn_arbiter_pair(cairn_world *world, uint16_t a, uint16_t b);
/* The contact of two shapes in the places given, whichever of them has the higher rank. */
void cairn_poses_collide(const cairn_pose *a, const cairn_pose *b, cairn_offset margin, cairn_manifold *out);
/* The longest way that is looked along past a corner, along x and y, unless the two go farther in two steps. */
#define CAIRN_LOOK_WAY CAIRN_OFFSET(0.032)
/* A body where it is now, with its centre of mass at (x, y). */
void cairn_body_pose(const cairn_body *body, cairn_offset x, cairn_offset y, cairn_pose *out);
/* The manifold of two bodies where they are now. */
void cairn_bodies_collide(const cairn_body *a, const cairn_body *b, cairn_offset margin, cairn_manifold *out);

/* It pushes in this step. */
static inline void cairn_arbiter_engage(cairn_world *world, cairn_arbiter *arbiter, cairn_body *a, cairn_body *b)
{
    arbiter->flags |= CAIRN_ARBITER_SOLVED;
    if (CAIRN_ASKS_WHO_MET) {
        a->flags |= CAIRN_BODY_MET;
        b->flags |= CAIRN_BODY_MET;
    }
    if (CAIRN_WITH_BLOCKS && arbiter->block != 0) {
        world->uneven |= arbiter->block;
    }
}

/* ---- idle.c: contacts that do nothing in this step ---- */
/* Of one without friction: if it does nothing else either it is left out of this step. fresh is CAIRN_PATH_FRESH or 0. */
bool cairn_arbiter_idle(cairn_world *world, cairn_arbiter *arbiter, unsigned fresh);
/* Of one whose rows hold. */
void cairn_arbiter_engage_unless_idle(cairn_world *world, cairn_arbiter *arbiter);
/* After the search: those whose bodies something else acts on are no idle ones. */
void cairn_arbiters_rouse(cairn_world *world);

/* ---- fast bodies ---- */
/* Does this step's motion carry the body further than a quarter of its smallest half size? */
bool cairn_body_is_fast(const cairn_world *world, const cairn_body *body);

/* ---- hold.c: contacts at rest ---- */
/* At the end of the step: follow the points of all contacts by the motion of their bodies, without looking at their shapes. */
void cairn_arbiters_follow(cairn_world *world);
/* Do the rows of the step before serve for this one? */
static inline bool cairn_arbiter_holds(const cairn_arbiter *arbiter, const cairn_body *a, const cairn_body *b)
{
    unsigned either = a->flags | b->flags, held_by_springs = a->flags & b->flags & CAIRN_BODY_SPRUNG;
    return CAIRN_WITH_HOLD && (int8_t)arbiter->path > CAIRN_PATH_NONE
        && (!(either & (CAIRN_BODY_FAST | CAIRN_BODY_ASLEEP | CAIRN_BODY_SPRUNG)) || (!(either & (CAIRN_BODY_FAST | CAIRN_BODY_ASLEEP)) && !held_by_springs));
}
/* Not a slip that a contact may have: all of its past is forgotten. */
#define CAIRN_LET_GO CAIRN_MOTION(1)
/* How fast what two points have slipped is taken back, a sub-step. */
static inline cairn_motion cairn_arbiter_pull(const cairn_world *world, const cairn_arbiter *arbiter)
{
    return !CAIRN_WITH_HOLD || arbiter->slip >= CAIRN_LET_GO ? 0 : cairn_motion_ratio_short(arbiter->slip, cairn_world_stick(world));
}
/* From here on nothing is known of the contact's past. */
void cairn_arbiter_let_go(cairn_arbiter *arbiter);
/* In the next step its rows are to be made anew. */
static inline void cairn_arbiter_doubt(cairn_arbiter *arbiter) { arbiter->path |= CAIRN_PATH_DOUBTED; }
/* Its path is another one: all are arranged anew if it has another turn. */
static inline void cairn_arbiter_take_turn(cairn_world *world, unsigned before, unsigned path)
{
    world->rearranged = world->rearranged || ((before ^ path) & CAIRN_PATH_TURN) != 0;
}
/* Of a row that is made anew: what slipped before, if it is known. */
void cairn_arbiter_take_hold(const cairn_world *world, cairn_arbiter *arbiter);

/* ---- sweep.c ---- */
/* A contact's path by its rows; fresh is CAIRN_PATH_FRESH or 0. */
uint8_t cairn_arbiter_path_of(const cairn_world *world, const cairn_arbiter *arbiter, unsigned fresh);

/* ---- rows.c: one contact point as a row of the constraint system ---- */
/* The lever of an arm; 0 where the body cannot turn. */
cairn_lever cairn_body_lever(const cairn_body *body, cairn_offset arm);
/* Levers, shares and effective masses from the manifold; keeps the impulses of points that persist. */
void cairn_arbiter_prepare(cairn_world *world, cairn_arbiter *arbiter, const cairn_manifold *manifold);
/* By its levers: the sweeps' quick ways have room for short ones and for bodies that are free to move. */
void cairn_arbiter_mark_careful(cairn_arbiter *arbiter, const cairn_body *a, const cairn_body *b);

/* ---- slide.c: levers follow bodies that slide past one another ---- */
/* What moves by less to one another, m a sub-step, hardly slides: below 1 m/s at 4 sub-steps. */
#define CAIRN_SLIDES CAIRN_MOTION(0.004)
/* Are both free to move, and is one no circle? */
bool cairn_arbiter_may_slide(const cairn_body *a, const cairn_body *b);
/* Do such two slide so fast that it matters, and yet not past one another at once? */
bool cairn_arbiter_slips_fast(const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter);
static inline bool cairn_arbiter_slips_past(const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter)
{
    cairn_size size = cairn_size_with(cairn_size_of(b->vx - a->vx), b->vy - a->vy);
    return CAIRN_HAS_SLIDES && !cairn_size_is_below(size, CAIRN_SLIDES) && cairn_arbiter_slips_fast(a, b, arbiter);
}
/* After b has moved by (x, y) to a. */
void cairn_arbiter_slide(const cairn_body *a, const cairn_body *b, cairn_arbiter *arbiter, cairn_offset x, cairn_offset y);

/* How far two points have come apart in this step along a direction, with the levers that belong to it. */
static inline cairn_motion cairn_displacement_along(const cairn_body *a, const cairn_body *b, cairn_dir x, cairn_dir y, cairn_lever ja, cairn_lever jb)
{
    cairn_offset dx = cairn_offset_from_motion(b->dx) - cairn_offset_from_motion(a->dx);
    cairn_offset dy = cairn_offset_from_motion(b->dy) - cairn_offset_from_motion(a->dy);
    if (!CAIRN_WITH_TURNING) {
        return cairn_motion_from_offset(cairn_motion_along(dx, dy, x, y));
    }
    return cairn_motion_from_offset(cairn_motion_along(dx, dy, x, y) + cairn_motion_lever(cairn_offset_from_motion(b->dw), jb)
                                    - cairn_motion_lever(cairn_offset_from_motion(a->dw), ja));
}

/* The same for the points of a row. */
static inline cairn_motion cairn_row_displacement(const cairn_body *a, const cairn_body *b, const cairn_arbiter *arbiter, const cairn_row *row)
{
    return cairn_displacement_along(a, b, arbiter->normal_x, arbiter->normal_y, row->lever_a, row->lever_b);
}

/*
 * Whether a point was farther apart when the step began than what lies or slides: its impulse stopped an approach. To repeat that in the
 * next sub-step, or to begin the next step with it, would throw the bodies apart.
 */
static inline bool cairn_row_came_flying(const cairn_row *row) { return row->gap > CAIRN_MOTION(0.005); }
/* Only impacts leave a row to the next one. */
static inline bool cairn_row_is_in_flight(const cairn_row *row) { return CAIRN_WITH_BOUNCE && (row->feature & CAIRN_ROW_IN_FLIGHT) != 0; }

/*
 * Soft contacts: h w0 = 1.559 and damping ratio 4.76. Numerics found pi / 2 and 5; these are as near to it as sums of two shifts come, which
 * is what the sub-steps take for each body and row.
 */
#define CAIRN_SOFT_BETA_64THS 9 /* share of the penetration corrected in a sub-step */
#define CAIRN_SOFT_BETA_NUMBER (CAIRN_SOFT_BETA_64THS / 64.0)
#define CAIRN_SOFT_BETA CAIRN_RATIO(CAIRN_SOFT_BETA_NUMBER)
/* Of a displacement of n sub-steps, at most 0.93 n / (1 + beta n) = 4.6 m. */
static inline cairn_motion cairn_soft_lean(cairn_motion x) { return cairn_motion_shifted(x + cairn_motion_shifted(x, 3), 3); }
/* 7/128: of the accumulated impulse that is given back, and that the effective mass lacks */
static inline cairn_motion cairn_soft_yield(cairn_motion x) { return cairn_motion_shifted(x - cairn_motion_shifted(x, 3), 4); }
/* Greatest accumulated impulse, m per sub-step; keeps every sum of the sweeps within Q4.28. */
#define CAIRN_IMPULSE_MAX CAIRN_MOTION(2.49)
/* Greatest speed and spin inside of the sweeps, m per sub-step, for the same reason. */
#define CAIRN_SWEEP_SPEED CAIRN_MOTION(0.93)
#define CAIRN_SWEEP_SPIN CAIRN_MOTION(0.93)
#define CAIRN_SWEEP_SPEED_WIDE CAIRN_WIDE_PART(0.93)
/* u, the velocity before the change that the next sub-step repeats, another way: cut so that 2 v - u has room. */
static inline cairn_motion cairn_motion_before(cairn_motion u, cairn_motion by) { return cairn_motion_clamp(cairn_motion_add(u, by), CAIRN_MOTION(3.9)); }
/* What an impulse of any size adds to a spin: cut to what the product has room for, enough to turn a corner's spin round. */
static inline cairn_motion cairn_twist(cairn_motion impulse, cairn_lever j)
{
    return cairn_motion_lever(cairn_motion_clamp(impulse, CAIRN_IMPULSE_MAX), j);
}

/* ---- spring.c, through the class so that worlds without springs do not link it ---- */
typedef struct cairn_spring_class {
    void (*prepare)(cairn_world *world);
    void (*substep)(cairn_world *world, int substep);
    bool (*joined)(const cairn_world *world, uint16_t a, uint16_t b); /* by a spring without contact */
    void (*remove_body)(cairn_world *world, uint16_t body);
    void (*wake)(cairn_world *world, uint16_t body); /* what is at the other ends of its springs */
    void (*link)(cairn_world *world, void (*visit)(cairn_world *world, uint16_t a, uint16_t b)); /* for sleep */
} cairn_spring_class;

#endif
