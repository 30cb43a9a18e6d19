/* A learner on a body as bytes: saved and loaded it goes on to the byte, and damage is refused. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "learner/base/hash.h"
#include "made_up_arm.h"
#include "tests/unit/learner/bed.h"
#include "tests/unit/suite.h"

enum { JOINTS = 4, MOST_TOOLS = 3 };

static char err[160];
static struct learner_prediction a, b;
static const double tips[MOST_TOOLS][3] = {{0.0, 0.0, 0.05}, {0.2, 0.1, 0.0}, {0.0, -0.3, 0.1}};

static void teach(struct learner *learner, const struct body *body, int samples, int tools)
{
    for (int k = 0; k < samples; k++) {
        double z[JOINTS], x[3];
        random_joints(body, z);
        if (arm_sample(body, tips[k / 20 % tools], z, x))
            learner_update(learner, z, x);
    }
}

static void expect_same_answers(const struct body *body, struct learner *one, struct learner *other)
{
    for (int k = 0; k < 20; k++) {
        double z[JOINTS];
        random_joints(body, z);
        memset(&a, 0, sizeof a);
        memset(&b, 0, sizeof b);
        learner_predict(one, z, &a);
        learner_predict(other, z, &b);
        ck_assert_int_eq(memcmp(&a, &b, sizeof a), 0);
    }
}

static void give(struct learner *learner, const struct body *body)
{
    ck_assert_msg(learner_give_body(learner, body, err, sizeof err) == 0, "%s", err);
}

static void load(struct learner *to, const struct learner *from)
{
    size_t size;
    unsigned char *bytes = bed_saved(from, &size);

    ck_assert_msg(learner_load(to, bytes, size, err, sizeof err) == 0, "%s", err);
    free(bytes);
}

/* With and without eyes; before there is a body, with more experts meanwhile than contexts later,
 * and on one. */
START_TEST(a_loaded_learner_goes_on_to_the_byte)
{
    bed_seed();
    for (int sees = 0; sees < 2; sees++)
        for (int found = 0; found < 2; found++) {
            struct body body = made_up_arm(JOINTS, sees);
            struct learner_config config = body_config(JOINTS, sees, 16);
            struct learner *one = bed_create(&config);
            struct learner *other = bed_create(&config);
            config.n_outliers = 0;
            teach(one, &body, 400, MOST_TOOLS);
            if (found) {
                give(one, &body);
                teach(one, &body, 300, MOST_TOOLS);
            }
            teach(other, &body, 50, 1); /* what it knew is gone then */
            load(other, one);
            bed_expect_same_state(one, other);
            ck_assert_int_eq(learner_body(other) != NULL, found);
            expect_same_answers(&body, one, other);
            for (int k = 0; k < 50; k++) {
                double z[JOINTS], x[3];
                random_joints(&body, z);
                arm_sample(&body, tips[k % MOST_TOOLS], z, x);
                ck_assert_int_eq(learner_update(one, z, x), learner_update(other, z, x));
            }
            bed_expect_same_state(one, other);
            body.length *= 1.01; /* another body: both learn it anew from the same samples */
            give(one, &body);
            give(other, &body);
            bed_expect_same_state(one, other);
            bed_clean();
        }
}
END_TEST

/* Also in one that has learned nothing by itself, as after a kill: the body is given at once. */
START_TEST(a_loaded_learner_takes_a_body_to_the_byte)
{
    bed_seed();
    for (int sees = 0; sees < 2; sees++) {
        struct body body = made_up_arm(JOINTS, sees);
        struct learner_config config = body_config(JOINTS, sees, 16);
        struct learner *one = bed_create(&config);
        struct learner *other = bed_create(&config);
        teach(one, &body, 400, 1);
        load(other, one);
        give(one, &body);
        give(other, &body);
        bed_expect_same_state(one, other);
        bed_clean();
    }
}
END_TEST

/* A state has the mixture's experts or none: however many contexts there are. */
START_TEST(a_body_lets_go_of_the_mixture)
{
    struct learner_config config = body_config(JOINTS, false, 16);
    size_t before;
    size_t after;

    bed_seed();
    struct body body = made_up_arm(JOINTS, false);
    struct learner *learner = bed_create(&config);
    before = learner_save_size(learner);
    teach(learner, &body, 400, MOST_TOOLS);
    ck_assert_uint_gt(learner_save_size(learner), before);
    give(learner, &body);
    after = learner_save_size(learner);
    ck_assert_uint_eq(after, before);
    teach(learner, &body, 400, MOST_TOOLS);
    ck_assert_uint_eq(learner_save_size(learner), after);
    free(bed_saved(learner, &before));
    bed_clean();
}
END_TEST

/* As learner.c has it: 14 words, of which the last is the checksum of all the rest. */
enum { ENVELOPE = 14 * sizeof(uint64_t) };

static void seal(unsigned char *bytes, size_t size)
{
    uint64_t hash = learner_hash(LEARNER_HASH_START, bytes + ENVELOPE, size - ENVELOPE);

    hash = learner_hash(hash, bytes, ENVELOPE - sizeof hash);
    memcpy(bytes + ENVELOPE - sizeof hash, &hash, sizeof hash);
}

/* Every number that cannot be is refused; *before is what the learner stays at. */
static void expect_refused(struct learner *learner, unsigned char *bytes, size_t size, size_t word,
                           double number, const struct learner *before)
{
    unsigned char kept[sizeof number];

    memcpy(kept, bytes + ENVELOPE + word * sizeof number, sizeof kept);
    memcpy(bytes + ENVELOPE + word * sizeof number, &number, sizeof number);
    seal(bytes, size);
    ck_assert_msg(learner_load(learner, bytes, size, err, sizeof err) == -1, "word %zu took %g",
                  word, number);
    ck_assert_int_gt((int)strlen(err), 0);
    memcpy(bytes + ENVELOPE + word * sizeof number, kept, sizeof kept);
    (void)before;
}

START_TEST(numbers_that_cannot_be_are_refused)
{
    enum { HEAD = 18, CHAIN = HEAD, CONTEXT = HEAD + BODY_NUMBERS };
    const double none[] = {NAN, INFINITY, -INFINITY, 1e300};
    struct learner_config config = body_config(JOINTS, false, 16);
    size_t size;

    bed_seed();
    struct body body = made_up_arm(JOINTS, false);
    struct learner *learner = bed_create(&config);
    struct learner *before = bed_create(&config);
    give(learner, &body);
    teach(learner, &body, 200, MOST_TOOLS);
    unsigned char *bytes = bed_saved(learner, &size);
    size_t words = (size - ENVELOPE) / sizeof(double);
    load(before, learner);
    for (size_t word = 0; word < words; word += 1 + (size_t)(word < 300 ? 0 : bed_uniform(0, 4000)))
        expect_refused(learner, bytes, size, word, none[word % 4], before);
    for (size_t word = 0; word < 14; word++) { /* found .. births; of a trial; of changes */
        expect_refused(learner, bytes, size, word, -1.0, before);
        if (word < 4)
            expect_refused(learner, bytes, size, word, 0.5, before);
        if (word < 3)
            expect_refused(learner, bytes, size, word, 18.0, before);
    }
    expect_refused(learner, bytes, size, 14, -2.0, before);          /* the cause of a change */
    expect_refused(learner, bytes, size, 14, JOINTS + 1, before);    /* the same */
    expect_refused(learner, bytes, size, 0, 0.0, before);            /* contexts without a body */
    expect_refused(learner, bytes, size, 2, 1.0, before);            /* both at once */
    expect_refused(learner, bytes, size, CHAIN, JOINTS + 1, before); /* another arm */
    for (size_t word = CONTEXT; word < CONTEXT + 5; word++)          /* support .. twin */
        expect_refused(learner, bytes, size, word, -1.0, before);
    expect_refused(learner, bytes, size, CONTEXT + 1, 1.5, before);    /* a share */
    expect_refused(learner, bytes, size, CONTEXT + 3, 0.5, before);    /* scale */
    expect_refused(learner, bytes, size, CONTEXT + 5, 57.0, before);   /* turn */
    expect_refused(learner, bytes, size, CONTEXT + 6, 3.0, before);    /* chosen */
    expect_refused(learner, bytes, size, CONTEXT + 9, 1024.0, before); /* number */
    expect_refused(learner, bytes, size, CONTEXT + 10, -1.0, before);  /* strain */
    expect_refused(learner, bytes, size, CONTEXT + 11, -1.0, before);  /* slip */
    expect_refused(learner, bytes, size, CONTEXT + 15, 0.0, before);   /* the whitener's diagonal */
    bed_expect_same_state(learner, before);
    seal(bytes, size);
    ck_assert_int_eq(learner_load(learner, bytes, size, err, sizeof err), 0);
    free(bytes);
    bed_clean();
}
END_TEST

/* A state of before there was a body goes into a learner that has one, and the other way. */
START_TEST(what_was_before_is_gone)
{
    struct learner_config config = body_config(JOINTS, false, 16);

    bed_seed();
    struct body body = made_up_arm(JOINTS, false);
    struct learner *without = bed_create(&config);
    struct learner *with = bed_create(&config);
    struct learner *third = bed_create(&config);
    teach(without, &body, 100, 2);
    teach(with, &body, 100, 2);
    give(with, &body);
    load(third, with);
    load(with, without);
    ck_assert_ptr_null(learner_body(with));
    bed_expect_same_state(with, without);
    load(without, third);
    bed_expect_same_state(third, without);
    expect_same_answers(&body, third, without);
    bed_clean();
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        a_loaded_learner_goes_on_to_the_byte,
        a_loaded_learner_takes_a_body_to_the_byte,
        a_body_lets_go_of_the_mixture,
        numbers_that_cannot_be_are_refused,
        what_was_before_is_gone,
    };

    return SUITE_RUN("body store", tests);
}
