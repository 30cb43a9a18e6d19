#include "learner/body/chain/body.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "learner/body/chain/vec3.h"

int body_unknowns(const struct body *body)
{
    return 6 * body->chain.n + (body->sees ? EYES_UNKNOWNS : 0);
}

static bool usable(const double *numbers, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (!(fabs(numbers[i]) <= LEARNER_LARGEST_NUMBER))
            return false;
    return true;
}

static const char *chain_fault(const struct chain *chain)
{
    size_t n = (size_t)chain->n;

    if (!usable(chain->middle, n) || !usable(chain->axis[0], 3 * n) ||
        !usable(chain->offset[0], 3 * n))
        return "a number of the chain is not usable";
    for (int i = 0; i < chain->n; i++)
        if (!(fabs(vec3_length(chain->axis[i]) - 1.0) < 1e-9))
            return "an axis of the chain is no unit vector";
    return NULL;
}

static const char *eyes_fault(const struct eyes *eyes)
{
    if (!usable(&eyes->disparity_middle, 1) || !usable(eyes->neck, 3) || !usable(eyes->eye, 3) ||
        !usable(eyes->tilt, 2) || !usable(eyes->law, 3))
        return "a number of the eyes is not usable";
    if (!(eyes->angle_unit > 0.0 && eyes->angle_unit <= LEARNER_LARGEST_NUMBER &&
          eyes->disparity_unit > 0.0 && eyes->disparity_unit <= LEARNER_LARGEST_NUMBER))
        return "a unit of the eyes is not positive";
    return NULL;
}

int body_check(const struct body *body, char *err, size_t err_size)
{
    const char *fault = NULL;

    if (body->chain.n < 1 || body->chain.n > CHAIN_MAX_JOINTS)
        fault = "its number of joints is out of range";
    if (!fault)
        fault = chain_fault(&body->chain);
    if (!fault && body->sees)
        fault = eyes_fault(&body->eyes);
    if (!fault && !usable(body->range, (size_t)body->chain.n))
        fault = "a range of its joints is not usable";
    size_t n = fault ? 0 : (size_t)body_unknowns(body);
    if (!fault && !usable(body->root, n * (n + 1) / 2))
        fault = "a number of its covariance is not usable";
    for (int i = 0; i < BODY_OUTPUTS && !fault; i++)
        if (!(body->noise[i] > 0.0 && body->noise[i] <= LEARNER_LARGEST_NUMBER))
            fault = "its noise is not positive";
    if (!fault && !(body->length > 0.0 && body->length <= LEARNER_LARGEST_NUMBER))
        fault = "its length is not positive";
    if (!fault && !(fabs(vec3_length(body->gravity) - 1.0) < 1e-9))
        fault = "its gravity is no unit vector";
    if (!fault)
        return 0;
    snprintf(err, err_size, "the body cannot be used: %s", fault);
    return -1;
}

bool body_place(const struct body *body, const double *x, double *place, double *white)
{
    struct eyes_view view;

    if (!body->sees) {
        memcpy(place, x, BODY_OUTPUTS * sizeof *x);
        memset(white, 0, 9 * sizeof *white);
        for (int i = 0; i < 3; i++)
            white[4 * i] = 1.0 / body->noise[i];
        return true;
    }
    if (!eyes_point(&body->eyes, x, &view))
        return false;
    memcpy(place, view.point, sizeof view.point);
    mat3_invert(view.by_x, white);
    for (int i = 0; i < 9; i++)
        white[i] /= body->noise[i / 3];
    return usable(white, 9);
}

bool body_output(const struct body *body, const double *place, double *x, double *by_place)
{
    struct eyes_view view;

    if (!body->sees) {
        memcpy(x, place, BODY_OUTPUTS * sizeof *x);
        memset(by_place, 0, 9 * sizeof *by_place);
        by_place[0] = by_place[4] = by_place[8] = 1.0;
        return true;
    }
    if (!eyes_look_at(&body->eyes, place, x) || !eyes_point(&body->eyes, x, &view))
        return false;
    mat3_invert(view.by_x, by_place);
    return usable(by_place, 9) && usable(x, BODY_OUTPUTS);
}

/* spread += slope L for the rows from i on of L, two at a time: spread is read and written half as
 * often. */
static void add_rows(int n, int i, const double *root, const double *slope,
                     double (*spread)[BODY_MAX_UNKNOWNS])
{
    const double *row = root + (size_t)i * ((size_t)i + 1) / 2;
    const double *next = row + i + 1;

    for (int r = 0; r < 3; r++) {
        double s = slope[r * n + i];
        double t = slope[r * n + i + 1];
        for (int k = 0; k <= i; k++)
            spread[r][k] += s * row[k] + t * next[k];
        spread[r][i + 1] += t * next[i + 1];
    }
}

/* covariance += (slope L)(slope L)' for slope 3 x n. */
static void add_spread(int n, const double *root, const double *slope, double *covariance)
{
    double spread[3][BODY_MAX_UNKNOWNS] = {{0}};

    for (int i = 0; i + 1 < n; i += 2) /* n is even */
        add_rows(n, i, root, slope, spread);
    for (int r = 0; r < 3; r++)
        for (int s = 0; s <= r; s++) {
            double sum = 0.0;
            for (int k = 0; k < n; k++)
                sum += spread[r][k] * spread[s][k];
            covariance[3 * r + s] += sum;
            if (s < r)
                covariance[3 * s + r] += sum;
        }
}

void body_add_doubt(const struct body *body, const struct chain_pose *pose, const double *tip,
                    const double *x, double *covariance)
{
    double slope[3 * BODY_MAX_UNKNOWNS];
    double by_chain[3 * CHAIN_MAX_UNKNOWNS];
    struct eyes_view view;
    int n_chain = 6 * body->chain.n;
    int n = body_unknowns(body);

    chain_slope(&body->chain, pose, tip, by_chain);
    memset(view.by_unknown, 0, sizeof view.by_unknown);
    if (body->sees && !eyes_point(&body->eyes, x, &view))
        return;
    for (int r = 0; r < 3; r++) {
        memcpy(slope + (ptrdiff_t)r * n, by_chain + (ptrdiff_t)r * n_chain,
               (size_t)n_chain * sizeof *slope);
        /* What is seen minus where the chain has it: an error of the eyes counts the other way. */
        for (int k = n_chain; k < n; k++)
            slope[r * n + k] = -view.by_unknown[r * EYES_UNKNOWNS + k - n_chain];
    }
    add_spread(n, body->root, slope, covariance);
}
