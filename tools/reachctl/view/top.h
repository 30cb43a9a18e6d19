/* `reachctl top`: the bus at a glance, four times a second. */
#ifndef REACHCTL_VIEW_TOP_H
#define REACHCTL_VIEW_TOP_H

#include <stdbool.h>
#include <stddef.h>

/* Shows frames until q or Ctrl-C. `once`: listens until the daemon's speed is known, two seconds or
 * so, and at most for `timeout`, then prints one frame as text; fails when no daemon was heard.
 * `url` NULL is the usual bus.
 *   returns 0, or -1 with one line in `error` */
int top_run(const char *url, bool once, double timeout, char *error, size_t error_size);

#endif
