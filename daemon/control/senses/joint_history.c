#include "daemon/control/senses/joint_history.h"

#include <string.h>

void history_init(struct history *history, int n_joints)
{
    memset(history, 0, sizeof *history);
    history->n_joints = n_joints;
}

void history_push(struct history *history, int64_t utime, const double *q)
{
    history->newest = (history->newest + 1) % HISTORY_LENGTH;
    history->utime[history->newest] = utime;
    memcpy(history->q[history->newest], q, sizeof(double) * (size_t)history->n_joints);
    if (history->count < HISTORY_LENGTH)
        history->count++;
}

/* Index of the entry `age` places before the newest. */
static int entry(const struct history *history, int age)
{
    return (history->newest - age + HISTORY_LENGTH) % HISTORY_LENGTH;
}

bool history_at(const struct history *history, int64_t utime, double *q)
{
    for (int age = 0; age < history->count; age++) {
        int before = entry(history, age);
        int after = age > 0 ? entry(history, age - 1) : before;
        double share;

        if (history->utime[before] > utime)
            continue;
        if (age == 0 && history->utime[before] != utime)
            return false;
        share = after == before ? 0.0
                                : (double)(utime - history->utime[before]) /
                                      (double)(history->utime[after] - history->utime[before]);
        for (int i = 0; i < history->n_joints; i++)
            q[i] = history->q[before][i] + share * (history->q[after][i] - history->q[before][i]);
        return true;
    }
    return false;
}
