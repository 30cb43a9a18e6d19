#include "tools/reachctl/command.h"

#include "tools/reachctl/target_list.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The paper presents a target every 2 s to the head (section 7.2); a reach is given the time to
 * come to rest. */
static const double coordinate_period = 2.0;
static const double reach_period = 4.0;

/* Room for everything that a row may need. */
struct context {
    const char *const *arguments;
    const struct command_settings *settings;
    struct call *call;
    char *error;
    size_t error_size;
};

typedef int fill_fn(const struct context *context);

struct command {
    const char *name;
    const char *arguments; /* as help shows them */
    int n_arguments;
    enum call_kind kind;
    int8_t message_kind; /* the constant of request_t or sim_request_t */
    fill_fn *fill;       /* the rest of the message, NULL: nothing */
    const char *help;
};

void command_defaults(struct command_settings *settings)
{
    *settings = (struct command_settings){.timeout = 5.0, .seed = 1};
}

static int number(const struct context *context, int index, double low, double high, double *value)
{
    const char *text = context->arguments[index];
    char *end;

    *value = strtod(text, &end);
    if (end == text || *end || !(*value >= low && *value <= high)) {
        snprintf(context->error, context->error_size, "'%s': a number from %g to %g is wanted",
                 text, low, high);
        return -1;
    }
    return 0;
}

static int whole(const struct context *context, int index, double low, double high, int *value)
{
    double real;

    if (number(context, index, low, high, &real))
        return -1;
    if (real != floor(real)) {
        snprintf(context->error, context->error_size, "'%s': a whole number is wanted",
                 context->arguments[index]);
        return -1;
    }
    *value = (int)real;
    return 0;
}

static int fill_babble(const struct context *context)
{
    context->call->request.seed = context->settings->seed;
    return whole(context, 0, 1, 1e6, &context->call->request.count);
}

static double period_or(const struct context *context, double usual)
{
    return context->settings->period > 0 ? context->settings->period : usual;
}

static int fill_coordinate(const struct context *context)
{
    context->call->request.period = period_or(context, coordinate_period);
    if (context->settings->file)
        return targets_read(context->settings->file, &context->call->request, context->error,
                            context->error_size);
    targets_star(&context->call->request);
    return 0;
}

static int fill_star(const struct context *context)
{
    context->call->request.period = period_or(context, reach_period);
    context->call->request.count = 1; /* from the centre of the babbled range */
    targets_star(&context->call->request);
    return 0;
}

static int fill_reach(const struct context *context)
{
    reach_request_t *request = &context->call->request;

    request->period = period_or(context, reach_period);
    request->n_targets = 1;
    return number(context, 0, -1000, 1000, &request->target[0][0]) ||
                   number(context, 1, -1000, 1000, &request->target[0][1]) ||
                   number(context, 2, -1000, 1000, &request->target[0][2])
               ? -1
               : 0;
}

static int fill_model(const struct context *context)
{
    return whole(context, 0, 0, INT_MAX, &context->call->request.count);
}

static int fill_tool(const struct context *context)
{
    return whole(context, 0, 1, 100, &context->call->sim.tool);
}

static int fill_light(const struct context *context)
{
    return number(context, 0, 0, 10, &context->call->sim.value);
}

static int fill_speed(const struct context *context)
{
    return number(context, 0, 0.01, 100, &context->call->sim.value);
}

static int fill_until(const struct context *context)
{
    double seconds;

    if (number(context, 0, 0, 1e12, &seconds))
        return -1;
    context->call->sim.until = llround(seconds * 1e6);
    return 0;
}

static int fill_echo(const struct context *context)
{
    context->call->channel = context->arguments[0];
    return 0;
}

static const struct command looking_commands[] = {
    {"status", "", 0, CALL_STATUS, 0, NULL, "show the state of the daemon; --json: for programs"},
    {"top", "", 0, CALL_TOP, 0, NULL,
     "show what is on the bus until q is pressed; --once: one frame"},
    {"body", "", 0, CALL_BODY, REACH_REQUEST_T_TELL_BODY, NULL,
     "show the robot's body as it was found; --dh: as numbers of Denavit and Hartenberg; "
     "--urdf FILE: write it as a URDF"},
    {"echo", "CHANNEL", 1, CALL_ECHO, 0, fill_echo,
     "print what is said on CHANNEL, a line of JSON a message; --once: one message"},
    {"doctor", "", 0, CALL_DOCTOR, 0, NULL,
     "find what is wrong with this machine or the bus; --json: for programs"},
    {0}};

static const struct command daemon_commands[] = {
    {"babble", "N", 1, CALL_DAEMON, REACH_REQUEST_T_BABBLE, fill_babble,
     "collect N samples at random postures; --seed S; --frozen: test the model, do not teach it"},
    {"explore", "N", 1, CALL_DAEMON, REACH_REQUEST_T_EXPLORE, fill_babble,
     "learn to reach from nothing, by goals of the robot's own, for N samples; --seed S"},
    {"coordinate", "", 0, CALL_DAEMON, REACH_REQUEST_T_COORDINATE, fill_coordinate,
     "turn the head to targets (--file F: lines 'u v disparity') and let the arm follow"},
    {"star", "", 0, CALL_DAEMON, REACH_REQUEST_T_REACH, fill_star,
     "reach for 8 directions and back to the centre; --period S"},
    {"reach", "A B C", 3, CALL_DAEMON, REACH_REQUEST_T_REACH, fill_reach,
     "bring the end-effector to A B C: u, v, disparity in px, or x, y, z in m"},
    {"check-motors", "", 0, CALL_MOTORS, REACH_REQUEST_T_CHECK_MOTORS, NULL,
     "move each joint by 2 degrees in turn; say sign, scale, delay and backlash of its motion"},
    {"stop", "", 0, CALL_DAEMON, REACH_REQUEST_T_STOP, NULL, "end what the robot does"},
    {"emergency", "", 0, CALL_DAEMON, REACH_REQUEST_T_EMERGENCY, NULL,
     "stop the arm at once; the daemon stays in fault until reset-fault"},
    {"save", "N", 1, CALL_DAEMON, REACH_REQUEST_T_SAVE, fill_model, "save the model as number N"},
    {"load", "N", 1, CALL_DAEMON, REACH_REQUEST_T_LOAD, fill_model,
     "load the model that was saved as number N"},
    {"forget-body", "", 0, CALL_DAEMON, REACH_REQUEST_T_FORGET_BODY, NULL,
     "give up the body that was found and search anew, in the samples that are kept"},
    {"reset-fault", "", 0, CALL_DAEMON, REACH_REQUEST_T_RESET_FAULT, NULL, "leave the fault state"},
    {0}};

static const struct command simulator_commands[] = {
    {"attach", "TOOL", 1, CALL_SIMULATOR, REACH_SIM_REQUEST_T_TOOL, fill_tool,
     "put tool number TOOL of the simulator's configuration into the hand"},
    {"detach", "", 0, CALL_SIMULATOR, REACH_SIM_REQUEST_T_TOOL, NULL,
     "take the tool out of the hand"},
    {"reset", "", 0, CALL_SIMULATOR, REACH_SIM_REQUEST_T_RESET, NULL,
     "put the robot back to its start pose"},
    {"light", "X", 1, CALL_SIMULATOR, REACH_SIM_REQUEST_T_LIGHT, fill_light,
     "set the brightness to X; 1 = as configured"},
    {"pause", "", 0, CALL_SIMULATOR, REACH_SIM_REQUEST_T_PAUSE, NULL,
     "let the simulator stand still"},
    {"resume", "", 0, CALL_SIMULATOR, REACH_SIM_REQUEST_T_RESUME, NULL, "let the simulator go on"},
    {"speed", "X", 1, CALL_SIMULATOR, REACH_SIM_REQUEST_T_SPEED, fill_speed,
     "run at X times real time (real-time clock only)"},
    {"run-until", "T", 1, CALL_SIMULATOR, REACH_SIM_REQUEST_T_RUN_UNTIL, fill_until,
     "run to simulated time T seconds, then hold (reach-simrobot --hold)"},
    {"quit", "", 0, CALL_UNANSWERED, REACH_SIM_REQUEST_T_QUIT, NULL, "end the simulator"},
    {0}};

static const struct command *find(const struct command *table, const char *name)
{
    for (; table->name; table++)
        if (strcmp(table->name, name) == 0)
            return table;
    return NULL;
}

int command_parse(const char *const *words, int n_words, const struct command_settings *settings,
                  struct call *call, char *error, size_t error_size)
{
    bool is_sim = n_words > 0 && strcmp(words[0], "sim") == 0;
    const char *name = n_words > is_sim ? words[is_sim] : NULL;
    const struct command *command;
    struct context context = {words + is_sim + 1, settings, call, error, error_size};

    if (!name) {
        snprintf(error, error_size, "a command is wanted");
        return -1;
    }
    command = find(is_sim ? simulator_commands : looking_commands, name);
    if (!command && !is_sim)
        command = find(daemon_commands, name);
    if (!command) {
        snprintf(error, error_size, "unknown command '%s%s'", is_sim ? "sim " : "", name);
        return -1;
    }
    if (n_words - is_sim - 1 != command->n_arguments) {
        snprintf(error, error_size, "usage: reachctl %s%s %s", is_sim ? "sim " : "", command->name,
                 command->arguments);
        return -1;
    }
    memset(call, 0, sizeof *call);
    call->kind = command->kind;
    call->request.kind = command->message_kind;
    call->request.learn = !settings->frozen;
    call->sim.kind = command->message_kind;
    return command->fill ? command->fill(&context) : 0;
}

static void print_table(FILE *out, const struct command *table, const char *prefix)
{
    for (; table->name; table++) {
        char usage[64];
        snprintf(usage, sizeof usage, "%s%s %s", prefix, table->name, table->arguments);
        fprintf(out, "  %-18s %s\n", usage, table->help);
    }
}

void command_print_help(FILE *out)
{
    fprintf(out, "commands to look:\n");
    print_table(out, looking_commands, "");
    fprintf(out, "commands to the daemon:\n");
    print_table(out, daemon_commands, "");
    fprintf(out, "commands to the simulator, for the experimenter:\n");
    print_table(out, simulator_commands, "sim ");
    fprintf(out,
            "commands that are programs of their own, and come first:\n"
            "  new-robot URDF     write the configuration of a robot, try it in simulation, and "
            "print what it reaches; new-robot --help tells more\n");
}
