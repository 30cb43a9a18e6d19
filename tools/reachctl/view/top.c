#include "tools/reachctl/view/top.h"

#include "common/bus/open.h"
#include "tools/reachctl/view/terminal.h"
#include "tools/reachctl/view/top_view.h"

#include <lcm/lcm.h>

enum { QUEUE = 100000 }; /* messages that may wait while a frame is drawn */

static const int64_t frame_us = 250000;
static const int64_t longest_wait_us = 60000000;
static const int64_t first_look_us = 1100000; /* a window of the rates, and some */
/* A frame that is not for a terminal: wide and high enough for everything. */
static const int page_width = 132;
static const int page_height = 66 + RATES_MOST;

static void on_any(const lcm_recv_buf_t *message, const char *channel, void *user)
{
    int64_t now = bus_monotonic_us();
    int64_t waited =
        bus_utime() - message->recv_utime; /* a clock that was set may make it nonsense */

    if (waited < 0 || waited > longest_wait_us)
        waited = 0;
    top_note_lateness(user, waited, now);
    top_hear(user, channel, message->data, message->data_size, now - waited);
}

static void listen_until(lcm_t *lcm, int64_t end)
{
    int64_t left;

    while ((left = end - bus_monotonic_us()) > 0 && !terminal_ended())
        lcm_handle_timeout(lcm, (int)(left / 1000) + 1);
}

/* Packets that found a full socket, whoever's, in this network; 0 when the kernel does not tell. */
static int64_t full_sockets(void)
{
    FILE *file = fopen("/proc/net/snmp", "r");
    char text[512];
    long long errors = 0;

    while (file && fgets(text, sizeof text, file)) /* datagrams: in, no port, errors, out, full */
        if (sscanf(text, "Udp: %*u %*u %*u %*u %lld", &errors) == 1)
            break;
    if (file)
        fclose(file);
    return errors;
}

static int show_once(lcm_t *lcm, struct top *top, double timeout, char *error, size_t error_size)
{
    int64_t start = bus_monotonic_us();
    int64_t full = full_sockets();
    int64_t end = start + (int64_t)(timeout * 1e6);

    do {
        listen_until(lcm, bus_monotonic_us() + first_look_us);
        top_settle(top, bus_monotonic_us());
    } while (top->speed == 0 && bus_monotonic_us() < end);
    top->dropped = full_sockets() - full;
    top_draw(top, bus_monotonic_us(), page_width, page_height, false, stdout);
    if (top->status_at)
        return 0;
    snprintf(error, error_size, "no status from reachd in %g s", timeout);
    return -1;
}

static int show_until_quit(lcm_t *lcm, struct top *top, char *error, size_t error_size)
{
    int64_t full = full_sockets();
    int width;
    int height;

    if (terminal_enter()) {
        snprintf(error, error_size, "top wants a terminal; with --once it prints one frame");
        return -1;
    }
    while (!terminal_ended() && terminal_key() != 'q') {
        terminal_size(&width, &height);
        top_settle(top, bus_monotonic_us());
        top->dropped = full_sockets() - full;
        top_draw(top, bus_monotonic_us(), width, height, true, stdout);
        listen_until(lcm, bus_monotonic_us() + frame_us);
    }
    terminal_leave();
    return 0;
}

int top_run(const char *url, bool once, double timeout, char *error, size_t error_size)
{
    static struct top top;
    lcm_t *lcm = bus_open(url, error, error_size);
    lcm_subscription_t *everything;
    int result;

    if (!lcm)
        return -1;
    everything = lcm_subscribe(lcm, ".*", on_any, &top);
    lcm_subscription_set_queue_capacity(everything, QUEUE);
    result = once ? show_once(lcm, &top, timeout, error, error_size)
                  : show_until_quit(lcm, &top, error, error_size);
    lcm_destroy(lcm);
    return result;
}
