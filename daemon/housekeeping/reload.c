#include "daemon/housekeeping/reload.h"

#include "common/program/log.h"
#include "daemon/config/load.h"
#include "daemon/config/reloadable.h"

/* A buffer that the loop neither works with nor is offered. */
static struct config *free_buffer(struct reload *reload, struct loop *loop)
{
    if (!reload->used)
        reload->used = reload->accepted;
    /* An offer that was not taken is taken back: the loop stands, and works with what it had. */
    if (!loop_offer_config(loop, NULL))
        reload->used = reload->accepted;
    return &reload->buffer[reload->used == &reload->buffer[0]];
}

void reload_configuration(struct reload *reload, struct daemon_bus *bus, struct loop *loop)
{
    struct config *taken;
    char error[512];
    int changes;

    if (config_load_again(&reload->read, reload->accepted, reload->paths, reload->n_paths,
                          reload->overrides, reload->n_overrides, error, sizeof error) ||
        !config_reloadable(reload->accepted, &reload->read, &changes, error, sizeof error)) {
        log_error("the configuration stays as it is: %s", error);
        return;
    }
    log_info("the configuration was read again, %d options differ", changes);
    if (changes == 0)
        return;
    taken = free_buffer(reload, loop);
    *taken = reload->read;
    reload->accepted = taken;
    daemon_bus_send_config(bus, taken);
    loop_offer_config(loop, taken);
}
