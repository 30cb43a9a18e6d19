#include "tools/reachctl/motors/hearing.h"

#include "tools/reachctl/motors/judge.h"

#include <math.h>
#include <reach_robot_command_t.h>
#include <reach_robot_state_t.h>
#include <stdio.h>
#include <stdlib.h>

#define PI 3.14159265358979323846

enum { QUEUE = 1000 /* messages that may wait */ };
enum { MOST_JOINTS = 16, MOST_ROWS = 1 << 16 /* twenty minutes at 50 Hz */ };

/* What was heard: a row a command, with the newest state before it. */
struct motors_hearing {
    lcm_t *bus;
    reach_robot_state_t_subscription_t *states;
    reach_robot_command_t_subscription_t *commands;
    int n_joints;
    size_t n;
    bool has_state;
    reach_robot_state_t state;
    struct motor_row rows[MOST_JOINTS][MOST_ROWS];
};

static void on_state(const lcm_recv_buf_t *message, const char *channel,
                     const reach_robot_state_t *state, void *user)
{
    struct motors_hearing *hearing = user;

    (void)message, (void)channel;
    hearing->has_state = state->n_joints >= 1 && state->n_joints <= MOST_JOINTS;
    hearing->state = *state;
}

static void on_command(const lcm_recv_buf_t *message, const char *channel,
                       const reach_robot_command_t *command, void *user)
{
    struct motors_hearing *hearing = user;

    (void)message, (void)channel;
    if (!hearing->has_state || command->n_joints != hearing->state.n_joints ||
        hearing->n == MOST_ROWS)
        return;
    hearing->n_joints = command->n_joints;
    for (int i = 0; i < command->n_joints; i++)
        hearing->rows[i][hearing->n] = (struct motor_row){
            .commanded_at = (double)command->utime * 1e-6,
            .commanded = command->velocity[i],
            .measured_at = (double)hearing->state.utime * 1e-6,
            .measured = hearing->state.position[i],
        };
    hearing->n++;
}

static void print_number(double value, int width, int digits)
{
    if (isnan(value))
        printf("%*s", width, "-");
    else
        printf("%*.*f", width, digits, value);
}

int motors_print(const struct motors_hearing *hearing)
{
    int bad = 0;

    if (hearing->n == 0)
        return -1;
    printf("joint  motion           scale  delay, ms  backlash, deg\n");
    for (int i = 0; i < hearing->n_joints; i++) {
        struct motor_report report = motor_judge(hearing->rows[i], hearing->n);
        printf("%5d  %-13s", i + 1, motor_verdict_word(report.verdict));
        print_number(report.scale, 10, 3);
        print_number(round(1e3 * report.delay) + 0.0, 11, 0); /* no -0 */
        print_number(180 / PI * report.backlash, 15, 2);
        printf("\n");
        bad += report.verdict != MOTOR_WELL;
    }
    return bad;
}

struct motors_hearing *motors_listen(lcm_t *bus)
{
    struct motors_hearing *hearing = calloc(1, sizeof *hearing);

    if (!hearing)
        return NULL;
    hearing->bus = bus;
    hearing->states = reach_robot_state_t_subscribe(bus, "ROBOT_STATE", on_state, hearing);
    hearing->commands = reach_robot_command_t_subscribe(bus, "ROBOT_COMMAND", on_command, hearing);
    /* In lockstep they come as fast as the simulator goes. */
    reach_robot_state_t_subscription_set_queue_capacity(hearing->states, QUEUE);
    reach_robot_command_t_subscription_set_queue_capacity(hearing->commands, QUEUE);
    return hearing;
}

void motors_end(struct motors_hearing *hearing)
{
    reach_robot_state_t_unsubscribe(hearing->bus, hearing->states);
    reach_robot_command_t_unsubscribe(hearing->bus, hearing->commands);
    free(hearing);
}
