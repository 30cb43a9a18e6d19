#include <string.h>

#include "learner/body/chain/body.h"

enum { JOINTS = CHAIN_MAX_JOINTS };

/* Goes through the fields in their order, either way. */
struct walk {
    double *numbers;
    bool into; /* from the body into the numbers */
};

static void pass(struct walk *walk, size_t n, double *field)
{
    if (walk->into)
        memcpy(walk->numbers, field, n * sizeof *field);
    else
        memcpy(field, walk->numbers, n * sizeof *field);
    walk->numbers += n;
}

static void pass_int(struct walk *walk, int *field)
{
    double number = *field;

    pass(walk, 1, &number);
    *field = number > -1e9 && number < 1e9 ? (int)number : -1;
}

static void pass_bool(struct walk *walk, bool *field)
{
    double number = *field;

    pass(walk, 1, &number);
    *field = number != 0.0;
}

static void pass_eyes(struct walk *walk, struct eyes *eyes)
{
    pass(walk, 1, &eyes->angle_unit);
    pass(walk, 1, &eyes->disparity_middle);
    pass(walk, 1, &eyes->disparity_unit);
    pass(walk, 3, eyes->neck);
    pass(walk, 3, eyes->eye);
    pass(walk, 2, eyes->tilt);
    pass(walk, 3, eyes->law);
}

static void pass_all(struct walk *walk, struct body *body)
{
    pass_int(walk, &body->chain.n);
    for (int i = 0; i < JOINTS; i++)
        pass_bool(walk, &body->chain.slides[i]);
    pass(walk, JOINTS, body->chain.middle);
    pass(walk, (size_t)3 * JOINTS, body->chain.axis[0]);
    pass(walk, (size_t)3 * JOINTS, body->chain.offset[0]);
    pass_bool(walk, &body->sees);
    pass_eyes(walk, &body->eyes);
    pass(walk, 3, body->noise);
    pass(walk, 1, &body->length);
    pass(walk, 3, body->gravity);
    pass(walk, JOINTS, body->range);
    pass_int(walk, &body->samples);
    pass(walk, 1, &body->error);
    pass(walk, 1, &body->doubt);
    pass(walk, sizeof body->root / sizeof *body->root, body->root);
}

void body_to_numbers(const struct body *body, double *numbers)
{
    struct body copy = *body;
    struct walk walk = {numbers, true};

    pass_all(&walk, &copy);
}

void body_from_numbers(const double *numbers, struct body *body)
{
    double copy[BODY_NUMBERS];
    struct walk walk = {copy, false};

    memcpy(copy, numbers, sizeof copy);
    memset(body, 0, sizeof *body);
    pass_all(&walk, body);
}
