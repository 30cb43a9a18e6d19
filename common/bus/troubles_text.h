/* What a status says of the samples that the model learns from, for people. */
#ifndef REACH_COMMON_BUS_TROUBLES_TEXT_H
#define REACH_COMMON_BUS_TROUBLES_TEXT_H

#include <reach_status_t.h>
#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { TROUBLES = 11 /* kinds of trouble: bits of status_t.troubles */ };

/* One line on the trouble with bit 1 << `kind`, with what to do. Returns false when the status does
 * not have it. */
bool trouble_text(const reach_status_t *status, int kind, char *text, size_t size);

#ifdef __cplusplus
}
#endif

#endif
