/* The commands of reachctl: one table row each, which turns words into a message. */
#ifndef REACHCTL_COMMAND_H
#define REACHCTL_COMMAND_H

#include <reach_request_t.h>
#include <reach_sim_request_t.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* What the options of the command line say; the defaults are those of command_defaults. */
struct command_settings {
    const char *url;  /* NULL: the usual bus */
    double timeout;   /* s to wait for an answer */
    bool wait;        /* until the behaviour has ended */
    bool json;        /* status, doctor: as JSON */
    bool once;        /* top: one frame; echo: one message */
    bool frozen;      /* do not learn */
    int64_t seed;     /* of babbling's random configurations */
    double period;    /* s for each target, 0: the command's own */
    const char *file; /* coordinate: list of targets, NULL: the paper's 16 */
    const char *urdf; /* body: file to write, NULL: none */
    bool dh;          /* body: Denavit's and Hartenberg's numbers instead of words */
};

void command_defaults(struct command_settings *settings);

enum call_kind {
    CALL_STATUS,     /* show the daemon's status */
    CALL_TOP,        /* show what is on the bus, over and over */
    CALL_DOCTOR,     /* examine machine and bus */
    CALL_ECHO,       /* print the messages of `channel` */
    CALL_BODY,       /* send `request`, show the body that comes */
    CALL_MOTORS,     /* send `request`, judge the motion of each joint */
    CALL_DAEMON,     /* send `request` */
    CALL_SIMULATOR,  /* send `sim` */
    CALL_UNANSWERED, /* send `sim`, whose receiver ends before it could answer */
};

/* What is to be done. */
struct call {
    enum call_kind kind;
    const char *channel; /* a pattern; the command line's */
    reach_request_t request;
    reach_sim_request_t sim;
};

/* Reads a command line without its options, such as {"babble", "20"} or {"sim", "attach", "1"}.
 *   returns 0, or -1 with one line in `error` that says what is wrong */
int command_parse(const char *const *words, int n_words, const struct command_settings *settings,
                  struct call *call, char *error, size_t error_size);

/* Prints all commands with their arguments and meaning. */
void command_print_help(FILE *out);

#endif
