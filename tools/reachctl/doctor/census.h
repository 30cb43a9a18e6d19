/* Who speaks on the bus, by what comes out of its packets: addresses, layouts, versions, clocks. */
#ifndef REACH_TOOLS_REACHCTL_DOCTOR_CENSUS_H
#define REACH_TOOLS_REACHCTL_DOCTOR_CENSUS_H

#include "tools/reachctl/doctor/findings.h"
#include "tools/reachctl/doctor/packet.h"

#include <netinet/in.h>
#include <reach_hello_t.h>
#include <reach_status_t.h>

enum { CENSUS_CHANNELS = 12, CENSUS_SENDERS = 4, CENSUS_ANSWERS = 8, CENSUS_JOINTS = 16 };

struct sender {
    struct in_addr address;
    in_port_t port; /* network order, as the address */
};

/* All zero is a fresh one. */
struct census {
    struct {
        int n_senders;
        struct sender senders[CENSUS_SENDERS];
        bool foreign; /* a message of another layout than ours */
    } channel[CENSUS_CHANNELS];
    int64_t instance; /* hellos that ask with it are ours */
    int n_answers;
    reach_hello_t answers[CENSUS_ANSWERS];
    bool has_clock;
    bool has_status;
    reach_status_t first_status, status; /* of reachd: the first and the newest heard */
    char joint[CENSUS_JOINTS][64];       /* names, from JOINT_STATE, as far as they are told */
    double clock_ahead;                  /* of the robot's clock over ours, s; in real time */
};

/* Takes in a packet that came from `from` at `now` (us since the epoch). */
void census_take(struct census *census, const struct packet *packet, const struct sender *from,
                 int64_t now);

/* What is to be said about it, by a program of version `ours`. */
void census_report(const struct census *census, const char *ours, struct findings *findings);

#endif
