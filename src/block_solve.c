/*
 * The dense solve of a block: find impulses x within their bounds so that each row's velocity w = w0 + K x vanishes, or
 * points away from the bound that it meets (a linear complementarity problem). An active set is guessed from the impulses
 * that there are; rows that contradict it are flipped all at once at first, then one at a time (principal
 * pivoting, Judice and Pires 1994; Murty's least-index rule, which ends for any positive definite matrix).
 *
 * The equations of a set are solved for the change alone, by L D L^T in Q2.30. Scaled to a diagonal in [1/4, 1), a positive
 * definite matrix has no element above 1, nor has any Schur complement; a pivot d can be as small as the inverse of
 * the mass ratio, then the column below it is at most sqrt(d). Residuals are computed from the bodies' velocities again after each
 * solve, so rounding in the factors only costs another round.
 */
#include "block.h"

/* Residuals below this, m per sub-step, are rounding. */
#define ROUNDING CAIRN_MOTION(1.5e-8)
/* Added to the scaled diagonal, on changes only: keeps equal rows apart, far below a pivot of ratio 1e5. */
#define PROXIMAL CAIRN_UNIT(5e-7)
/* Rounds in which all rows flip that contradict, and rounds in which one does. */
#define FLIP_ALL 8
#define FLIP_ONE 12
/* Solves with the same set. */
#define REFINEMENTS 3
/* Two bits more for the scaled vectors than a motion has. */
#define GUARD_BITS 2

/* Where a row of the lower triangle ends, on the diagonal. In the same column the entry of a row lies as many places behind that of the row before as its number. */
static inline int corner(int row) { return row * (row + 3) / 2; }

/* ---- the matrix ---- */

/* What an impulse along row c changes in row r, over a body that both touch. */
static cairn_unit through(const cairn_block_body *body, const cairn_block_row *r, cairn_lever jr, const cairn_block_row *c, cairn_lever jc, int exponent)
{
    bool moves = !cairn_body_is_fixed(body->body);
    return cairn_unit_coupling(moves ? r->x : 0, moves ? r->y : 0, jr, c->x, c->y, jc, body->inverse, exponent);
}

/* Over both ends of both: what pushes one and pulls the other counts against it. */
static cairn_unit couple(const cairn_block *block, const cairn_block_row *r, const cairn_block_row *c, int exponent)
{
    const cairn_block_arbiter *row = &block->arbiters[r->arbiter], *column = &block->arbiters[c->arbiter];
    cairn_unit sum = 0;
    for (unsigned ends = 4; ends > 0; ends--) { /* a and a, b and b, a and b, b and a */
        bool at_b = (ends & 1) != 0, to_b = (ends & 2) != 0;
        uint8_t body = at_b ? row->b : row->a;
        if (body == (to_b ? column->b : column->a)) {
            cairn_unit part = through(&block->bodies[body], r, at_b ? r->lever_b : r->lever_a, c, to_b ? c->lever_b : c->lever_a, exponent);
            sum += at_b == to_b ? part : -part;
        }
    }
    return sum;
}

void cairn_block_scale_row(cairn_block *block, int row)
{
    cairn_block_row *r = &block->rows[row];
    cairn_unit sixteenth = couple(block, r, r, -5); /* at most 2 * 9 / 32 */
    r->scale = (int8_t)(sixteenth > 0 ? 2 - cairn_unit_room(sixteenth + sixteenth) : 0);
    block->diagonal[row] = couple(block, r, r, -2 * r->scale);
}

/* ---- velocities ---- */

void cairn_block_press(cairn_block *block, cairn_block_row *row, cairn_push change)
{
    cairn_block_body *a = cairn_block_a(block, row), *b = cairn_block_b(block, row);
    cairn_push x = cairn_push_dir(change, row->x), y = cairn_push_dir(change, row->y);
    block->current = false;
    row->impulse += change;
    a->px -= x;
    a->py -= y;
    a->pw -= cairn_push_lever(change, row->lever_a);
    b->px += x;
    b->py += y;
    b->pw += cairn_push_lever(change, row->lever_b);
}

/* The part of a row's velocity by which a soft contact yields. */
static cairn_push yielding(const cairn_block *block, int row)
{
    const cairn_block_row *r = &block->rows[row];
    cairn_push pressure = cairn_push_shift(cairn_push_unit(r->impulse, block->diagonal[row]), 2 * r->scale);
    return cairn_push_scale(pressure, block->softness);
}

void cairn_block_evaluate(cairn_block *block)
{
    if (block->current) {
        return;
    }
    block->current = true;
    for (int i = 0; i < block->body_count; i++) {
        cairn_block_body *body = &block->bodies[i];
        if (cairn_body_is_fixed(body->body)) {
            body->px = body->py = 0;
        }
        body->vx = cairn_push_from_motion(body->body->vx) + cairn_push_scale(body->px, body->inverse);
        body->vy = cairn_push_from_motion(body->body->vy) + cairn_push_scale(body->py, body->inverse);
        body->vw = cairn_push_from_motion(body->body->w) + cairn_push_scale(body->pw, body->inverse);
    }
    for (int i = 0; i < block->row_count; i++) {
        cairn_block_row *row = &block->rows[i];
        const cairn_block_body *a = cairn_block_a(block, row), *b = cairn_block_b(block, row);
        row->residual = cairn_push_dir(b->vx - a->vx, row->x) + cairn_push_dir(b->vy - a->vy, row->y)
                      + cairn_push_lever(b->vw, row->lever_b) - cairn_push_lever(a->vw, row->lever_a)
                      + cairn_push_from_motion(row->bias) + (row->kind == CAIRN_ROW_SOFT ? yielding(block, i) : 0);
    }
}

/* ---- equations of the free rows ---- */

CAIRN_ONCE cairn_block_row *free_row(cairn_block *block, int n) { return &block->rows[block->factors.rows[n]]; }

/* Which rows are free; false if the factors are those of other ones. */
CAIRN_ONCE bool collect(const cairn_block *block, cairn_block_factors *f)
{
    bool same = true;
    int count = 0;
    for (int i = 0; i < block->row_count; i++) {
        if (block->rows[i].state == CAIRN_ROW_FREE) {
            same = same && count < f->count && f->rows[count] == i;
            f->rows[count++] = (uint8_t)i;
        }
    }
    same = same && count == f->count;
    f->count = count;
    return same && f->valid;
}

static void fill(cairn_block *block, cairn_block_factors *f)
{
    cairn_unit *entry = f->column;
    for (int n = 0; n < f->count; n++) {
        const cairn_block_row *r = free_row(block, n);
        for (int k = 0; k < n; k++) {
            const cairn_block_row *c = free_row(block, k);
            *entry++ = couple(block, r, c, -r->scale - c->scale);
        }
        cairn_unit d = block->diagonal[f->rows[n]];
        *entry++ = d + (r->kind == CAIRN_ROW_SOFT ? cairn_unit_scale(d, block->softness, 0) : 0) + PROXIMAL;
    }
}

/* L D L^T, column by column. */
CAIRN_ONCE void factorise(cairn_block_factors *f)
{
    for (int j = 0; j < f->count; j++) {
        const cairn_unit *below = &f->column[corner(j)];
        cairn_unit d = *below < PROXIMAL / 2 ? PROXIMAL / 2 : *below; /* by rounding only */
        int room = cairn_unit_room(d);
        f->inverse[j] = cairn_wide_inverse(cairn_wide_from_unit(d));
        for (int k = j + 1; k < f->count; k++) {
            below += k;
            if (*below == 0) {
                continue;
            }
            cairn_unit l = cairn_unit_scale(*below, f->inverse[j], -room); /* at most 2, as below^2 <= d */
            const cairn_unit *from = below - k;
            cairn_unit *to = &f->column[corner(k) - k];
            for (int i = k; i < f->count; i++) {
                from += i;
                to += i;
                *to -= cairn_unit_mul(cairn_unit_grow(*from, room), l);
            }
        }
    }
}

/* Residuals become the changes of the impulses, scaled until the end. */
static void substitute(cairn_block *block, const cairn_block_factors *f)
{
    for (int j = 0; j < f->count; j++) {
        cairn_block_row *row = free_row(block, j);
        row->residual = cairn_push_shift(-row->residual, GUARD_BITS - row->scale);
    }
    for (int j = 0; j < f->count; j++) {
        cairn_block_row *row = free_row(block, j);
        const cairn_unit *below = &f->column[corner(j)];
        row->residual = cairn_push_scale(row->residual, f->inverse[j]);
        for (int i = j + 1; i < f->count; i++) {
            below += i;
            free_row(block, i)->residual -= cairn_push_unit(row->residual, *below);
        }
    }
    for (int j = f->count - 1; j >= 0; j--) {
        cairn_block_row *row = free_row(block, j);
        const cairn_unit *below = &f->column[corner(j)];
        cairn_push sum = 0;
        for (int i = j + 1; i < f->count; i++) {
            below += i;
            sum += cairn_push_unit(free_row(block, i)->residual, *below);
        }
        row->residual = cairn_push_clamp(row->residual - cairn_push_scale(sum, f->inverse[j]), CAIRN_PUSH_MAX);
    }
    for (int j = 0; j < f->count; j++) {
        cairn_block_row *row = free_row(block, j);
        row->residual = cairn_push_shift(row->residual, -GUARD_BITS - row->scale);
    }
}

static bool is_met(cairn_block *block)
{
    for (int j = 0; j < block->factors.count; j++) {
        cairn_push residual = free_row(block, j)->residual;
        if (residual > ROUNDING || residual < -ROUNDING) {
            return false;
        }
    }
    return true;
}

/* Bring the free rows' residuals to zero. */
static void solve_free(cairn_block *block)
{
    cairn_block_factors *f = &block->factors;
    f->valid = collect(block, f);
    if (!f->valid && !is_met(block)) {
        fill(block, f);
        factorise(f);
        f->valid = true;
    }
    for (int i = 0; i < REFINEMENTS && !is_met(block); i++) {
        substitute(block, f);
        for (int j = 0; j < f->count; j++) {
            cairn_block_row *row = free_row(block, j);
            cairn_block_press(block, row, cairn_push_clamp(row->impulse + row->residual, CAIRN_PUSH_MAX) - row->impulse);
        }
        cairn_block_evaluate(block);
    }
}

/* ---- the active set ---- */

static cairn_push least(const cairn_block_row *row) { return row->kind == CAIRN_ROW_FRICTION ? -row->limit : 0; }

static cairn_block_state wanted(const cairn_block_row *row)
{
    if (row->state == CAIRN_ROW_FREE) {
        return row->impulse < least(row) ? CAIRN_ROW_LOW : row->impulse > row->limit ? CAIRN_ROW_HIGH : CAIRN_ROW_FREE;
    }
    bool yields = row->state == CAIRN_ROW_LOW ? row->residual < -2 * ROUNDING : row->residual > 2 * ROUNDING;
    return yields ? CAIRN_ROW_FREE : (cairn_block_state)row->state;
}

/* Flip rows that contradict, at most so many, from the last on. True if there were any. */
static bool flip(cairn_block *block, int most)
{
    int flipped = 0;
    for (int i = block->row_count - 1; i >= 0 && flipped < most; i--) {
        cairn_block_row *row = &block->rows[i];
        cairn_block_state state = row->limit > 0 ? wanted(row) : (cairn_block_state)row->state;
        if (state != (cairn_block_state)row->state) {
            row->state = (uint8_t)state;
            flipped++;
        }
    }
    return flipped > 0;
}

/* Rows at a bound have its impulse. */
static void hold_bounds(cairn_block *block)
{
    for (int i = 0; i < block->row_count; i++) {
        cairn_block_row *row = &block->rows[i];
        cairn_push bound = row->state == CAIRN_ROW_LOW ? least(row) : row->limit;
        if (row->state >= CAIRN_ROW_LOW && row->impulse != bound) {
            cairn_block_press(block, row, bound - row->impulse);
        }
    }
}

bool cairn_block_settle(cairn_block *block)
{
    for (int round = 0; round < FLIP_ALL + FLIP_ONE; round++) {
        hold_bounds(block);
        cairn_block_evaluate(block);
        solve_free(block);
        if (!flip(block, round < FLIP_ALL ? CAIRN_BLOCK_ROWS : 1)) {
            return true;
        }
    }
    return false;
}
