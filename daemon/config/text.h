/* A configuration as one text, which gives it again to the last bit: lines "name=value", as --set
 * takes them, for every option. config_from_text() loads it; a log holds it, so that it can be
 * replayed without the files. */
#ifndef REACH_DAEMON_CONFIG_TEXT_H
#define REACH_DAEMON_CONFIG_TEXT_H

#include "daemon/config/config.h"

#include <reach_config_t.h>
#include <stdio.h>

enum { CONFIG_TEXT_SIZE = sizeof((reach_config_t *)0)->text }; /* with its terminator */

/* The text of what was loaded. Returns its length, or -1 when it does not fit. */
int config_text(const struct config *config, char text[CONFIG_TEXT_SIZE]);

/* CRC-32 of the text. */
uint32_t config_text_checksum(const char *text);

/* Every option as YAML, in people's units; those whose defaults follow from the robot with what
 * they follow from. */
void config_print(const struct config *config, FILE *out);

/* The message for the bus. */
void config_message(const struct config *config, reach_config_t *message);

#endif
