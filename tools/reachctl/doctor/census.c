#include "tools/reachctl/doctor/census.h"

#include "common/base/big_endian.h"
#include "common/bus/refusals_text.h"
#include "common/bus/status_words.h"
#include "common/bus/troubles_text.h"
#include "common/program/printable.h"

#include <arpa/inet.h>
#include <bot_core_joint_state_t.h>
#include <math.h>
#include <reach_config_t.h>
#include <reach_end_effector_t.h>
#include <reach_learner_prediction_t.h>
#include <reach_learner_reply_t.h>
#include <reach_marker_t.h>
#include <reach_robot_command_t.h>
#include <reach_robot_state_t.h>
#include <reach_sample_t.h>
#include <reach_sim_truth_t.h>
#include <reach_status_t.h>
#include <reach_trace_t.h>
#include <string.h>

static const double clock_tolerance = 0.1; /* s; reachd suspends what is older */

/* The channels that one program alone may speak on. */
static const struct {
    const char *name;
    int64_t (*fingerprint)(void); /* NULL: whatever it is */
} channels[CENSUS_CHANNELS] = {
    {"ROBOT_STATE", __reach_robot_state_t_get_hash},
    {"ROBOT_COMMAND", __reach_robot_command_t_get_hash},
    {"MARKER", __reach_marker_t_get_hash},
    {"STEREO_IMAGES", NULL},
    {"END_EFFECTOR", __reach_end_effector_t_get_hash},
    {"REACH_STATUS", __reach_status_t_get_hash},
    {"REACH_TRACE", __reach_trace_t_get_hash},
    {"REACH_CONFIG", __reach_config_t_get_hash},
    {"REACH_SAMPLE", __reach_sample_t_get_hash},
    {"SIM_TRUTH", __reach_sim_truth_t_get_hash},
    {"LEARNER_REPLY", __reach_learner_reply_t_get_hash},
    {"LEARNER_PREDICTION", __reach_learner_prediction_t_get_hash},
};

/* By role; a recorder has no version of ours. */
static const char *const roles[] = {"reachd",        "simrobot", "vision",
                                    "reach-learner", NULL,       "reach-finder"};
enum { N_ROLES = sizeof roles / sizeof roles[0] };

static void take_sender(struct census *census, int index, const struct sender *from)
{
    int n = census->channel[index].n_senders;

    for (int i = 0; i < n; i++) {
        const struct sender *known = &census->channel[index].senders[i];
        if (known->address.s_addr == from->address.s_addr && known->port == from->port)
            return;
    }
    if (n < CENSUS_SENDERS)
        census->channel[index].senders[census->channel[index].n_senders++] = *from;
}

static void take_hello(struct census *census, const struct packet *packet)
{
    reach_hello_t hello;

    if (reach_hello_t_decode(packet->payload, 0, (int)packet->payload_size, &hello) >= 0 &&
        hello.answer && hello.instance == census->instance && census->n_answers < CENSUS_ANSWERS)
        census->answers[census->n_answers++] = hello;
}

static void take_clock(struct census *census, const struct packet *packet, int64_t now)
{
    reach_robot_state_t state;

    if (reach_robot_state_t_decode(packet->payload, 0, (int)packet->payload_size, &state) < 0 ||
        state.lockstep)
        return;
    census->has_clock = true;
    census->clock_ahead = (double)(state.utime - now) * 1e-6;
}

static void take_status(struct census *census, const struct packet *packet)
{
    reach_status_t status;

    if (reach_status_t_decode(packet->payload, 0, (int)packet->payload_size, &status) < 0)
        return;
    if (!census->has_status)
        census->first_status = status;
    census->has_status = true;
    census->status = status;
}

/* What the robot calls its joints: the strings that follow time and count in a joint_state_t, by
 * hand, for LCM's own decoder trusts their lengths. */
static void take_names(struct census *census, const struct packet *packet)
{
    enum { COUNT_AT = 16, NAMES_AT = COUNT_AT + 2, LENGTH = 4 };
    const unsigned char *at = packet->payload + NAMES_AT;
    const unsigned char *end = packet->payload + packet->payload_size;

    if (packet->payload_size < NAMES_AT ||
        packet_fingerprint(packet) != __bot_core_joint_state_t_get_hash())
        return;
    int n = (int)big_endian(packet->payload + COUNT_AT, 2);
    for (int i = 0; i < n && i < CENSUS_JOINTS && end - at >= LENGTH; i++) {
        size_t length = (size_t)big_endian(at, LENGTH);
        at += LENGTH;
        if (length > (size_t)(end - at))
            return;
        printable((const char *)at, length, census->joint[i], sizeof census->joint[i]);
        at += length;
    }
}

void census_take(struct census *census, const struct packet *packet, const struct sender *from,
                 int64_t now)
{
    for (int i = 0; i < CENSUS_CHANNELS; i++) {
        if (strcmp(packet->channel, channels[i].name) != 0)
            continue;
        take_sender(census, i, from);
        if (channels[i].fingerprint && packet_fingerprint(packet) != channels[i].fingerprint())
            census->channel[i].foreign = true;
    }
    if (strcmp(packet->channel, "REACH_HELLO") == 0)
        take_hello(census, packet);
    else if (strcmp(packet->channel, "ROBOT_STATE") == 0)
        take_clock(census, packet, now);
    else if (strcmp(packet->channel, "REACH_STATUS") == 0)
        take_status(census, packet);
    else if (strcmp(packet->channel, "JOINT_STATE") == 0)
        take_names(census, packet);
}

static void name_senders(const struct census *census, int index, char *text, size_t size)
{
    size_t length = 0;

    for (int i = 0; i < census->channel[index].n_senders && length < size; i++) {
        const struct sender *sender = &census->channel[index].senders[i];
        char address[INET_ADDRSTRLEN] = "?";
        inet_ntop(AF_INET, &sender->address, address, sizeof address);
        length += (size_t)snprintf(text + length, size - length, "%s%s:%d", i ? " and " : "",
                                   address, ntohs(sender->port));
    }
}

static void report_channel(const struct census *census, int index, struct findings *findings)
{
    char senders[128] = "";

    name_senders(census, index, senders, sizeof senders);
    if (census->channel[index].n_senders > 1) {
        findings_add(findings, VERDICT_FINDING, "senders", "%s comes from %s", channels[index].name,
                     senders);
        findings_remedy(findings, "ss -uapn 'sport = :%d' names the program; end one of them",
                        ntohs(census->channel[index].senders[1].port));
    }
    if (census->channel[index].foreign) {
        findings_add(findings, VERDICT_FINDING, "layout",
                     "%s from %s is not laid out as this version has it", channels[index].name,
                     senders);
        findings_remedy(findings, "./run build, and start all programs anew");
    }
}

static void report_role(const struct census *census, int role, const char *ours,
                        struct findings *findings)
{
    int answered = 0;

    for (int i = 0; i < census->n_answers; i++) {
        const char *revision = (const char *)census->answers[i].revision;
        size_t most = sizeof census->answers[i].revision;
        char text[4 * sizeof census->answers[i].revision + 1];
        if (census->answers[i].role != role)
            continue;
        answered++;
        if (strncmp(revision, ours, most) == 0) {
            findings_add(findings, VERDICT_OK, "version", "%s %s", roles[role], ours);
            continue;
        }
        findings_add(findings, VERDICT_FINDING, "version", "%s is %s, reachctl is %s", roles[role],
                     printable(revision, most, text, sizeof text), ours);
        findings_remedy(findings, "./run build, and start %s anew", roles[role]);
    }
    if (!answered)
        findings_add(findings, VERDICT_SKIPPED, "version", "%s does not run", roles[role]);
}

/* " (NAME)", or "" where nobody told what joint `number` is called. */
static const char *named(const struct census *census, int number, char *text, size_t size)
{
    text[0] = '\0';
    if (number >= 1 && number <= CENSUS_JOINTS && census->joint[number - 1][0])
        snprintf(text, size, " (joint %d is %s)", number, census->joint[number - 1]);
    return text;
}

/* What reachd refuses at present has to be mended; what it once refused is told. */
static void report_refusals(const struct census *census, struct findings *findings)
{
    const reach_status_t *status = &census->status;
    char now[200], all[200], name[96];

    refusals_text(status, &census->first_status, now, sizeof now);
    refusals_text(status, NULL, all, sizeof all);
    if (!now[0]) {
        findings_add(findings, VERDICT_OK, "refused messages", "%s%s",
                     all[0] ? "none now; since reachd's start: " : "none", all);
        return;
    }
    findings_add(findings, VERDICT_FINDING, "refused messages", "just now: %s%s", now,
                 named(census, status->refused_joint, name, sizeof name));
    if (status->refused_state != census->first_status.refused_state && status->refused_joint > 0)
        findings_remedy(findings, "arm.min, arm.max (head.min, head.max) of reachd's configuration "
                                  "must hold the robot as it stands; or bring it within them "
                                  "(reachctl sim reset)");
    else
        findings_remedy(findings, "journalctl -u reachd names them; find who sends them");
}

/* Why reachd does nothing, if it is in its fault state. */
static void report_fault(const struct census *census, struct findings *findings)
{
    const reach_status_t *status = &census->status;
    char fault[128], name[96];

    if (status->state != REACH_STATUS_T_FAULT) {
        findings_add(findings, VERDICT_OK, "fault", "reachd is in none");
        return;
    }
    status_fault_text(status, fault, sizeof fault);
    findings_add(findings, VERDICT_FINDING, "fault", "%s%s", fault,
                 named(census, status->fault_joint, name, sizeof name));
    if (status->fault == REACH_STATUS_T_FAULT_STILL || status->fault == REACH_STATUS_T_FAULT_ASTRAY)
        findings_remedy(findings,
                        "look at its motor, brake and encoder, at what it touches, and whether it "
                        "is too weak for the arm's weight (a simulated robot: reach-simrobot "
                        "--check); then reachctl reset-fault");
    else
        findings_remedy(findings, "mend that, then reachctl reset-fault");
}

/* Each line ends with what to do. */
static void report_troubles(const struct census *census, struct findings *findings)
{
    char text[300];

    for (int kind = 0; kind < TROUBLES; kind++)
        if (trouble_text(&census->status, kind, text, sizeof text))
            findings_add(findings, VERDICT_FINDING, "samples", "%s", text);
}

void census_report(const struct census *census, const char *ours, struct findings *findings)
{
    int before = findings->n;

    for (int i = 0; i < CENSUS_CHANNELS; i++)
        report_channel(census, i, findings);
    if (findings->n == before)
        findings_add(findings, VERDICT_OK, "senders", "one for each channel, and our layouts");
    for (int role = 0; role < N_ROLES; role++)
        if (roles[role])
            report_role(census, role, ours, findings);
    if (census->has_status) {
        report_refusals(census, findings);
        report_fault(census, findings);
        report_troubles(census, findings);
    }
    if (!census->has_clock)
        return;
    if (fabs(census->clock_ahead) <= clock_tolerance) {
        findings_add(findings, VERDICT_OK, "robot's clock", "%.3f s from ours",
                     census->clock_ahead);
        return;
    }
    findings_add(findings, VERDICT_FINDING, "robot's clock", "%.3f s from ours",
                 census->clock_ahead);
    findings_remedy(findings, "timedatectl set-ntp true, on both machines");
}
