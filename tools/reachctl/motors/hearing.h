/* Listens to commands and states while the daemon moves each joint a little, and says what each
 * joint made of it. */
#ifndef REACHCTL_MOTORS_HEARING_H
#define REACHCTL_MOTORS_HEARING_H

#include <lcm/lcm.h>

struct motors_hearing;

/* From now on, as the bus is handled. Returns NULL when there is no memory. */
struct motors_hearing *motors_listen(lcm_t *bus);

/* Prints a line a joint. Returns how many joints are not well, or -1 when no command was heard. */
int motors_print(const struct motors_hearing *hearing);

void motors_end(struct motors_hearing *hearing);

#endif
