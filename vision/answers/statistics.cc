#include "vision/answers/statistics.h"

#include <cinttypes>
#include <cstring>
#include <ctime>

static const size_t longest = 20000; /* us */

time_histogram::time_histogram() : count(longest + 1) {}

void time_histogram_add(time_histogram *times, double us)
{
    const size_t bin = us > 0 ? static_cast<size_t>(us) : 0;

    times->count[bin < longest ? bin : longest]++;
    if (us > times->largest)
        times->largest = us;
}

double time_histogram_quantile(const time_histogram &times, double share)
{
    uint64_t total = 0;
    uint64_t below = 0;

    for (uint32_t n : times.count)
        total += n;
    for (size_t bin = 0; bin < longest; bin++) {
        below += times.count[bin];
        if (total > 0 && static_cast<double>(below) >= share * static_cast<double>(total))
            return static_cast<double>(bin + 1) < times.largest ? static_cast<double>(bin + 1)
                                                                : times.largest;
    }
    return times.largest;
}

void statistics_line(const statistics &counts, char *line, size_t size)
{
    snprintf(line, size,
             "%" PRId64 " pairs, %" PRId64 " seen, %" PRId64 " by windows, %" PRId64
             " repeated, %" PRId64 " dropped, %" PRId64 " unusable, %" PRId64
             " malformed; looking took %.0f us at the median, %.0f at 99.9 %%, %.0f at most",
             counts.pairs, counts.reasons[0], counts.windows, counts.repeated, counts.dropped,
             counts.reasons[STEREO_UNUSABLE], counts.malformed,
             time_histogram_quantile(counts.look, 0.5), time_histogram_quantile(counts.look, 0.999),
             counts.look.largest);
}

static void append(char *line, size_t size, const char *what, int64_t n)
{
    const size_t used = strlen(line);

    if (n > 0)
        snprintf(line + used, size - used, "%s%s: %" PRId64, used ? ", " : "", what, n);
}

void statistics_unseen(const statistics &counts, char *line, size_t size)
{
    line[0] = 0;
    append(line, size, "nothing of the ball's colour", counts.no_colour);
    for (int i = 1; i < BLOB_FAULTS; i++)
        append(line, size, blob_fault_text(static_cast<blob_fault>(i)), counts.faults[i]);
    for (int i = STEREO_HEIGHTS_DIFFER; i < STEREO_REASONS; i++)
        append(line, size, stereo_reason_text(static_cast<stereo_reason>(i)), counts.reasons[i]);
}

bool statistics_nothing_usable(const statistics &counts)
{
    return counts.pairs + counts.malformed > 0 && counts.pairs == counts.reasons[STEREO_UNUSABLE];
}

static void times_json(const char *name, const time_histogram &times, FILE *out)
{
    fprintf(out, "\"%s\": {\"p50\": %.1f, \"p999\": %.1f, \"max\": %.1f}", name,
            time_histogram_quantile(times, 0.5), time_histogram_quantile(times, 0.999),
            times.largest);
}

void statistics_json(const statistics &counts, FILE *out)
{
    fprintf(out,
            "{\"pairs\": %" PRId64 ", \"windows\": %" PRId64 ", \"repeated\": %" PRId64
            ", \"dropped\": %" PRId64 ", \"malformed\": %" PRId64 ", \"reasons\": [",
            counts.pairs, counts.windows, counts.repeated, counts.dropped, counts.malformed);
    for (int i = 0; i < STEREO_REASONS; i++)
        fprintf(out, "%s%" PRId64, i ? ", " : "", counts.reasons[i]);
    fprintf(out, "], ");
    times_json("look_us", counts.look, out);
    fprintf(out, ", ");
    times_json("decode_us", counts.decode, out);
    fprintf(out, "}\n");
}

double statistics_thread_us()
{
    timespec now;

    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e6 + static_cast<double>(now.tv_nsec) * 1e-3;
}
