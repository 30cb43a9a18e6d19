#include "common/bus/multicast.h"
#include "common/bus/open.h"
#include "common/program/version.h"
#include "tools/reachctl/doctor/census.h"
#include "tools/reachctl/doctor/doctor.h"

#include <poll.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <unistd.h>

static const int64_t listen_us = 1500000;
enum { PACKET_MOST = 65536 };

/* Everybody answers for their role. */
static void ask_who_is_there(lcm_t *lcm, struct census *census)
{
    static const int8_t roles[] = {REACH_HELLO_T_DAEMON, REACH_HELLO_T_SIMULATOR,
                                   REACH_HELLO_T_VISION, REACH_HELLO_T_LEARNER,
                                   REACH_HELLO_T_FINDER};
    reach_hello_t hello = {.utime = bus_utime()};

    if (getrandom(&census->instance, sizeof census->instance, 0) < 0)
        census->instance = bus_utime();
    hello.instance = census->instance;
    for (size_t i = 0; i < sizeof roles; i++) {
        hello.role = roles[i];
        reach_hello_t_publish(lcm, "REACH_HELLO", &hello);
    }
}

static void take_packet(int descriptor, struct census *census)
{
    static unsigned char data[PACKET_MOST];
    struct sockaddr_in from = {0};
    socklen_t size = sizeof from;
    struct packet packet;
    ssize_t length = recvfrom(descriptor, data, sizeof data, 0, (struct sockaddr *)&from, &size);

    if (length > 0 && packet_read(data, (size_t)length, &packet))
        census_take(census, &packet, &(struct sender){from.sin_addr, from.sin_port}, bus_utime());
}

static void listen_to(int descriptor, struct census *census)
{
    int64_t end = bus_monotonic_us() + listen_us;
    struct pollfd input = {descriptor, POLLIN, 0};
    int64_t left;

    while ((left = end - bus_monotonic_us()) > 0)
        if (poll(&input, 1, (int)(left / 1000) + 1) > 0)
            take_packet(descriptor, census);
}

void doctor_bus(const char *url, struct findings *findings)
{
    static struct census census;
    struct multicast bus;
    char error[512];
    lcm_t *lcm = bus_open(url, error, sizeof error);
    int descriptor = multicast_parse(url, &bus) ? -1 : multicast_listen(&bus);

    if (!lcm || descriptor < 0) {
        findings_add(findings, VERDICT_FINDING, "messages", "none gets through");
        findings_remedy(findings, "see above; a firewall? iptables -I INPUT -d %s -j ACCEPT",
                        bus.group);
    } else {
        findings_add(findings, VERDICT_OK, "messages", "they get through");
        ask_who_is_there(lcm, &census);
        listen_to(descriptor, &census);
        census_report(&census, reach_version, findings);
    }
    if (descriptor >= 0)
        close(descriptor);
    if (lcm)
        lcm_destroy(lcm);
}
