/* What an examination found: a list of checks, each with its verdict and the command that mends. */
#ifndef REACH_TOOLS_REACHCTL_DOCTOR_FINDINGS_H
#define REACH_TOOLS_REACHCTL_DOCTOR_FINDINGS_H

#include <stdbool.h>
#include <stdio.h>

enum { FINDINGS_MOST = 64 };

enum verdict {
    VERDICT_OK,
    VERDICT_FINDING,
    VERDICT_SKIPPED, /* nothing to look at here, which is no fault */
};

struct finding {
    const char *check; /* such as "multicast route" */
    enum verdict verdict;
    char text[256];
    char remedy[256]; /* a command; of a VERDICT_FINDING */
};

/* All zero is an empty one. What does not fit is dropped. */
struct findings {
    int n;
    struct finding list[FINDINGS_MOST];
};

/* `check` is kept, not copied. */
void findings_add(struct findings *findings, enum verdict verdict, const char *check,
                  const char *format, ...) __attribute__((format(printf, 4, 5)));

/* The command that mends what was added last. */
void findings_remedy(struct findings *findings, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Whether nothing has to be mended. */
bool findings_all_well(const struct findings *findings);

/* For people, a line for each check and one for each command. */
void findings_print(const struct findings *findings, FILE *out);

/* For programs: a JSON list of {"check", "verdict", "text", "remedy"}. */
void findings_print_json(const struct findings *findings, FILE *out);

#endif
