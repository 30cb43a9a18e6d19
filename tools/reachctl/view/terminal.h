/* The terminal as a page: keys without Enter, a screen that is given back at the end. */
#ifndef REACHCTL_VIEW_TERMINAL_H
#define REACHCTL_VIEW_TERMINAL_H

#include <stdbool.h>

/* Takes over standard input and output; terminal_leave, also called at exit, gives them back.
 * SIGINT, SIGTERM and SIGHUP no longer end the program but are told by terminal_ended.
 *   returns 0, or -1 when either is no terminal */
int terminal_enter(void);
void terminal_leave(void);

/* Whether one of those signals has come. */
bool terminal_ended(void);

/* As it is now; it may change at any time. */
void terminal_size(int *width, int *height);

/* A key that was pressed, or 0. */
char terminal_key(void);

#endif
