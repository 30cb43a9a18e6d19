#include "daemon/config/text.h"

#include "common/base/checksum.h"
#include "common/bus/open.h"
#include "common/program/version.h"
#include "daemon/config/defaults.h"
#include "daemon/config/table.h"

#include <stdio.h>
#include <string.h>

enum { LINE_SIZE = 64 + 2 * OPTION_TEXT_SIZE };

/* Value and name, as --set takes them and as YAML does. A text stands in quotes, since YAML would
 * take some characters otherwise. */
static void write_row(const struct option_row *row, const struct config *config,
                      const char *between, char out[LINE_SIZE])
{
    char value[OPTION_TEXT_SIZE];
    bool list = row->type == OPTION_LIST || row->type == OPTION_SPREAD;
    char *end = out + sprintf(out, "%s%s", row->name, between);

    option_text(row, config, value);
    if (list && !value[0])
        strcpy(end, "[]");
    else if (row->type != OPTION_TEXT)
        strcpy(end, value);
    else {
        *end++ = '\'';
        for (const char *c = value; *c; c++) {
            *end++ = *c;
            if (*c == '\'')
                *end++ = '\'';
        }
        strcpy(end, "'");
    }
}

int config_text(const struct config *config, char text[CONFIG_TEXT_SIZE])
{
    char next[LINE_SIZE];
    int used = 0;

    text[0] = '\0';
    for (const struct option_row *row = config_table(); row->name; row++) {
        write_row(row, config, "=", next);
        used += snprintf(text + used, (size_t)(CONFIG_TEXT_SIZE - used), "%s\n", next);
        if (used >= CONFIG_TEXT_SIZE)
            return -1;
    }
    return used;
}

/* What it follows from, where that is the robot. */
static void print_reason(const struct option_row *row, const char *line,
                         const struct config *derived, FILE *out)
{
    const char *reason = config_default_reason(row->name);
    char would_be[LINE_SIZE];

    if (!reason)
        return;
    write_row(row, derived, ": ", would_be);
    if (strcmp(line, would_be) == 0)
        fprintf(out, "  # derived: %s", reason);
    else
        fprintf(out, "  # named, else %s", would_be + strlen(row->name) + strlen(": "));
}

void config_print(const struct config *config, FILE *out)
{
    struct config derived;
    char line[LINE_SIZE];

    config_preset(&derived);
    config_set_defaults(&derived, config);
    for (const struct option_row *row = config_table(); row->name; row++) {
        write_row(row, config, ": ", line);
        fputs(line, out);
        print_reason(row, line, &derived, out);
        fputc('\n', out);
    }
}

uint32_t config_text_checksum(const char *text)
{
    return checksum_crc32(text, strlen(text));
}

void config_message(const struct config *config, reach_config_t *message)
{
    memset(message, 0, sizeof *message);
    message->utime = bus_utime();
    message->checksum = (int32_t)config->checksum;
    snprintf((char *)message->revision, sizeof message->revision, "%s", reach_version);
    config_text(config, (char *)message->text);
}
