#include "daemon/realtime/confine.h"

#include <errno.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/futex.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#if defined(__x86_64__)
#define THIS_MACHINE AUDIT_ARCH_X86_64
#elif defined(__aarch64__)
#define THIS_MACHINE AUDIT_ARCH_AARCH64
#else
#error "name this processor's AUDIT_ARCH_* here"
#endif

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SANITIZED 1
#else
#define SANITIZED 0
#endif

/* The list; of futexes install_filter says more. */
static const int allowed[] = {
    SYS_clock_nanosleep, /* the grid of real time */
    SYS_clock_gettime,   /* where the machine's clock cannot be read without a call */
    SYS_getrusage,       /* page faults, for the status */
    SYS_restart_syscall, /* what waited when the process was stopped and continued */
    SYS_rt_sigreturn,    /* the end of a signal handler, of a debugger's for instance */
    SYS_rt_sigprocmask,  /* the end of the thread, with the two below */
    SYS_madvise,         SYS_exit,
};

#define N_ALLOWED (sizeof allowed / sizeof allowed[0])
/* Of the filter's instructions: how many stand before the list, which tells futexes apart. */
enum { HEAD = 10, AT_FUTEX = 5 };

static _Atomic int violation = -1;

int confine_violation(void)
{
    return atomic_load_explicit(&violation, memory_order_acquire);
}

/* In the thread that made the call, which did not happen. It may sleep, and nothing else. */
static void on_forbidden(int signal, siginfo_t *info, void *context)
{
    const struct timespec hour = {.tv_sec = 3600};

    (void)signal, (void)context;
    atomic_store_explicit(&violation, info->si_syscall, memory_order_release);
    for (;;)
        clock_nanosleep(CLOCK_MONOTONIC, 0, &hour, NULL);
}

#define STATEMENT(code, value) BPF_STMT((code), (uint32_t)(value))
#define JUMP(value, yes, no)                                                                       \
    BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, (uint32_t)(value), (uint8_t)(yes), (uint8_t)(no))
#define LOAD(field) STATEMENT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, field))
#define FORBID STATEMENT(BPF_RET | BPF_K, SECCOMP_RET_TRAP)
#define ALLOW STATEMENT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)

/* A futex wakes others (sem_post), or waits: for a message, or for a lock. The low half of its
 * second argument says which; both processors here are little-endian. The rest of the list is
 * compared with the call one by one. */
static int install_filter(bool waits)
{
    struct sock_filter program[HEAD + N_ALLOWED + 2] = {
        LOAD(arch),
        JUMP(THIS_MACHINE, 1, 0),
        FORBID,
        LOAD(nr),
        JUMP(SYS_futex, 0, 5),
        LOAD(args[1]),
        STATEMENT(BPF_ALU | BPF_AND | BPF_K, FUTEX_CMD_MASK),
        JUMP(FUTEX_WAKE, 0, 1),
        ALLOW,
        FORBID,
    };
    struct sock_fprog filter = {.len = sizeof program / sizeof program[0], .filter = program};

    if (waits)
        program[AT_FUTEX] = (struct sock_filter)ALLOW;
    for (size_t i = 0; i < N_ALLOWED; i++)
        program[HEAD + i] = (struct sock_filter)JUMP(allowed[i], N_ALLOWED - i, 0);
    program[HEAD + N_ALLOWED] = (struct sock_filter)FORBID;
    program[HEAD + N_ALLOWED + 1] = (struct sock_filter)ALLOW;
    return (int)syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, 0, &filter);
}

int confine_thread(bool waits, char *error, size_t error_size)
{
    struct sigaction action = {.sa_sigaction = on_forbidden, .sa_flags = SA_SIGINFO};

    if (SANITIZED)
        return 0;
    sigfillset(&action.sa_mask);
    if (sigaction(SIGSYS, &action, NULL) == 0 && prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
        install_filter(waits) == 0)
        return 0;
    snprintf(error, error_size,
             "cannot confine the loop's system calls: %s; a kernel with seccomp is wanted",
             strerror(errno));
    return -1;
}
