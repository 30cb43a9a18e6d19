/* The part of kernels_body.h that serves regressions whose samples have three rows: included by it,
 * once for every vector width.
 *
 * Rows are taken in blocks of eight. The eight columns from the diagonal on are taken as a vector,
 * too, and what lies beyond a row's end counts as zero: no column is left over for one after the
 * other. What is read there is the beginning of the next row, or of what lies behind the triangle.
 */

typedef long long bits __attribute__((vector_size(sizeof(double) * WIDTH), may_alias));

/* Lanes of a block's row r that are not beyond its end. */
static const long long within[LANES][LANES] __attribute__((aligned(64))) = {
    {-1},
    {-1, -1},
    {-1, -1, -1},
    {-1, -1, -1, -1},
    {-1, -1, -1, -1, -1},
    {-1, -1, -1, -1, -1, -1},
    {-1, -1, -1, -1, -1, -1, -1},
    {-1, -1, -1, -1, -1, -1, -1, -1},
};

/* `value` in the lanes of part h that are within row r, elsewhere `other`. */
static inline vec choose_within(int r, int h, vec value, vec other)
{
    bits mask = ((const bits *)within[r])[h];

    return (vec)(((bits)value & mask) | ((bits)other & ~mask));
}

static inline int rows_from(int row, int n)
{
    return n - row < LANES ? n - row : LANES;
}

/* sum += the columns from the diagonal on of row r of a block, times v. */
static inline void add_diagonal(struct lanes *sum, int r, const double *columns, const double *v)
{
    for (int h = 0; h < PARTS; h++)
        sum->part[h] +=
            choose_within(r, h, ((const loose *)columns)[h] * ((const loose *)v)[h], (vec){0});
}

/* y of `count` rows, from row `first` of the block on that begins at `row`. */
static inline void whiten_three_rows(int count, int row, int first, size_t stride, const double *G,
                                     const double *v, double *y)
{
    struct lanes sum[2][3];

    for (int r = 0; r < count; r++)
        for (int k = 0; k < 3; k++)
            clear(&sum[r][k]);
    for (int c = 0; c < row; c += LANES)
        for (int r = 0; r < count; r++)
            for (int k = 0; k < 3; k++)
                add_products(&sum[r][k], G + row_of(row + first + r) + c,
                             v + (size_t)k * stride + c);
    for (int r = 0; r < count; r++)
        for (int k = 0; k < 3; k++) {
            add_diagonal(&sum[r][k], first + r, G + row_of(row + first + r) + row,
                         v + (size_t)k * stride + row);
            y[(size_t)k * stride + (size_t)(row + first + r)] = total(&sum[r][k]);
        }
}

static void whiten_three(int n, size_t stride, const double *G, const double *v, double *y)
{
    for (int row = 0; row < n; row += LANES) {
        int rows = rows_from(row, n);
        int first = 0;
        for (; first + 2 <= rows; first += 2)
            whiten_three_rows(2, row, first, stride, G, v, y);
        if (first < rows)
            whiten_three_rows(1, row, first, stride, G, v, y);
    }
}

/* y = G v of `count` rows as above, then back += G' y of them. */
static inline void solve_rows(int count, int row, int first, const double *G, const double *v,
                              double *y, double *back)
{
    const double *begin[GROUP];
    struct lanes sum[GROUP];

    for (int r = 0; r < count; r++) {
        begin[r] = G + row_of(row + first + r);
        clear(&sum[r]);
    }
    for (int c = 0; c < row; c += LANES)
        for (int r = 0; r < count; r++)
            add_products(&sum[r], begin[r] + c, v + c);
    for (int r = 0; r < count; r++) {
        add_diagonal(&sum[r], first + r, begin[r] + row, v + row);
        y[row + first + r] = total(&sum[r]);
    }
    for (int c = 0; c < row; c += WIDTH)
        for (int r = 0; r < count; r++)
            *(loose *)(back + c) += y[row + first + r] * *(const loose *)(begin[r] + c);
    for (int h = 0; h < PARTS; h++) {
        loose *to = &((loose *)(back + row))[h];
        for (int r = 0; r < count; r++)
            *to = choose_within(
                first + r, h, *to + y[row + first + r] * ((const loose *)(begin[r] + row))[h], *to);
    }
}

static void solve(int n, const double *G, const double *v, double *y, double *back)
{
    memset(back, 0, (size_t)n * sizeof *back);
    for (int row = 0; row < n; row += LANES) {
        int rows = rows_from(row, n);
        int first = 0;
        for (; first + GROUP <= rows; first += GROUP)
            solve_rows(GROUP, row, first, G, v, y, back);
        for (; first < rows; first++)
            solve_rows(1, row, first, G, v, y, back);
    }
}

/* What rotate_often() is given. */
struct turning {
    size_t stride;
    const double *keep, *take, *grow;
    double *s;
};

/* `rows` rows from `row` on, a vector of columns from c on; part h of those from the diagonal on,
 * or -1 before them. */
static inline void rotate_column(int turns, int rows, int row, int c, int h, double *G,
                                 const struct turning *by)
{
    vec sum[GROUP];

    for (int t = 0; t < turns; t++)
        sum[t] = *(loose *)(by->s + (size_t)t * by->stride + c);
    for (int r = 0; r < rows; r++) {
        loose *at = (loose *)(G + row_of(row + r) + c);
        vec was = *at;
        vec now = h < 0 ? was : choose_within(r, h, was, (vec){0});
        for (int t = 0; t < turns; t++) {
            size_t k = (size_t)t * by->stride + (size_t)(row + r);
            vec old = now;
            now = by->keep[k] * old - by->take[k] * sum[t];
            sum[t] += by->grow[k] * old;
        }
        *at = h < 0 ? now : choose_within(r, h, now, was);
    }
    for (int t = 0; t < turns; t++)
        *(loose *)(by->s + (size_t)t * by->stride + c) = sum[t];
}

static inline void rotate_blocks(int turns, int n, double *G, const struct turning *by)
{
    for (int row = 0; row < n; row += LANES) {
        int rows = rows_from(row, n);
        for (int c = 0; c < row; c += WIDTH)
            rotate_column(turns, rows, row, c, -1, G, by);
        for (int h = 0; h < PARTS; h++)
            rotate_column(turns, rows, row, row + h * WIDTH, h, G, by);
    }
}

static void rotate_often(int n, int turns, size_t stride, double *G, const double *keep,
                         const double *take, const double *grow, double *s)
{
    const struct turning by = {stride, keep, take, grow, s};

    if (turns == 3)
        rotate_blocks(3, n, G, &by);
    else
        rotate_blocks(4, n, G, &by);
}
