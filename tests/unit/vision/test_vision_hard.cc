/* Hard pictures: how often the ball is found in them, and how exactly. */
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <vector>

#include "tools/pictures/chains.h"

/* Check defines a macro `fail`, which the C++ library uses as a name: it comes last. */
#include "tests/unit/suite.h"

static const int n_pictures = 8;        /* of a row */
static const uint64_t first = 10000;    /* others than those that ./run accuracy draws */
static const double error_most = 0.5;   /* px, the median of a row */
static const double found_least = 0.97; /* of all */
static const double row_least = 0.75;   /* of a row */

struct tally {
    int n = 0;
    int found = 0;
    std::vector<double> errors; /* px */
};

static void look(int row, uint64_t index, tally *all)
{
    const hard_picture picture = picture_draw(row, index);
    const finding found = chain_ours(picture);
    const double error = std::hypot(found.centre.column - picture.centre.column,
                                    found.centre.row - picture.centre.row);

    all->n++;
    all->found += found.seen == picture.has_ball;
    if (!found.seen)
        return;
    ck_assert_msg(picture.has_ball && error < std::max(3.0, 0.1 * picture.radius),
                  "%s %d: wrong by %.1f px", picture_rows[row], static_cast<int>(index), error);
    all->errors.push_back(error);
}

static double median(std::vector<double> *values)
{
    if (values->empty())
        return 0;
    const auto middle = values->begin() + static_cast<long>(values->size() / 2);
    std::nth_element(values->begin(), middle, values->end());
    return *middle;
}

START_TEST(balls_are_found_and_nothing_else)
{
    tally all;

    for (int row = 0; picture_rows[row]; row++) {
        tally one;
        for (int i = 0; i < n_pictures; i++)
            look(row, first + static_cast<uint64_t>(i), &one);
        const double error = median(&one.errors);
        printf("%-20s %d of %d, %.3f px\n", picture_rows[row], one.found, one.n, error);
        ck_assert_double_lt(error, error_most);
        ck_assert_int_ge(one.found, static_cast<int>(row_least * one.n));
        all.n += one.n;
        all.found += one.found;
        all.errors.insert(all.errors.end(), one.errors.begin(), one.errors.end());
    }
    ck_assert_double_ge(all.found, found_least * all.n);
    const double error = median(&all.errors);
    printf("%d of %d, median error %.3f px\n", all.found, all.n, error);
    ck_assert_double_lt(error, 0.1);
}
END_TEST

int main()
{
    const TTest *const tests[] = {
        balls_are_found_and_nothing_else,
    };

    return SUITE_RUN("vision hard", tests);
}
