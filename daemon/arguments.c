#include "daemon/arguments.h"

#include "daemon/config/table.h"

#include "common/bus/open.h"

static const struct argument_row rows[] = {
    ARGUMENT_SOURCES(struct arguments, configuration, "etc/kobian.yaml"),
    ARGUMENT_URL(struct arguments, url),
    ARGUMENT_ON("lockstep", 'l', struct arguments, lockstep,
                "the simulator's clock, not the real one"),
    ARGUMENT_ON("no-rt", 0, struct arguments, no_rt,
                "real time without priority and locked memory, for developers"),
    ARGUMENT_ON("verbose", 'v', struct arguments, verbose, "say more"),
    ARGUMENT_ON(
        "check-config", 0, struct arguments, check_config,
        "read the configuration, print every option as it holds, with what follows from the "
        "robot, and end"),
    ARGUMENT_ON("check-model", 0, struct arguments, check_model,
                "print the samples and the hash of the model in model.directory, or what is wrong "
                "with it, and change nothing"),
    ARGUMENT_LIST("replay", 0, "LOG ...", struct arguments, replay, n_replay, PIECES_MOST,
                  "make the decisions of a recorded run again, which LOG has of lcm-logger or the "
                  "like, in one piece or several; - is standard input; needs no --config"),
    ARGUMENT_ON("replay-clock", 0, struct arguments, replay_clock,
                "the same from lcm-logplayer on the bus; answers on channels named REPLAY_..."),
    ARGUMENT_ON("verify", 0, struct arguments, verify,
                "compare what is replayed with what was recorded"),
    ARGUMENT_LIST("model", 0, "FILE", struct arguments, models, n_models, MAX_MODELS,
                  "a model that the recorded run began with or loaded (may be repeated)"),
    ARGUMENT_END,
};

static const struct command_line line = {
    .program = "reachd",
    .usage = "reachd --config FILE [options]\n"
             "       reachd --replay LOG ... [--verify] [options]",
    .about = "Learns how the robot's arm moves, with whatever tool it holds, and reaches with it.",
    .rows = rows,
    .exit_status = "0 ended as asked, 1 could not start or run, or a replay differs",
    .print_options = config_print_options,
};

/* What goes together. */
static const char *contradiction(const struct arguments *arguments)
{
    bool replays = arguments->n_replay > 0 || arguments->replay_clock;

    if (arguments->n_replay > 0 && arguments->replay_clock)
        return "--replay reads a log, --replay-clock the bus: one of them is wanted";
    if (!replays && (arguments->verify || arguments->n_models > 0))
        return "--verify and --model belong to --replay or --replay-clock";
    if (replays && (arguments->lockstep || arguments->check_config || arguments->check_model))
        return "--lockstep, --check-config and --check-model do not go with a replay";
    if (arguments->configuration.n_paths == 0 &&
        (!replays || arguments->configuration.n_overrides > 0))
        return "--config is missing";
    return NULL;
}

int arguments_parse(struct arguments *arguments, int argc, char **argv)
{
    int status = command_line_parse(&line, argc, argv, arguments);
    const char *wrong = status < 0 ? contradiction(arguments) : NULL;

    return wrong ? command_line_wrong(&line, "%s", wrong) : status;
}
