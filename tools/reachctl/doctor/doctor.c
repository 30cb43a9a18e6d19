#include "tools/reachctl/doctor/doctor.h"

#include "common/bus/open.h"

#include <string.h>

int doctor_run(const char *given, bool json, char *error, size_t error_size)
{
    static struct findings findings;
    char url[512];

    bus_url(given, url, sizeof url);
    doctor_system(&findings);
    if (strncmp(url, "udpm:", 5) == 0) {
        doctor_network(url, &findings);
        doctor_bus(url, &findings);
    } else {
        findings_add(&findings, VERDICT_SKIPPED, "bus", "%s is not UDP multicast", url);
    }
    (json ? findings_print_json : findings_print)(&findings, stdout);
    if (findings_all_well(&findings))
        return 0;
    snprintf(error, error_size, "there is something to mend");
    return -1;
}
