#include "reachd_process.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#define MOST_ARGUMENTS 64

/* In the child. */
static void execute(const struct reachd_process *process, const char *further)
{
    const char *arguments[MOST_ARGUMENTS] = {process->program};
    int n = 1;
    int log = open(process->log, O_WRONLY | O_CREAT | O_APPEND, 0644);

    for (int i = 0; process->options[i] && n < MOST_ARGUMENTS - 2; i++)
        arguments[n++] = process->options[i];
    arguments[n] = further;
    dup2(log, STDERR_FILENO);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    execv(process->program, (char *const *)(uintptr_t)arguments);
    perror(process->program);
    _exit(127);
}

void reachd_process_start(struct reachd_process *process)
{
    process->pid = fork();
    if (process->pid == 0)
        execute(process, "--lockstep");
}

int reachd_process_end(struct reachd_process *process, int signal)
{
    int status = 0;

    kill(process->pid, signal);
    waitpid(process->pid, &status, 0);
    return status;
}

bool reachd_process_ended(const struct reachd_process *process)
{
    siginfo_t info = {0};

    return waitid(P_PID, (id_t)process->pid, &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           info.si_pid == process->pid;
}

bool reachd_process_check(const struct reachd_process *process, uint64_t *samples, uint64_t *hash)
{
    unsigned long long number = 0, sum = 0;
    char line[1000] = "";
    int ends[2];
    int status = 0;
    FILE *out;
    pid_t pid;

    if (pipe(ends))
        return false;
    pid = fork();
    if (pid == 0) {
        dup2(ends[1], STDOUT_FILENO);
        execute(process, "--check-model");
    }
    close(ends[1]);
    out = fdopen(ends[0], "r");
    if (!fgets(line, sizeof line, out))
        line[0] = '\0';
    fclose(out);
    waitpid(pid, &status, 0);
    if (sscanf(line, "%*[^:]: a model of %llu samples, hash %llx", &number, &sum) != 2 &&
        status == 0 && !strstr(line, ": no model yet"))
        fprintf(stderr, "check: %s", line);
    *samples = number;
    *hash = sum;
    return status == 0;
}
