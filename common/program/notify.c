#include "common/program/notify.h"

#include <errno.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

/* Where to send. '@' in front is a name without a file. Returns the address's length, 0 when it is
 * none of ours. */
static socklen_t address_of(const char *path, struct sockaddr_un *address)
{
    size_t length = strlen(path);

    if ((path[0] != '/' && path[0] != '@') || length >= sizeof address->sun_path)
        return 0;
    *address = (struct sockaddr_un){.sun_family = AF_UNIX};
    memcpy(address->sun_path, path, length);
    if (path[0] == '@')
        address->sun_path[0] = '\0';
    return (socklen_t)(offsetof(struct sockaddr_un, sun_path) + length);
}

static int send_text(const char *path, const char *text, size_t length)
{
    struct sockaddr_un address;
    socklen_t address_length = address_of(path, &address);
    ssize_t sent;
    int descriptor, failure;

    if (!address_length) {
        errno = EAFNOSUPPORT;
        return -1;
    }
    descriptor = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (descriptor < 0)
        return -1;
    sent = sendto(descriptor, text, length, MSG_NOSIGNAL, (const struct sockaddr *)&address,
                  address_length);
    failure = errno;
    close(descriptor);
    errno = failure;
    return sent == (ssize_t)length ? 1 : -1;
}

int notify_send(const char *format, ...)
{
    const char *path = getenv("NOTIFY_SOCKET");
    char text[1024];
    va_list arguments;
    int length;

    if (!path || !*path)
        return 0;
    va_start(arguments, format);
    length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (length < 0)
        return -1;
    return send_text(path, text, strnlen(text, sizeof text));
}

struct notify_watchdog notify_watchdog_open(void)
{
    const char *interval = getenv("WATCHDOG_USEC"), *process = getenv("WATCHDOG_PID");
    struct notify_watchdog watchdog = {0};

    if (!interval || (process && strtoll(process, NULL, 10) != (long long)getpid()))
        return watchdog;
    watchdog.interval = strtoll(interval, NULL, 10);
    if (watchdog.interval < 0)
        watchdog.interval = 0;
    return watchdog;
}

int notify_watchdog_feed(struct notify_watchdog *watchdog, int64_t now)
{
    if (!watchdog->interval || now - watchdog->fed < watchdog->interval / 2)
        return 0;
    watchdog->fed = now;
    return notify_send("WATCHDOG=1") > 0;
}
