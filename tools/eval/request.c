#include "tools/eval/request.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/options/command_line.h"
#include "tools/measure/learner_options.h"

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

static int wrong(char *error, size_t error_size, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
static int wrong(char *error, size_t error_size, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(error, error_size, format, arguments);
    va_end(arguments);
    return -1;
}

static int take_learner(void *user, const char *text, char *error, size_t error_size)
{
    struct request *request = user;

    for (int i = 0; i < N_LEARNERS; i++)
        if (strcmp(learners[i].name, text) == 0) {
            request->kind = learners[i].kind;
            request->has_kind = true;
            return 0;
        }
    return wrong(error, error_size, "unknown learner '%s'", text);
}

/* Room for one more entry; `list` is the pointer to an array of entries of that size. */
static int make_room(void **list, int n, int *room, size_t size, char *error, size_t error_size)
{
    int more = *room > 0 ? 2 * *room : 16;

    if (n < *room)
        return 0;
    void *larger = realloc(*list, (size_t)more * size);
    if (!larger)
        return wrong(error, error_size, "out of memory");
    *list = larger;
    *room = more;
    return 0;
}

static int add_train(struct request *request, char *path, char *error, size_t error_size)
{
    void *list = request->train;

    if (make_room(&list, request->n_train, &request->train_room, sizeof *request->train, error,
                  error_size))
        return -1;
    request->train = list;
    request->train[request->n_train++] = path;
    return 0;
}

static int take_train(void *user, const char *text, char *error, size_t error_size)
{
    struct request *request = user;

    for (;;) {
        size_t length = strcspn(text, ",");
        char *path = strndup(text, length);
        if (!path || length == 0) {
            free(path);
            return wrong(error, error_size, "a file's name is missing");
        }
        if (add_train(request, path, error, error_size)) {
            free(path);
            return -1;
        }
        if (text[length] == '\0')
            return 0;
        text += length + 1;
    }
}

static int take_at(void *user, const char *text, char *error, size_t error_size)
{
    struct request *request = user;
    char *end;

    for (;;) {
        errno = 0;
        unsigned long long number = strtoull(text, &end, 10);
        if (end == text || *text < '0' || *text > '9' || errno || (*end && *end != ','))
            return wrong(error, error_size, "whole numbers n1,n2,... are wanted, not '%s'", text);
        if (request->n_at == REQUEST_MOST_COUNTS)
            return wrong(error, error_size, "more than %d", REQUEST_MOST_COUNTS);
        if (request->n_at > 0 && number <= request->at[request->n_at - 1])
            return wrong(error, error_size, "numbers must grow, %llu does not", number);
        request->at[request->n_at++] = (size_t)number;
        if (*end == '\0')
            return 0;
        text = end + 1;
    }
}

static int take_set(struct request *request, const char *text, bool is_track, char *error,
                    size_t error_size)
{
    struct request_set set = {.is_track = is_track};
    size_t length = strcspn(text, "=");

    if (length == 0 || text[length] == '\0' || text[length + 1] == '\0')
        return wrong(error, error_size, "NAME=FILE is wanted, not '%s'", text);
    if (length >= sizeof set.name)
        return wrong(error, error_size, "the name in '%s' is too long", text);
    memcpy(set.name, text, length);
    set.path = text + length + 1;
    for (int i = 0; i < request->n_sets; i++)
        if (request->sets[i].is_track == is_track && strcmp(request->sets[i].name, set.name) == 0)
            return wrong(error, error_size, "the name %s is given twice", set.name);
    void *list = request->sets;
    if (make_room(&list, request->n_sets, &request->sets_room, sizeof *request->sets, error,
                  error_size))
        return -1;
    request->sets = list;
    request->sets[request->n_sets++] = set;
    return 0;
}

static int take_test(void *user, const char *text, char *error, size_t error_size)
{
    return take_set(user, text, false, error, error_size);
}

static int take_track(void *user, const char *text, char *error, size_t error_size)
{
    return take_set(user, text, true, error, error_size);
}

static const struct argument_row rows[] = {
    ARGUMENT_CALL("learner", "KIND", take_learner, "imle or lwpr"),
    ARGUMENT_INT("inputs", "d", struct request, n_inputs, 1, LEARNER_MAX_INPUTS,
                 "numbers of the input in a row, 1 .. 16"),
    ARGUMENT_INT("outputs", "D", struct request, n_outputs, 1, LEARNER_MAX_OUTPUTS,
                 "numbers of the output after them, 1 .. 8"),
    ARGUMENT_LIST("config", 0, "FILE", struct request, files, n_files, REQUEST_MOST,
                  "parameters, YAML; repeated: a later file over an earlier one. Without it, what "
                  "ships for robots of that kind (d = 7 or 4, D = 3)"),
    ARGUMENT_LIST("param", 0, "NAME=VALUE ...", struct request, params, n_params, REQUEST_MOST,
                  "parameters, over the files, a list as 1,2,3; --help-options lists them"),
    ARGUMENT_CALL("train", "FILE[,FILE] ...", take_train, "samples to learn"),
    ARGUMENT_CALL("at", "N,N,...", take_at,
                  "numbers of samples after which to measure; default: after all"),
    ARGUMENT_CALL("test", "NAME=FILE ...", take_test, "independent queries"),
    ARGUMENT_CALL("track", "NAME=FILE ...", take_track,
                  "a smooth trajectory: follow the solution nearest to the last true output"),
    ARGUMENT_TEXT("json", 0, "FILE", struct request, json,
                  "the report, keys explained in docs/evaluation.md; -: standard output"),
    ARGUMENT_TEXT("rows", 0, "FILE", struct request, rows,
                  "CSV of every row of --test and --track: truth and predictions, as the last "
                  "measurement finds them"),
    ARGUMENT_TEXT("save", 0, "FILE", struct request, save,
                  "the learner's state after the last measurement"),
    ARGUMENT_TEXT("load", 0, "FILE", struct request, load,
                  "begin with such a state; needs the same parameters"),
    ARGUMENT_ON("keep-frozen", 0, struct request, keeps_frozen,
                "learn also samples whose outputs stand still while inputs move"),
    ARGUMENT_ON("quiet", 0, struct request, quiet,
                "neither progress nor a table; warnings are still told"),
    ARGUMENT_ON("help-options", 0, struct request, lists_options,
                "list every parameter for this --learner, --inputs and --outputs"),
    ARGUMENT_END,
};

static const struct command_line line = {
    .program = "reach-eval",
    .usage = "reach-eval --learner KIND --inputs d --outputs D [--config FILE] [--param NAME=VALUE "
             "...]\n"
             "                  --train FILE[,FILE...] [--at N,N,...] [--test NAME=FILE ...]\n"
             "                  [--track NAME=FILE ...] --json FILE [--rows FILE]\n"
             "                  [--save FILE] [--load FILE]",
    .about = "Teaches a learner the samples of CSV files, in order, and measures it on others.\n\n"
             "Files are plain or gzip; a row is d inputs, D outputs and, where a file carries it,\n"
             "the Jacobian (D x d, row-major); the first line may hold names.",
    .rows = rows,
    .exit_status = "0 done, 1 a file or a parameter is refused",
};

/* What every run needs and this one lacks, or NULL. */
static const char *lacking(const struct request *request)
{
    if (!request->has_kind)
        return "--learner";
    if (request->n_inputs == 0)
        return "--inputs";
    if (request->n_outputs == 0)
        return "--outputs";
    if (request->lists_options)
        return NULL;
    if (request->n_train == 0 && !request->load)
        return "--train";
    return request->json ? NULL : "--json";
}

int request_read(int argc, char **argv, struct request *request)
{
    const char *option;
    int status;

    *request = (struct request){0};
    status = command_line_parse(&line, argc, argv, request);
    if (status >= 0)
        return status;
    option = lacking(request);
    if (option)
        return command_line_wrong(&line, "%s is missing", option);
    if (!request->lists_options)
        return -1;
    learner_options_print(request->kind, request->n_inputs, request->n_outputs, stdout);
    return 0;
}

void request_free(struct request *request)
{
    for (int i = 0; i < request->n_train; i++)
        free(request->train[i]);
    free(request->train);
    free(request->sets);
    *request = (struct request){0};
}
