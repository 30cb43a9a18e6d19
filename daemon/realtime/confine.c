#include "daemon/realtime/confine.h"

#include <errno.h>
#include <linux/audit.h>
#include <linux/filter.h>
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

/* The list. */
static const int allowed[] = {
    SYS_clock_nanosleep, /* the grid of real time */
    SYS_clock_gettime,   /* where the machine's clock cannot be read without a call */
    SYS_futex,           /* a post to the sending thread; lockstep: waiting for a message */
    SYS_getrusage,       /* page faults, for the status */
    SYS_restart_syscall, /* what waited when the process was stopped and continued */
    SYS_rt_sigreturn,    /* the end of a signal handler, of a debugger's for instance */
    SYS_rt_sigprocmask,  /* the end of the thread, with the two below */
    SYS_madvise,         SYS_exit,
};

#define N_ALLOWED (sizeof allowed / sizeof allowed[0])
#define HEAD 4 /* instructions before the list */

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

/* Loads the number of the call, compares it with each that is allowed. */
static int install_filter(void)
{
    struct sock_filter program[HEAD + N_ALLOWED + 2] = {
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, arch)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, THIS_MACHINE, 1, 0),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, nr)),
    };
    struct sock_fprog filter = {.len = sizeof program / sizeof program[0], .filter = program};

    for (size_t i = 0; i < N_ALLOWED; i++)
        program[HEAD + i] = (struct sock_filter)BPF_JUMP(
            BPF_JMP | BPF_JEQ | BPF_K, (uint32_t)allowed[i], (uint8_t)(N_ALLOWED - i), 0);
    program[HEAD + N_ALLOWED] = (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP);
    program[HEAD + N_ALLOWED + 1] =
        (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
    return (int)syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, 0, &filter);
}

int confine_thread(char *error, size_t error_size)
{
    struct sigaction action = {.sa_sigaction = on_forbidden, .sa_flags = SA_SIGINFO};

    if (SANITIZED)
        return 0;
    sigfillset(&action.sa_mask);
    if (sigaction(SIGSYS, &action, NULL) == 0 && prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
        install_filter() == 0)
        return 0;
    snprintf(error, error_size,
             "cannot confine the loop's system calls: %s; a kernel with seccomp is wanted",
             strerror(errno));
    return -1;
}
