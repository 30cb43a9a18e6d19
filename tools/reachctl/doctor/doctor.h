/* `reachctl doctor`: is this machine, and the bus on it, fit for the programs? */
#ifndef REACH_TOOLS_REACHCTL_DOCTOR_DOCTOR_H
#define REACH_TOOLS_REACHCTL_DOCTOR_DOCTOR_H

#include "tools/reachctl/doctor/findings.h"

/* The system: real-time priority, locked memory, what draws the eyes, cameras, the clock.
 * Each try is made in a child, so that nothing of it stays. */
void doctor_system(struct findings *findings);

/* The way of messages to the bus at `url`: route, loopback flag, receive buffer. */
void doctor_network(const char *url, struct findings *findings);

/* Who is on the bus at `url`: versions, senders, layouts, their clocks. Listens for 1.5 s. */
void doctor_bus(const char *url, struct findings *findings);

/* All of it, printed as text or as JSON. `url` NULL is the usual bus.
 *   returns 0 when nothing has to be mended, else -1 with one line in `error` */
int doctor_run(const char *url, bool json, char *error, size_t error_size);

#endif
