/* What outliers are measured by, in logarithms: densities far from all experts underflow, and their
 * ratios still matter. */
#include "common/base/elementary.h"
#include "learner/imle/imle.h"

double imle_log_outlier_input(const struct imle *m)
{
    double value = m->log_c_input;

    for (int i = 0; i < m->d; i++)
        value -= 0.5 * elementary_log(m->sigma_bar[i]);
    return value;
}

double imle_log_outlier_joint(const struct imle *m)
{
    double value = imle_log_outlier_input(m) - m->log_c_input + m->log_c_joint;

    for (int i = 0; i < m->D; i++)
        value -= 0.5 * elementary_log(m->psi_bar[i]);
    return value;
}
