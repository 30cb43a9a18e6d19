#include "common/bus/multicast.h"
#include "tools/reachctl/doctor/doctor.h"

#include <net/if.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

/* Two raw images of 640x480 pixels, 3 bytes each, and what the kernel adds. */
static const int pair_bytes = 2 * 640 * 480 * 3;
static const int wanted_bytes = 8 << 20;

/* What a socket really gets; the kernel doubles what it grants, for its own use. */
static int granted(int descriptor)
{
    int size = 0;
    socklen_t length = sizeof size;

    setsockopt(descriptor, SOL_SOCKET, SO_RCVBUF, &wanted_bytes, sizeof wanted_bytes);
    getsockopt(descriptor, SOL_SOCKET, SO_RCVBUF, &size, &length);
    return size / 2;
}

static void check_flags(struct findings *findings, int descriptor, const char *interface)
{
    struct ifreq request = {0};

    snprintf(request.ifr_name, sizeof request.ifr_name, "%s", interface);
    if (ioctl(descriptor, SIOCGIFFLAGS, &request) == 0 && request.ifr_flags & IFF_MULTICAST) {
        findings_add(findings, VERDICT_OK, "multicast flag", "%s has it", interface);
        return;
    }
    findings_add(findings, VERDICT_FINDING, "multicast flag", "%s lacks it", interface);
    findings_remedy(findings, "ip link set %s multicast on", interface);
}

static void check_route(struct findings *findings, const struct multicast *bus, int descriptor)
{
    char interface[IF_NAMESIZE];

    if (multicast_route(bus, interface)) {
        findings_add(findings, VERDICT_FINDING, "multicast route", "%s cannot be reached",
                     bus->group);
        findings_remedy(findings, "reach-lcm-setup, or: ip route add 224.0.0.0/4 dev lo");
        return;
    }
    findings_add(findings, VERDICT_OK, "multicast route", "%s by %s", bus->group, interface);
    check_flags(findings, descriptor, interface);
}

static void check_buffer(struct findings *findings, int descriptor)
{
    int size = granted(descriptor);

    if (size >= pair_bytes) {
        findings_add(findings, VERDICT_OK, "receive buffer",
                     "%d bytes; a pair of raw images has %d", size, pair_bytes);
        return;
    }
    findings_add(findings, VERDICT_FINDING, "receive buffer",
                 "%d bytes, but a pair of raw images has %d and would be lost", size, pair_bytes);
    findings_remedy(findings, "reach-lcm-setup, or: sysctl -w net.core.rmem_max=%d", wanted_bytes);
}

void doctor_network(const char *url, struct findings *findings)
{
    struct multicast bus;
    int descriptor = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);

    if (descriptor < 0 || multicast_parse(url, &bus)) {
        findings_add(findings, VERDICT_FINDING, "bus address", "%s cannot be read", url);
        findings_remedy(findings, "unset LCM_DEFAULT_URL");
    } else {
        check_route(findings, &bus, descriptor);
        check_buffer(findings, descriptor);
    }
    if (descriptor >= 0)
        close(descriptor);
}
