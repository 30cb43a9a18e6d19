#include "tools/eval/request.h"

#include <errno.h>
#include <getopt.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/program/version.h"
#include "tools/measure/learner_options.h"

static const char usage[] =
    "usage: reach-eval --learner KIND --inputs d --outputs D [--config FILE] [--param NAME=VALUE "
    "...]\n"
    "                  --train FILE[,FILE...] [--at N,N,...] [--test NAME=FILE ...]\n"
    "                  [--track NAME=FILE ...] --json FILE [--save FILE] [--load FILE]\n"
    "\n"
    "Teaches a learner the samples of CSV files, in order, and measures it on others.\n"
    "\n"
    "  --learner KIND       imle or lwpr\n"
    "  --inputs d           numbers of the input in a row, 1 .. 16\n"
    "  --outputs D          numbers of the output after them, 1 .. 8\n"
    "  --config FILE        parameters, YAML; repeated: a later file over an earlier one. Without\n"
    "                       it, what ships for robots of that kind (d = 7 or 4, D = 3)\n"
    "  --param NAME=VALUE   one parameter, over the files; --help-options lists them\n"
    "  --train FILE,FILE    samples to learn\n"
    "  --at N,N,...         numbers of samples after which to measure; default: after all\n"
    "  --test NAME=FILE     independent queries\n"
    "  --track NAME=FILE    a smooth trajectory: follow the solution nearest to the last true "
    "output\n"
    "  --json FILE          the report, keys explained in docs/evaluation.md; -: standard output\n"
    "  --save FILE          the learner's state after the last measurement\n"
    "  --load FILE          begin with such a state; needs the same parameters\n"
    "  --quiet              neither progress nor a table\n"
    "  --help-options       every parameter for this --learner, --inputs and --outputs\n"
    "  -h, --help           this text\n"
    "  -V, --version        version and git revision\n"
    "\n"
    "Files are plain or gzip; a row is d inputs, D outputs and, where a file carries it, the\n"
    "Jacobian (D x d, row-major); the first line may hold names.\n"
    "exit code: 0 done, 1 a file or a parameter is refused, 2 wrong usage\n";

enum long_option {
    OPTION_LEARNER = 256,
    OPTION_INPUTS,
    OPTION_OUTPUTS,
    OPTION_CONFIG,
    OPTION_PARAM,
    OPTION_TRAIN,
    OPTION_AT,
    OPTION_TEST,
    OPTION_TRACK,
    OPTION_JSON,
    OPTION_SAVE,
    OPTION_LOAD,
    OPTION_QUIET,
    OPTION_HELP_OPTIONS,
};

static const struct option long_options[] = {
    {"learner", required_argument, NULL, OPTION_LEARNER},
    {"inputs", required_argument, NULL, OPTION_INPUTS},
    {"outputs", required_argument, NULL, OPTION_OUTPUTS},
    {"config", required_argument, NULL, OPTION_CONFIG},
    {"param", required_argument, NULL, OPTION_PARAM},
    {"train", required_argument, NULL, OPTION_TRAIN},
    {"at", required_argument, NULL, OPTION_AT},
    {"test", required_argument, NULL, OPTION_TEST},
    {"track", required_argument, NULL, OPTION_TRACK},
    {"json", required_argument, NULL, OPTION_JSON},
    {"save", required_argument, NULL, OPTION_SAVE},
    {"load", required_argument, NULL, OPTION_LOAD},
    {"quiet", no_argument, NULL, OPTION_QUIET},
    {"help-options", no_argument, NULL, OPTION_HELP_OPTIONS},
    {"help", no_argument, NULL, 'h'},
    {"version", no_argument, NULL, 'V'},
    {0}};

/* While the command line is read: which option the next free word belongs to. */
struct reading {
    struct request *request;
    int repeatable; /* --param, --train, --test or --track; 0: none */
    bool has_learner;
    bool lists_options;
};

static const struct {
    const char *name;
    enum learner_kind kind;
} learners[] = {{"imle", LEARNER_IMLE}, {"lwpr", LEARNER_LWPR}};

enum { N_LEARNERS = sizeof learners / sizeof learners[0] };

const char *request_learner_name(enum learner_kind kind)
{
    for (int i = 0; i < N_LEARNERS; i++)
        if (learners[i].kind == kind)
            return learners[i].name;
    return "unknown";
}

static int wrong(const char *format, ...) __attribute__((format(printf, 1, 2)));
static int wrong(const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    fputs("reach-eval: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    return -1;
}

static int take_learner(struct reading *reading, const char *text)
{
    for (int i = 0; i < N_LEARNERS; i++)
        if (strcmp(learners[i].name, text) == 0) {
            reading->request->kind = learners[i].kind;
            reading->has_learner = true;
            return 0;
        }
    return wrong("--learner: unknown learner '%s'", text);
}

static int take_dimension(const char *option, const char *text, int most, int *value)
{
    char *end;
    long number = strtol(text, &end, 10);

    if (end == text || *end || number < 1 || number > most)
        return wrong("%s: a whole number from 1 to %d is wanted, not '%s'", option, most, text);
    *value = (int)number;
    return 0;
}

static int take_text(const char *option, const char *text, int *n, const char **list)
{
    if (*n == REQUEST_MOST)
        return wrong("%s: more than %d", option, REQUEST_MOST);
    list[(*n)++] = text;
    return 0;
}

static int take_train(struct request *request, const char *text)
{
    for (;;) {
        size_t length = strcspn(text, ",");
        char *path = strndup(text, length);
        if (!path || length == 0) {
            free(path);
            return wrong("--train: a file's name is missing");
        }
        if (take_text("--train", path, &request->n_train, request->train)) {
            free(path);
            return -1;
        }
        if (text[length] == '\0')
            return 0;
        text += length + 1;
    }
}

static int take_at(struct request *request, const char *text)
{
    char *end;

    for (;;) {
        errno = 0;
        unsigned long long number = strtoull(text, &end, 10);
        if (end == text || *text < '0' || *text > '9' || errno || (*end && *end != ','))
            return wrong("--at: whole numbers n1,n2,... are wanted, not '%s'", text);
        if (request->n_at == REQUEST_MOST_COUNTS)
            return wrong("--at: more than %d", REQUEST_MOST_COUNTS);
        if (request->n_at > 0 && number <= request->at[request->n_at - 1])
            return wrong("--at: numbers must grow, %llu does not", number);
        request->at[request->n_at++] = (size_t)number;
        if (*end == '\0')
            return 0;
        text = end + 1;
    }
}

static int take_set(struct request *request, const char *option, const char *text, bool is_track)
{
    struct request_set set = {.is_track = is_track};
    size_t length = strcspn(text, "=");

    if (length == 0 || text[length] == '\0' || text[length + 1] == '\0')
        return wrong("%s: NAME=FILE is wanted, not '%s'", option, text);
    if (length >= sizeof set.name)
        return wrong("%s: the name in '%s' is too long", option, text);
    memcpy(set.name, text, length);
    set.path = text + length + 1;
    for (int i = 0; i < request->n_sets; i++)
        if (request->sets[i].is_track == is_track && strcmp(request->sets[i].name, set.name) == 0)
            return wrong("%s: the name %s is given twice", option, set.name);
    if (request->n_sets == REQUEST_MOST)
        return wrong("more than %d of --test and --track", REQUEST_MOST);
    request->sets[request->n_sets++] = set;
    return 0;
}

/* The options whose argument may be followed by more of the same. */
static int take_repeatable(struct reading *reading, int option, const char *text)
{
    struct request *request = reading->request;

    reading->repeatable = option;
    switch (option) {
    case OPTION_PARAM:
        return take_text("--param", text, &request->n_params, request->params);
    case OPTION_TRAIN:
        return take_train(request, text);
    case OPTION_TEST:
        return take_set(request, "--test", text, false);
    case OPTION_TRACK:
        return take_set(request, "--track", text, true);
    default:
        return wrong("unexpected word '%s'", text);
    }
}

/* The options that stand alone. */
static int take_single(struct reading *reading, int option, const char *text)
{
    struct request *request = reading->request;

    switch (option) {
    case OPTION_LEARNER:
        return take_learner(reading, text);
    case OPTION_INPUTS:
        return take_dimension("--inputs", text, LEARNER_MAX_INPUTS, &request->n_inputs);
    case OPTION_OUTPUTS:
        return take_dimension("--outputs", text, LEARNER_MAX_OUTPUTS, &request->n_outputs);
    case OPTION_CONFIG:
        return take_text("--config", text, &request->n_files, request->files);
    case OPTION_AT:
        return take_at(request, text);
    case OPTION_JSON:
        request->json = text;
        return 0;
    case OPTION_SAVE:
        request->save = text;
        return 0;
    case OPTION_LOAD:
        request->load = text;
        return 0;
    case OPTION_QUIET:
        request->quiet = true;
        return 0;
    case OPTION_HELP_OPTIONS:
        reading->lists_options = true;
        return 0;
    default:
        return -1; /* getopt has said why */
    }
}

static int take_option(struct reading *reading, int option)
{
    switch (option) {
    case OPTION_PARAM:
    case OPTION_TRAIN:
    case OPTION_TEST:
    case OPTION_TRACK:
        return take_repeatable(reading, option, optarg);
    case 1: /* a word without an option */
        return take_repeatable(reading, reading->repeatable, optarg);
    default:
        reading->repeatable = 0;
        return take_single(reading, option, optarg);
    }
}

/* What every run needs. */
static int check(const struct reading *reading)
{
    const struct request *request = reading->request;

    if (!reading->has_learner)
        return wrong("--learner is missing");
    if (request->n_inputs == 0 || request->n_outputs == 0)
        return wrong("%s is missing", request->n_inputs == 0 ? "--inputs" : "--outputs");
    if (reading->lists_options)
        return 0;
    if (request->n_train == 0 && !request->load)
        return wrong("--train is missing");
    if (!request->json)
        return wrong("--json is missing");
    return 0;
}

enum request_result request_read(int argc, char **argv, struct request *request)
{
    struct reading reading = {.request = request};
    int option;

    *request = (struct request){0};
    argv[0] = program_invocation_short_name; /* what getopt puts in front of its complaints */
    while ((option = getopt_long(argc, argv, "-hV", long_options, NULL)) != -1) {
        if (option == 'h') {
            fputs(usage, stdout);
            return REQUEST_DONE;
        }
        if (option == 'V') {
            printf("reach-eval %s\n", reach_version);
            return REQUEST_DONE;
        }
        if (take_option(&reading, option))
            return REQUEST_WRONG;
    }
    if (check(&reading))
        return REQUEST_WRONG;
    if (!reading.lists_options)
        return REQUEST_READY;
    learner_options_print(request->kind, request->n_inputs, request->n_outputs, stdout);
    return REQUEST_DONE;
}

void request_free(struct request *request)
{
    for (int i = 0; i < request->n_train; i++)
        free((void *)(uintptr_t)request->train[i]);
    request->n_train = 0;
}
