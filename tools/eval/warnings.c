#include "tools/eval/warnings.h"

#include <stdarg.h>
#include <stdio.h>

void warnings_add(struct warnings *warnings, const char *format, ...)
{
    va_list arguments;

    if (warnings->n == WARNINGS_MOST)
        return;
    char *text = warnings->text[warnings->n++];
    va_start(arguments, format);
    vsnprintf(text, WARNING_SIZE, format, arguments);
    va_end(arguments);
    fprintf(stderr, "reach-eval: warning: %s\n", text);
}

static void add_troubles(struct warnings *warnings, const char *origin, const struct health *health,
                         const struct learner_statistics *statistics, unsigned troubles)
{
    char text[WARNING_SIZE / 2];

    for (int trouble = 0; trouble < HEALTH_TROUBLES; trouble++)
        if (troubles & 1U << trouble) {
            health_tell(health, statistics, (enum health_trouble)trouble, text, sizeof text);
            warnings_add(warnings, "%s: %s", origin, text);
        }
}

void warnings_of_health(struct warnings *warnings, const struct health *health,
                        const struct learner_statistics *statistics)
{
    add_troubles(warnings, "training", health, statistics, health_judge(health, statistics));
}

void warnings_of_set(struct warnings *warnings, const struct health *health, const char *path,
                     const struct csv_table *table)
{
    const struct learner_statistics none = {0};
    struct health of_set = *health;

    health_forget(&of_set);
    for (size_t row = 0; row < table->n_rows; row++)
        health_look(&of_set, csv_input(table, row), csv_output(table, row));
    add_troubles(warnings, path, &of_set, &none,
                 health_judge(&of_set, &none) & (1U << HEALTH_FAR | 1U << HEALTH_FROZEN));
}

void warnings_to_json(const struct warnings *warnings, struct json *json)
{
    json_array(json, "warnings");
    for (int i = 0; i < warnings->n; i++)
        json_text(json, NULL, warnings->text[i]);
    json_end_array(json);
}
