#include "tools/bench/tick.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "common/base/random.h"
#include "daemon/config/load.h"
#include "daemon/control/tick.h"
#include "daemon/model_of_store.h"
#include "tools/bench/fake_robot.h"
#include "tools/measure/etc_directory.h"

enum { MOST_SAMPLES = 200000, SAMPLES_PER_TOOL = 2000 };

static const double tool_length = 0.3; /* of the fake robot's units */

struct bench {
    struct config config;
    struct arena *arena;
    struct model_store *store;
    struct tick *tick;
    struct fake_robot robot;
    struct tick_inputs inputs;
    struct tick_outputs outputs;
    int64_t request_seq;
};

/* The published experts, and so little tolerance that many are born. */
static int load_config(struct config *config, const char *directory, char *error, size_t error_size)
{
    char robot[PATH_MAX], learner[PATH_MAX];
    const char *paths[] = {etc_file("kobian.yaml", robot, sizeof robot),
                           etc_file("learner-linear.yaml", learner, sizeof learner)};
    char kept[600];
    const char *overrides[] = {"learner.capacity=1024", "learner.noise_angle=0.05",
                               "learner.noise_disparity=0.3", kept};

    snprintf(kept, sizeof kept, "model.directory=\"%s\"", directory);
    return config_load(config, paths, 2, overrides, sizeof overrides / sizeof overrides[0], error,
                       error_size);
}

static int experts_of(const struct bench *bench)
{
    return learner_get_statistics(tick_learner(bench->tick)).experts;
}

/* Random postures of the babbled range, with hand and tool by turns. */
static int teach(struct bench *bench, int experts, char *error, size_t error_size)
{
    const struct config *config = &bench->config;
    struct random_state random = random_seed(1);
    double q[MAX_JOINTS];
    double x[MAX_OUTPUTS];

    for (int n = 0; n < MOST_SAMPLES && experts_of(bench) < experts; n++) {
        bench->robot.tool = n / SAMPLES_PER_TOOL % 2 ? tool_length : 0.0;
        for (int i = 0; i < config_arm_joints(config); i++)
            q[i] =
                random_uniform(&random, config->babble_min.value[i], config->babble_max.value[i]);
        fake_robot_task(&bench->robot, q, x);
        while (!model_store_note(bench->store, q, x))
            model_store_serve(bench->store, n);
        learner_update(tick_learner(bench->tick), q, x);
    }
    bench->robot.tool = 0.0;
    if (experts_of(bench) >= experts)
        return 0;
    snprintf(error, error_size, "tick: only %d experts", experts_of(bench));
    return -1;
}

/* Four targets about the middle of the image, for ever. */
static void ask_to_reach(struct bench *bench)
{
    reach_request_t *request = &bench->inputs.request[bench->inputs.n_requests++];

    *request = (reach_request_t){
        .seq = ++bench->request_seq,
        .kind = REACH_REQUEST_T_REACH,
        .n_targets = 4,
        .target = {{-20, -20, 20}, {20, -20, 25}, {20, 20, 30}, {-20, 20, 25}},
        .period = 2,
    };
}

static void step(struct bench *bench, struct durations *times)
{
    struct tick_inputs *inputs = &bench->inputs;

    inputs->has_state = true;
    inputs->state = fake_robot_state(&bench->robot);
    inputs->n_observations = bench->robot.has_marker;
    inputs->observation[0] = bench->robot.marker;
    int64_t start = durations_clock();
    tick_decide(bench->tick, inputs, bench->robot.now, &bench->outputs);
    durations_add(times, start);
    tick_report(bench->tick, bench->robot.now, &bench->outputs);
    inputs->n_requests = 0;
    fake_robot_step(&bench->robot, &bench->outputs.command);
}

/* Ticks in which nothing is wanted do not count. */
static int reach(struct bench *bench, int calls, struct durations *times, char *error,
                 size_t error_size)
{
    int idle = 0;

    while (times->n < (size_t)calls) {
        size_t before = times->n;
        if (bench->outputs.status.behaviour == REACH_STATUS_T_NONE)
            ask_to_reach(bench);
        step(bench, times);
        if (bench->outputs.status.behaviour == REACH_STATUS_T_NONE) {
            times->n = before;
            if (++idle > 1000 + calls) {
                snprintf(error, error_size, "tick: the daemon does not reach (answer %d)",
                         bench->outputs.status.request_result);
                return -1;
            }
        }
    }
    return 0;
}

/* As the daemon does it. Returns 0 or -1. */
static int create_tick(struct bench *bench, char *error, size_t error_size)
{
    const struct model_store_settings kept = model_of_store_settings(&bench->config, NULL, NULL);
    struct tick_settings settings = {.config = &bench->config};

    bench->arena = arena_create(tick_memory(&bench->config) + model_store_memory());
    if (!bench->arena) {
        snprintf(error, error_size, "tick: no memory");
        return -1;
    }
    bench->store = model_store_create(&kept, bench->arena, error, error_size);
    if (!bench->store)
        return -1;
    settings.model = model_of_store(bench->store);
    bench->tick = tick_create(&settings, bench->arena, error, error_size);
    if (!bench->tick)
        return -1;
    return model_store_open(bench->store, tick_learner(bench->tick), error, error_size);
}

/* A daemon's control step, taught; `directory` "" keeps nothing. Returns 0 or -1. */
static int begin(struct bench *bench, const char *directory, int experts, char *error,
                 size_t error_size)
{
    memset(bench, 0, sizeof *bench);
    if (load_config(&bench->config, directory, error, error_size) ||
        create_tick(bench, error, error_size))
        return -1;
    fake_robot_init(&bench->robot, &bench->config);
    return teach(bench, experts, error, error_size);
}

int tick_bench(int experts, int calls, struct durations *times, char *error, size_t error_size)
{
    static struct bench bench; /* messages are large */
    int result = begin(&bench, "", experts, error, error_size);

    if (result == 0)
        result = reach(&bench, calls, times, error, error_size);
    arena_destroy(bench.arena);
    return result;
}

int tick_prime(const char *directory, int experts, char *error, size_t error_size)
{
    static struct bench bench;
    int result = begin(&bench, directory, experts, error, error_size);

    model_store_close(bench.store);
    arena_destroy(bench.arena);
    return result;
}
