/* A behaviour is added by its file, behaviour_null.c here, and a row of the table. */
#include "common/bus/status_words.h"
#include "daemon/control/behaviours/table.h"
#include "daemon/control/inputs.h"
#include "fixture.h"
#include "tests/unit/suite.h"
#include "world.h"

#include <string.h>

extern const struct behaviour_ops behaviour_null;
static const struct behaviour_ops *const with_null[] = {&behaviour_null, NULL};

enum { KIND = 99, CODE = 98 };

static void begin(const struct behaviour_ops *const *table)
{
    struct tick_settings settings = {.model = model_port_none(), .behaviours = table};

    world_begin(fixture_config(NULL, 0), 0);
    arena_destroy(world.arena);
    settings.config = &world.config;
    world.tick = fixture_tick_of(&settings, &world.arena);
    world_step();
}

START_TEST(it_runs_and_is_reported)
{
    const reach_status_t *status = &world.outputs.status;

    begin(with_null);
    for (int run = 0; run < 2; run++) { /* the second finds nothing of the first */
        ck_assert_int_eq(world_ask((reach_request_t){.kind = KIND, .count = 3}),
                         REACH_STATUS_T_ACCEPTED);
        for (int tick = 1; tick <= 3; tick++) {
            ck_assert_int_eq(status->state, REACH_STATUS_T_ACTIVE);
            ck_assert_int_eq(status->behaviour, CODE);
            ck_assert_int_eq(status->phase, REACH_STATUS_T_TRACK);
            ck_assert_int_eq(status->progress, tick);
            ck_assert_int_eq(status->progress_total, 3);
            world_step();
        }
        ck_assert_int_eq(status->behaviour, REACH_STATUS_T_NONE);
        ck_assert_int_eq(status->phase, REACH_STATUS_T_DONE);
    }
    world_end();
}
END_TEST

START_TEST(it_says_itself_what_it_accepts)
{
    begin(with_null);
    ck_assert_int_eq(world_ask((reach_request_t){.kind = KIND}), REACH_STATUS_T_REFUSED_VALUE);
    ck_assert_int_eq(world.outputs.status.behaviour, REACH_STATUS_T_NONE);
    /* This table has no other. */
    ck_assert_int_eq(world_ask((reach_request_t){.kind = REACH_REQUEST_T_BABBLE, .count = 1}),
                     REACH_STATUS_T_REFUSED_VALUE);
    ck_assert_int_eq(world_ask((reach_request_t){.kind = KIND, .count = 1000}),
                     REACH_STATUS_T_ACCEPTED);
    ck_assert_int_eq(world_ask((reach_request_t){.kind = KIND, .count = 1}),
                     REACH_STATUS_T_REFUSED_STATE);
    ck_assert_int_eq(world_ask((reach_request_t){.kind = REACH_REQUEST_T_STOP}),
                     REACH_STATUS_T_ACCEPTED);
    ck_assert_int_eq(world.outputs.status.behaviour, REACH_STATUS_T_NONE);
    world_end();
}
END_TEST

START_TEST(without_its_row_nobody_knows_it)
{
    begin(NULL);
    ck_assert_int_eq(world_ask((reach_request_t){.kind = KIND, .count = 1}),
                     REACH_STATUS_T_REFUSED_VALUE);
    ck_assert_int_eq(world_ask((reach_request_t){.kind = REACH_REQUEST_T_BABBLE, .count = 1}),
                     REACH_STATUS_T_ACCEPTED);
    world_end();
}
END_TEST

START_TEST(rows_are_what_is_said_outside)
{
    for (const struct behaviour_ops *const *row = behaviour_table; *row; row++) {
        ck_assert_str_eq((*row)->name, status_behaviour_word((*row)->code));
        ck_assert_ptr_eq(behaviour_find(behaviour_table, (*row)->kind), *row);
        /* A stop stays a stop. */
        ck_assert(!inputs_request_ok(&(reach_request_t){.kind = (*row)->kind, .count = 1}));
        ck_assert_uint_le((*row)->state_size, BEHAVIOUR_STATE_MOST);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {it_runs_and_is_reported, it_says_itself_what_it_accepts,
                                  without_its_row_nobody_knows_it, rows_are_what_is_said_outside};

    return SUITE_RUN("new_behaviour", tests);
}
