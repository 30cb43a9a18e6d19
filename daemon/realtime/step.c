#include "daemon/realtime/step.h"

#include "common/base/thread.h"

void step_take_requests(struct step *step)
{
    struct tick_inputs *inputs = &step->inputs;
    struct received_request received;

    inputs->n_requests = 0;
    while (inputs->n_requests < TICK_MAX_REQUESTS &&
           mailbox_take(daemon_bus_requests(step->bus), &received)) {
        inputs->request[inputs->n_requests] = received.request;
        inputs->request_checksum[inputs->n_requests++] = received.checksum;
    }
}

void step_decide(struct step *step, int64_t now)
{
    step->inputs.config = atomic_exchange_explicit(&step->offered, NULL, memory_order_acq_rel);
    if (step->inputs.config)
        step->config = step->inputs.config;
    step->inputs.emergency = daemon_bus_take_emergency(step->bus);
    step->inputs.braked = watchdog_take_braked(step->watchdog);
    tick_decide(step->tick, &step->inputs, now, &step->outputs);
    if (step->outputs.has_command)
        daemon_bus_send_command(step->bus, &step->outputs.command);
    watchdog_feed(step->watchdog, step->outputs.has_command ? &step->outputs.command : NULL);
    if (step->outputs.has_sample)
        daemon_bus_send_sample(step->bus, &step->outputs.sample);
}

void step_report(struct step *step, int64_t now)
{
    reach_status_t *status = &step->outputs.status;
    reach_trace_t *trace = &step->outputs.trace;

    tick_report(step->tick, now, &step->outputs);
    status->compute_us = step->compute.last;
    status->compute_mean_us = duration_histogram_mean(&step->compute);
    status->compute_p999_us = duration_histogram_quantile(&step->compute, 0.999);
    status->compute_max_us = step->compute.max;
    status->wakeup_us = step->wakeup.last;
    status->wakeup_mean_us = duration_histogram_mean(&step->wakeup);
    status->wakeup_p999_us = duration_histogram_quantile(&step->wakeup, 0.999);
    status->wakeup_max_us = step->wakeup.max;
    status->page_faults = thread_page_faults() - step->page_faults;
    status->overruns = step->overruns;
    status->slips = step->slips;
    daemon_bus_refused(step->bus, trace->refused);
    trace->refused[REACH_STATUS_T_CHANNEL_STATE][REACH_STATUS_T_VALUE] = step->bad_states;
    refusals_into_status(trace->refused, status);
    daemon_bus_send_report(step->bus, status, trace);
    atomic_fetch_add_explicit(&step->ticks, 1, memory_order_relaxed);
}
