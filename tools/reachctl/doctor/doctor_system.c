#include "common/base/thread.h"
#include "common/bus/open.h"
#include "tools/reachctl/doctor/doctor.h"

#include <errno.h>
#include <fcntl.h>
#include <glob.h>
#include <libgen.h>
#include <limits.h>
#include <linux/videodev2.h>
#include <pwd.h>
#include <sched.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/timex.h>
#include <sys/wait.h>
#include <unistd.h>

/* Room for a large model; etc/systemd grants more. */
static const size_t memory = 96UL << 20; /* bytes */

static const int64_t earliest_us = 1735689600000000; /* 2025: before it, no clock is right */

/* What `attempt` returns, 0 or an errno, when a child does it. */
static int in_child(int (*attempt)(void))
{
    pid_t child = fork();
    int status;

    if (child == 0)
        _exit(attempt());
    if (child < 0 || waitpid(child, &status, 0) < 0)
        return errno;
    return WIFEXITED(status) ? WEXITSTATUS(status) : EFAULT;
}

static int take_priority(void)
{
    struct sched_param parameters = {.sched_priority = THREAD_PRIORITY_WATCHDOG};

    return sched_setscheduler(0, SCHED_FIFO, &parameters) ? errno : 0;
}

static int lock_memory(void)
{
    if (mlockall(MCL_CURRENT | MCL_FUTURE))
        return errno;
    return mmap(NULL, memory, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) ==
                   MAP_FAILED
               ? errno
               : 0;
}

/* The user as the machine knows him: inside a user namespace, root is often somebody else. */
static uid_t user_outside(void)
{
    unsigned inside, outside, count, me = getuid();
    FILE *map = fopen("/proc/self/uid_map", "r");

    while (map && fscanf(map, "%u %u %u", &inside, &outside, &count) == 3)
        if (me >= inside && me - inside < count) {
            me = outside + (me - inside);
            break;
        }
    if (map)
        fclose(map);
    return me;
}

static void grant(struct findings *findings, const char *limit, int value)
{
    uid_t uid = user_outside();
    const struct passwd *user = getpwuid(uid);
    char number[16]; /* limits.conf takes a number behind a colon in a name's place */

    snprintf(number, sizeof number, ":%u", (unsigned)uid);
    findings_remedy(findings,
                    "echo '%s - %s %d' >> /etc/security/limits.d/reach.conf as root, log in again",
                    user ? user->pw_name : number, limit, value);
}

static void check_real_time(struct findings *findings)
{
    int failed = in_child(take_priority);

    if (failed == 0) {
        findings_add(findings, VERDICT_OK, "real time", "SCHED_FIFO, priority %d",
                     THREAD_PRIORITY_WATCHDOG);
        return;
    }
    findings_add(findings, VERDICT_FINDING, "real time", "SCHED_FIFO, priority %d: %s",
                 THREAD_PRIORITY_WATCHDOG, strerror(failed));
    grant(findings, "rtprio", THREAD_PRIORITY_WATCHDOG);
}

static void check_memory(struct findings *findings)
{
    int failed = in_child(lock_memory);

    if (failed == 0) {
        findings_add(findings, VERDICT_OK, "memory lock", "%zu MB can be locked", memory >> 20);
        return;
    }
    findings_add(findings, VERDICT_FINDING, "memory lock", "%zu MB cannot be locked: %s",
                 memory >> 20, strerror(failed));
    grant(findings, "memlock", 524288);
}

/* The simulator beside this program. Returns false when there is none. */
static bool find_simulator(char *path, size_t size)
{
    char self[PATH_MAX];
    ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);

    if (length <= 0)
        return false;
    self[length] = '\0';
    dirname(self);
    return snprintf(path, size, "%s/reach-simrobot", self) < (int)size && access(path, X_OK) == 0;
}

/* What the program says at last, on stdout or else on stderr; returns its exit code, -1 when it
 * failed. All is read: who is not listened to would be ended by SIGPIPE. Mesa's warnings, on
 * stderr, are no result. */
static int last_line(const char *program, const char *option, char *line, size_t size)
{
    char command[PATH_MAX + 64], read[256];
    FILE *output;
    int status;

    snprintf(command, sizeof command, "'%s' %s 2>/dev/null", program, option);
    output = popen(command, "r"); // NOLINT(cert-env33-c): the path is our own
    line[0] = '\0';
    if (!output)
        return -1;
    while (fgets(read, sizeof read, output)) {
        read[strcspn(read, "\n")] = '\0';
        snprintf(line, size, "%s", read);
    }
    status = pclose(output);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void check_renderer(struct findings *findings)
{
    char path[PATH_MAX];
    char line[256];

    if (!find_simulator(path, sizeof path)) {
        findings_add(findings, VERDICT_SKIPPED, "EGL renderer",
                     "no reach-simrobot is installed here");
    } else if (last_line(path, "--renderer", line, sizeof line) == 0) {
        findings_add(findings, VERDICT_OK, "EGL renderer", "%s", line);
    } else {
        findings_add(findings, VERDICT_FINDING, "EGL renderer", "%s",
                     *line ? line : "reach-simrobot --renderer ended without a word");
        findings_remedy(findings, "apt-get install libgl1-mesa-dri libegl1");
    }
}

static void check_camera(struct findings *findings, const char *path)
{
    struct v4l2_capability capability = {0};
    int descriptor = open(path, O_RDWR | O_CLOEXEC | O_NONBLOCK);
    int failed = descriptor < 0 || ioctl(descriptor, VIDIOC_QUERYCAP, &capability) < 0 ? errno : 0;

    if (descriptor >= 0)
        close(descriptor);
    if (failed) {
        findings_add(findings, VERDICT_FINDING, "camera", "%s: %s", path, strerror(failed));
        findings_remedy(findings, "usermod -a -G video $USER, and log in again");
    } else if (capability.device_caps & V4L2_CAP_VIDEO_CAPTURE) {
        findings_add(findings, VERDICT_OK, "camera", "%s: %s", path, (const char *)capability.card);
    }
}

static void check_cameras(struct findings *findings)
{
    glob_t devices;

    if (glob("/dev/video*", 0, NULL, &devices)) {
        findings_add(findings, VERDICT_SKIPPED, "camera", "none; the simulator needs none");
        return;
    }
    for (size_t i = 0; i < devices.gl_pathc; i++)
        check_camera(findings, devices.gl_pathv[i]);
    globfree(&devices);
}

static void check_clock(struct findings *findings)
{
    struct timex state = {0};
    bool synchronised = adjtimex(&state) >= 0 && !(state.status & STA_UNSYNC);

    if (bus_utime() >= earliest_us) {
        findings_add(findings, VERDICT_OK, "clock",
                     synchronised ? "synchronised"
                                  : "not synchronised, which matters between machines alone");
        return;
    }
    findings_add(findings, VERDICT_FINDING, "clock", "it is wrong: years behind");
    findings_remedy(findings, "timedatectl set-ntp true");
}

void doctor_system(struct findings *findings)
{
    check_real_time(findings);
    check_memory(findings);
    check_renderer(findings);
    check_cameras(findings);
    check_clock(findings);
}
