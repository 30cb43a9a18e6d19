/* Everything that reach-learner hears, and what it makes of it: whatever comes, an answer is
 * addressed to who asked, a prediction counts no more solutions than it holds, and only what was
 * accepted was learned. */
#include "fake_lcm.h"
#include "harness.h"
#include "learner/service/bus.h"
#include "learner/store/store.h"

#include <stdio.h>

static const struct model_store_settings nowhere = {.directory = ""};
static struct learner_config config;
static struct fake_lcm_channel channel;
static struct desk_output output;

static void begin(void)
{
    config = learner_config_default(2, 1);
    config.capacity = 4;
    config.psi0[0] = 0.01;
    config.sigma0[0] = config.sigma0[1] = 1;
    channel = (struct fake_lcm_channel){
        "LEARNER_REQUEST", __reach_learner_request_t_get_hash(),
        (size_t)reach_learner_request_t_encoded_size(&(reach_learner_request_t){0}) - 8};
}

static void ignore(void *user)
{
    (void)user;
}

static void check_answer(const reach_learner_request_t *request, enum desk_answer answer)
{
    const reach_learner_prediction_t *prediction = &output.prediction;
    const reach_learner_reply_t *reply = &output.reply;

    HARNESS_REQUIRE(answer != DESK_SILENT); /* nothing waits for a disk */
    if (answer == DESK_REPLY) {
        HARNESS_REQUIRE(reply->client == request->client && reply->seq == request->seq);
        HARNESS_REQUIRE(reply->status >= 0 && reply->status <= REACH_LEARNER_REPLY_T_NO_DIRECTORY);
    } else {
        HARNESS_REQUIRE(prediction->client == request->client && prediction->seq == request->seq);
        HARNESS_REQUIRE(prediction->n_solutions >= 0 && prediction->n_solutions <= 16);
    }
}

static bool was_learned(const reach_learner_request_t *request, enum desk_answer answer)
{
    return answer == DESK_REPLY && request->kind == REACH_LEARNER_REQUEST_T_UPDATE &&
           output.reply.status == REACH_LEARNER_REPLY_T_DONE;
}

static void hear(struct service_bus *bus, struct desk *desk, const uint8_t *data, size_t size)
{
    reach_learner_request_t request;
    int64_t now = 1000000, accepted = 0, arrived;

    while (size > 0) {
        size_t used = fake_lcm_deliver_next(&channel, 1, data, size);
        data += used;
        size -= used;
        while (service_bus_take(bus, &request, &arrived)) {
            enum desk_answer answer = desk_take(desk, &request, 1000, now += 1000, &output);
            check_answer(&request, answer);
            accepted += was_learned(&request, answer);
        }
    }
    desk_describe(desk, &output.reply);
    HARNESS_REQUIRE(output.reply.samples <= accepted); /* what is repeated is accepted again */
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char error[512] = "";
    lcm_t *lcm = lcm_create("");
    struct arena *arena;
    struct learner *learner;
    struct model_store *store;
    struct service_bus *bus;
    struct desk *desk;

    if (config.n_inputs == 0)
        begin();
    arena = arena_create(learner_memory(&config) + model_store_memory() + desk_memory() +
                         service_bus_memory());
    learner = learner_create(&config, arena, error, sizeof error);
    store = model_store_create(&nowhere, arena, error, sizeof error);
    desk = desk_create(&config, learner, store, false, arena);
    bus = service_bus_create(lcm, ignore, NULL, arena, error, sizeof error);
    HARNESS_REQUIRE(learner && store && desk && bus);
    hear(bus, desk, data, size);
    model_store_close(store);
    arena_destroy(arena);
    lcm_destroy(lcm);
    return 0;
}
