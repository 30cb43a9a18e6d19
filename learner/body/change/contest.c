#include "learner/body/change/contest.h"

#include <math.h>

static const double round_rows = 500.0;
static const double withheld = 50.0; /* at the end of a round; */
static const double counted = 25.0;  /* the last of these count */
static const double memory = 50.0;
static const double enough = 50.0;
static const double gross = 1e4;   /* squared, in units of the noise */
static const double clearly = 0.8; /* of the body's mean square */

struct contest contest_begin(void)
{
    return (struct contest){0};
}

static double left_of_round(const struct contest *contest)
{
    return round_rows - fmod(contest->rows, round_rows);
}

bool contest_withholds(const struct contest *contest)
{
    return left_of_round(contest) <= withheld;
}

bool contest_counts(const struct contest *contest)
{
    return left_of_round(contest) <= counted;
}

void contest_add(struct contest *contest, double polynomial, double body)
{
    if (contest_counts(contest)) {
        contest->scored += 1.0;
        double share = 1.0 / fmin(contest->scored, memory);
        contest->polynomial += share * (fmin(polynomial, gross) - contest->polynomial);
        contest->body += share * (fmin(body, gross) - contest->body);
    }
    contest->rows += 1.0;
}

bool contest_lost(const struct contest *contest)
{
    return contest->scored >= enough && contest->polynomial < clearly * contest->body;
}
