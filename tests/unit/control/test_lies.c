/* Eyes that lie: each kind of lie is told to a robot that has learned honestly and goes on
 * babbling. None may be learned for more than 2 s, each is told, and what is honest is learned on
 * without an alarm.
 *
 * With REACH_TEST_SEEDS each kind is tried so often on each robot, and what happened goes to the
 * standard output as the rows of a table; without it, only what must always be found is tried. */
#include "fixture.h"
#include "learner/finder/seeker.h"
#include "liar.h"
#include "tests/unit/suite.h"
#include "wide_arm.h"
#include "world.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

enum {
    TOLD = REACH_STATUS_T_STILL | REACH_STATUS_T_JUMPS | REACH_STATUS_T_RESTLESS |
           REACH_STATUS_T_LATE | REACH_STATUS_T_ONE_EYE | REACH_STATUS_T_UNMOVED,
};

static const double patience = 2;         /* s for which a lie may be learned */
static const double watched = 20;         /* s of each lie */
static const double place_noise = 0.0005; /* m */

static struct liar liar;
static struct seeker seeker;
static struct chain chain;

/* A robot, and how long it learns before it is lied to, s. */
struct victim {
    const char *name;
    struct config (*config)(void);
    double honest;
    bool sees, has_body; /* two eyes, else a tracker; the seven joints of wide_arm.h, and a search
                            for their body */
};

static struct config of_eyes(void)
{
    return fixture_robot_config("kobian.yaml");
}

static struct config of_tracker(void)
{
    return fixture_robot_config("icub.yaml");
}

static struct config of_body(void)
{
    return wide_arm_config(place_noise);
}

static const struct victim eyes = {"two eyes", of_eyes, 120, true, false};
static const struct victim tracker = {"a tracker, polynomials", of_tracker, 60, false, false};
static const struct victim body = {"a tracker, a body", of_body, 40, false, true};

/* What one kind of lie did in one run. */
struct outcome {
    double from, until; /* first and last sample that was learned, s */
    int learned;        /* samples */
    double told;        /* when it was told first, s; INFINITY = never */
    int troubles;       /* bits of status_t that told of it */
};

static void step(void)
{
    if (world.robot.has_marker)
        liar_tell(&liar, &world.robot.marker);
    world_step();
    if (world.robot.chain && world.outputs.has_sample)
        seeker_look(&seeker, tick_learner(world.tick));
}

static void begin(const struct victim *victim, int64_t seed)
{
    struct config config = victim->config();
    struct learner_config learner;

    world_begin(config, config.space.kind == SPACE_VISUAL ? 0.3 : place_noise);
    world.robot.random = random_seed(seed);
    liar_init(&liar, &world.config, seed);
    if (victim->has_body) {
        chain = wide_arm(seed);
        world.robot.chain = &chain;
        learner = config_learner(&world.config);
        seeker_init(&seeker, &learner);
    }
    step();
    ck_assert_int_eq(
        world_ask((reach_request_t){
            .kind = REACH_REQUEST_T_BABBLE, .count = 1000000, .seed = seed, .learn = 1}),
        REACH_STATUS_T_ACCEPTED);
}

static bool is_told(void)
{
    const reach_status_t *status = &world.outputs.status;

    return status->troubles & TOLD ||
           status->refused[REACH_STATUS_T_CHANNEL_SENSE][REACH_STATUS_T_TIME] > 0;
}

static struct outcome watch(double seconds)
{
    struct outcome outcome = {.told = INFINITY};
    int ticks = (int)lround(seconds / world.config.period);

    for (int i = 0; i < ticks; i++) {
        double time = i * world.config.period;
        step();
        if (world.outputs.has_sample && world.outputs.sample.learned) {
            if (outcome.learned++ == 0)
                outcome.from = time;
            outcome.until = time;
        }
        outcome.troubles |= world.outputs.status.troubles & TOLD;
        if (is_told())
            outcome.told = fmin(outcome.told, time);
    }
    return outcome;
}

/* One kind over all seeds. */
struct row {
    int runs, told, learned_long; /* runs, those that were told, and learned for too long */
    double slowest, longest;      /* to be told, and to be learned, s */
    int learned;                  /* samples, of all runs */
    int troubles;                 /* bits that were told in every run */
};

static void add(struct row *row, const struct outcome *outcome)
{
    double span = outcome->until - outcome->from;

    row->troubles = row->runs > 0 ? row->troubles & outcome->troubles : outcome->troubles;
    row->runs++;
    if (outcome->told < INFINITY) {
        row->told++;
        row->slowest = fmax(row->slowest, outcome->told);
    }
    row->learned_long += span > patience;
    row->longest = fmax(row->longest, span);
    row->learned += outcome->learned;
}

/* Lies to a copy of the robot, which ends with it. */
static void lie_to_copy(enum lie lie, struct outcome *outcome)
{
    int status;
    pid_t copy = fork();

    ck_assert_int_ge(copy, 0);
    if (copy == 0) {
        liar_begin(&liar, lie);
        world.robot.tool = lie == TRUTH_TOOL ? 0.35 : 0;
        *outcome = watch(watched);
        _exit(0);
    }
    ck_assert_int_eq(waitpid(copy, &status, 0), copy);
    ck_assert_int_eq(status, 0);
}

/* 0: the short test. */
static int seeds(void)
{
    const char *given = getenv("REACH_TEST_SEEDS");

    return given ? atoi(given) : 0;
}

static bool is_honest(enum lie lie)
{
    return lie == LIE_NONE || lie >= LIES;
}

static void print(const struct victim *victim, enum lie lie, const struct row *row)
{
    char told[32] = "";

    if (row->told)
        snprintf(told, sizeof told, " within %.1f s", row->slowest);
    printf("| %s | %s | %d of %d%s | %d | %.1f s | %d of %d |\n", victim->name, lie_names[lie],
           row->told, row->runs, told, row->learned / row->runs, row->longest, row->learned_long,
           row->runs);
}

/* What must be among what is told. */
static const int names[LIES] = {
    [LIE_JUMPS] = REACH_STATUS_T_JUMPS,      [LIE_OUTLIERS] = REACH_STATUS_T_JUMPS,
    [LIE_ROWS] = REACH_STATUS_T_JUMPS,       [LIE_EYE_FROZEN] = REACH_STATUS_T_ONE_EYE,
    [LIE_EYE_LATE] = REACH_STATUS_T_ONE_EYE,
};

static void judge(const struct row *row, enum lie lie)
{
    ck_assert_msg(is_honest(lie) || (row->troubles & names[lie]) == names[lie], "%s: %d",
                  lie_names[lie], row->troubles);
    if (is_honest(lie))
        ck_assert_msg(row->told == 0 && row->learned_long == row->runs, "%s", lie_names[lie]);
    else
        ck_assert_msg(row->told == row->runs && row->learned_long == 0, "%s", lie_names[lie]);
}

/* Those of `known` are always found. */
static void lie_to(const struct victim *victim, unsigned known)
{
    struct row rows[TRUTHS] = {0};
    struct outcome *outcome =
        mmap(NULL, sizeof *outcome, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);

    ck_assert_ptr_ne(outcome, MAP_FAILED);
    for (int seed = 1; seed <= (seeds() ? seeds() : 1); seed++) {
        begin(victim, seed);
        ck_assert(watch(victim->honest).told == INFINITY);
        for (enum lie lie = 0; lie < TRUTHS; lie++) {
            if (!liar_can(!victim->sees, lie) || (seeds() == 0 && !(known & 1u << lie)))
                continue;
            lie_to_copy(lie, outcome);
            add(&rows[lie], outcome);
        }
        world_end();
    }
    munmap(outcome, sizeof *outcome);
    for (enum lie lie = 0; lie < TRUTHS; lie++) {
        if (rows[lie].runs && seeds())
            print(victim, lie, &rows[lie]);
        if (rows[lie].runs && known & 1u << lie && seeds() == 0)
            judge(&rows[lie], lie);
    }
}

enum {
    HONEST = 1 << LIE_NONE | 1 << TRUTH_KNOCKED | 1 << TRUTH_TOOL,
    /* Those of a tracker that show whatever the arm does; others look like a tool for a while. */
    PLAIN = 1 << LIE_JUMPS | 1 << LIE_OUTLIERS | 1 << LIE_ROWS | 1 << LIE_REPEATS | 1 << LIE_PAST |
            1 << LIE_FUTURE,
};

START_TEST(no_lie_is_learned_by_eyes)
{
    lie_to(&eyes, ~0u);
}
END_TEST

START_TEST(plain_lies_of_a_tracker_are_not_learned)
{
    lie_to(&tracker, HONEST | PLAIN);
}
END_TEST

START_TEST(nor_by_a_body)
{
    if (seeds())
        lie_to(&body, HONEST | PLAIN);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {no_lie_is_learned_by_eyes,
                                  plain_lies_of_a_tracker_are_not_learned, nor_by_a_body};

    return suite_run("lies", tests, sizeof tests / sizeof tests[0], 7200);
}
