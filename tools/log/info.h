/* `reach-log info`: what is in a log, as text or as JSON. */
#ifndef REACH_TOOLS_LOG_INFO_H
#define REACH_TOOLS_LOG_INFO_H

#include "tools/log/survey.h"

#include <stdio.h>

void info_print(const struct survey *survey, const char *path, FILE *out);
void info_print_json(const struct survey *survey, FILE *out);

#endif
