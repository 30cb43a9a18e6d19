/* The one source of the kernels of every vector width; included by kernels_plain.c and the like,
 * which say the width. No guard: each includes it once. See kernels.h for what they do. */
#include "common/base/elementary.h"
#include "learner/kernels/kernels.h"

enum { WIDTH = KERNELS_WIDTH, PARTS = KERNEL_LANES / WIDTH, LANES = KERNEL_LANES, GROUP = 4 };

/* A vector of the width, and the same where its address may be any number's. */
typedef double vec __attribute__((vector_size(sizeof(double) * WIDTH), may_alias));
typedef double loose
    __attribute__((vector_size(sizeof(double) * WIDTH), may_alias, aligned(sizeof(double))));

extern const struct kernels KERNELS_TABLE;

/* Eight lanes. */
struct lanes {
    vec part[PARTS];
};

static inline void clear(struct lanes *sum)
{
    for (int h = 0; h < PARTS; h++)
        sum->part[h] = (vec){0};
}

/* sum += a b, the eight numbers from a and from b on */
static inline void add_products(struct lanes *sum, const double *a, const double *b)
{
    for (int h = 0; h < PARTS; h++)
        sum->part[h] += ((const loose *)a)[h] * ((const loose *)b)[h];
}

static inline double total(const struct lanes *sum)
{
    const double *lane = (const double *)sum->part;

    return ((lane[0] + lane[4]) + (lane[2] + lane[6])) +
           ((lane[1] + lane[5]) + (lane[3] + lane[7]));
}

static inline double dot_of(int n, const double *a, const double *b)
{
    struct lanes sum;
    int i = 0;

    clear(&sum);
    for (; i + LANES <= n; i += LANES)
        add_products(&sum, a + i, b + i);
    double all = total(&sum);
    for (; i < n; i++)
        all += a[i] * b[i];
    return all;
}

static double dot(int n, const double *a, const double *b)
{
    return dot_of(n, a, b);
}

static void apply(int n, int count, const double *rows, const double *v, double *out)
{
    for (int i = 0; i < count; i++)
        out[i] = dot_of(n, rows + (size_t)i * (size_t)n, v);
}

static void add(int n, double step, const double *restrict x, double *restrict y)
{
    for (int i = 0; i < n; i++)
        y[i] += step * x[i];
}

/* v - row for each of n rows of lanes. */
static inline const vec *subtract_rows(int n, const double *v, const vec *row, vec (*offset)[PARTS])
{
    for (int i = 0; i < n; i++)
        for (int h = 0; h < PARTS; h++)
            offset[i][h] = v[i] - *row++;
    return row;
}

/* y += the n rows times offset */
static inline const vec *multiply_rows(int n, const vec *row, vec (*offset)[PARTS], vec *y)
{
    for (int c = 0; c < n; c++)
        for (int h = 0; h < PARTS; h++)
            y[h] += *row++ * offset[c][h];
    return row;
}

/* |G offset|^2 for a lower triangle of rows of lanes. */
static inline const vec *squared_length(int n, const vec *row, vec (*offset)[PARTS],
                                        struct lanes *sum)
{
    clear(sum);
    for (int r = 0; r < n; r++) {
        vec y[PARTS] = {{0}};
        row = multiply_rows(r + 1, row, offset, y);
        for (int h = 0; h < PARTS; h++)
            sum->part[h] += y[h] * y[h];
    }
    return row;
}

static void distances(int d, int n_blocks, const double *block, const double *z, double *q)
{
    for (int b = 0; b < n_blocks; b++) {
        const vec *row = (const vec *)block;
        vec offset[LEARNER_MAX_INPUTS][PARTS];
        struct lanes sum;
        row = subtract_rows(d, z, row, offset);
        row = squared_length(d, row, offset, &sum);
        memcpy(q + (size_t)b * LANES, sum.part, sizeof sum.part);
        block = (const double *)row;
    }
}

/* Where row i of a packed lower triangle begins. */
static inline size_t row_of(int i)
{
    return (size_t)i * ((size_t)i + 1) / 2;
}

static void leverages(int p, const double *block, const double *phi, double *leverage)
{
    vec offset[LEARNER_MAX_INPUTS][PARTS];
    struct lanes sum;
    const vec *row = subtract_rows(p, phi, (const vec *)block, offset);

    (void)squared_length(p, row, offset, &sum);
    memcpy(leverage, sum.part, sizeof sum.part);
}

static void regress(int p, int n_outputs, const double *block, const double *phi, const double *x,
                    double *xhat, double *misfit)
{
    vec offset[LEARNER_MAX_INPUTS][PARTS];
    struct lanes sum;
    const vec *row = subtract_rows(p, phi, (const vec *)block, offset);

    row += row_of(p) * PARTS;
    clear(&sum);
    for (int i = 0; i < n_outputs; i++) {
        const vec *per_psi = row;
        vec y[PARTS] = {{0}};
        row = multiply_rows(p, row + 2 * PARTS, offset, y);
        for (int h = 0; h < PARTS; h++) {
            y[h] += per_psi[PARTS + h];
            sum.part[h] += (x[i] - y[h]) * (x[i] - y[h]) * per_psi[h];
        }
        memcpy(xhat + (size_t)i * LANES, y, sizeof y);
    }
    memcpy(misfit, sum.part, sizeof sum.part);
}

static double bounds(int n, const double *restrict a, double factor, const double *restrict b,
                     double *restrict out)
{
    double largest[LANES];
    int j = 0;

    for (int l = 0; l < LANES; l++)
        largest[l] = -(double)INFINITY;
    for (int i = 0; i < n; i++)
        out[i] = a[i] + factor * b[i];
    for (; j + LANES <= n; j += LANES)
        for (int l = 0; l < LANES; l++)
            largest[l] = out[j + l] > largest[l] ? out[j + l] : largest[l];
    for (; j < n; j++)
        largest[0] = out[j] > largest[0] ? out[j] : largest[0];
    for (int l = 1; l < LANES; l++)
        largest[0] = largest[l] > largest[0] ? largest[l] : largest[0];
    return largest[0];
}

static void log_student(int n, const double *restrict q, const double *restrict per_a,
                        const double *restrict exponent, const double *restrict log_norm,
                        double *restrict log_t)
{
    for (int j = 0; j < n; j++)
        log_t[j] = log_norm[j] - exponent[j] * elementary_log1p(q[j] * per_a[j]);
}

/* y of `count` rows from `row` on; columns before `whole`, a multiple of 8, in lanes, the others
 * one after the other. All rows at once, for v is then loaded once. */
static inline void whiten_rows(int count, int row, int whole, const double *G, const double *v,
                               double *y)
{
    struct lanes sum[GROUP];

    for (int r = 0; r < count; r++)
        clear(&sum[r]);
    for (int c = 0; c < whole; c += LANES)
        for (int r = 0; r < count; r++)
            add_products(&sum[r], G + row_of(row + r) + c, v + c);
    for (int r = 0; r < count; r++) {
        const double *rest = G + row_of(row + r);
        y[row + r] = total(&sum[r]);
        for (int c = whole; c <= row + r; c++)
            y[row + r] += rest[c] * v[c];
    }
}

/* back += G' y for the same rows. */
static inline void back_rows(int count, int row, int whole, const double *G, const double *y,
                             double *back)
{
    for (int c = 0; c < whole; c += WIDTH) {
        loose *to = (loose *)(back + c);
        vec sum = *to;
        for (int r = 0; r < count; r++)
            sum += y[row + r] * *(const loose *)(G + row_of(row + r) + c);
        *to = sum;
    }
    for (int r = 0; r < count; r++)
        for (int c = whole; c <= row + r; c++)
            back[c] += y[row + r] * G[row_of(row + r) + (size_t)c];
}

static void whiten(int n, const double *G, const double *v, double *y, double *back)
{
    int row = 0;

    memset(back, 0, (size_t)n * sizeof *back);
    for (; row + GROUP <= n; row += GROUP) {
        whiten_rows(GROUP, row, row / LANES * LANES, G, v, y);
        back_rows(GROUP, row, row / LANES * LANES, G, y, back);
    }
    for (; row < n; row++) {
        whiten_rows(1, row, row / LANES * LANES, G, v, y);
        back_rows(1, row, row / LANES * LANES, G, y, back);
    }
}

/* `count` rows of rotate(). */
static inline void rotate_rows(int count, int row, int whole, double *G, const double *keep,
                               const double *take, const double *grow, double *s)
{
    for (int c = 0; c < whole; c += WIDTH) {
        vec sum = *(loose *)(s + c);
        for (int r = row; r < row + count; r++) {
            loose *at = (loose *)(G + row_of(r) + c);
            vec old = *at;
            *at = keep[r] * old - take[r] * sum;
            sum += grow[r] * old;
        }
        *(loose *)(s + c) = sum;
    }
    for (int r = row; r < row + count; r++)
        for (int c = whole; c <= r; c++) {
            double *at = G + row_of(r) + c;
            double old = *at;
            *at = keep[r] * old - take[r] * s[c];
            s[c] += grow[r] * old;
        }
}

static void rotate(int n, int first, double *G, const double *keep, const double *take,
                   const double *grow, double *s)
{
    int row = first;

    for (; row + GROUP <= n; row += GROUP)
        rotate_rows(GROUP, row, row / LANES * LANES, G, keep, take, grow, s);
    for (; row < n; row++)
        rotate_rows(1, row, row / LANES * LANES, G, keep, take, grow, s);
}

#include "learner/kernels/kernels_three.h"

static void deviations(int n, int n_outputs, size_t stride, const double *restrict x,
                       const double *restrict weight, const double *restrict center,
                       double *restrict deviation, double *restrict nearest)
{
    for (int a = 0; a < n; a++)
        deviation[a] = 0.0;
    for (int i = 0; i < n_outputs; i++)
        for (int a = 0; a < n; a++) {
            double off = x[(size_t)i * stride + (size_t)a] - center[i];
            deviation[a] += off * off * weight[(size_t)i * stride + (size_t)a];
        }
    for (int a = 0; a < n; a++)
        nearest[a] = deviation[a] < nearest[a] ? deviation[a] : nearest[a];
}

static void memberships(int n, double *restrict p, const double *restrict nearest,
                        double *restrict sum)
{
    for (int a = 0; a < n; a++) {
        p[a] = elementary_exp(-0.5 * (p[a] - nearest[a]));
        sum[a] += p[a];
    }
}

static void normalise(int n, double *restrict p, const double *restrict sum)
{
    for (int a = 0; a < n; a++)
        p[a] /= sum[a];
}

static void weighted_sums(int n, const double *p, const double *weight, const double *x,
                          double *top, double *bottom)
{
    struct lanes tops;
    struct lanes bottoms;

    clear(&tops);
    clear(&bottoms);
    for (int a = 0; a < n; a += LANES)
        for (int h = 0; h < PARTS; h++) {
            vec w = ((const loose *)(p + a))[h] * ((const loose *)(weight + a))[h];
            tops.part[h] += w * ((const loose *)(x + a))[h];
            bottoms.part[h] += w;
        }
    *top = total(&tops);
    *bottom = total(&bottoms);
}

const struct kernels KERNELS_TABLE = {
    .dot = dot,
    .apply = apply,
    .add = add,
    .distances = distances,
    .log_student = log_student,
    .leverages = leverages,
    .regress = regress,
    .bounds = bounds,
    .whiten = whiten,
    .rotate = rotate,
    .whiten_three = whiten_three,
    .solve = solve,
    .rotate_often = rotate_often,
    .deviations = deviations,
    .memberships = memberships,
    .normalise = normalise,
    .weighted_sums = weighted_sums,
};
