// reach-bench: what the learner's calls cost, beside the textbook version and LWPR, in one run.
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "common/options/command_line.h"
#include "tools/bench/cases.h"
#include "tools/bench/measure.h"
#include "tools/measure/json.h"
#include "tools/measure/output_file.h"

namespace
{

struct Settings {
    const char *json = nullptr;
    const char *only = "";
    int calls = 4000;
    bool quiet = false;
};

const argument_row option_rows[] = {
    ARGUMENT_TEXT("json", 0, "FILE", Settings, json,
                  "rows {name, d, D, experts, ours_us, textbook_us, lwpr_us, ratio_p50, ...}"),
    ARGUMENT_TEXT("only", 0, "TEXT", Settings, only,
                  "only cases whose label holds TEXT; labels are like 'linear d=7 M=280'"),
    ARGUMENT_INT("calls", "N", Settings, calls, 1, 10000000,
                 "updates and predictions of each case; default 4000"),
    ARGUMENT_ON("quiet", 0, Settings, quiet, "no progress"),
    ARGUMENT_END,
};

const command_line line = {
    "reach-bench",
    "reach-bench --json FILE [--only TEXT] [--calls N]",
    "Lets the learner, the textbook version and LWPR learn the same samples and times their calls\n"
    "on the clock of the thread. docs/performance.md explains the streams and the table.",
    option_rows,
    "0 done, 1 the file cannot be written",
    nullptr,
    nullptr,
    nullptr};

std::string label(const Case &c)
{
    return c.kind + " d=" + std::to_string(c.d) + " M=" + std::to_string(c.experts);
}

void put_times(json *out, const char *key, const std::optional<durations_summary> &times)
{
    if (!times) {
        json_text(out, key, nullptr);
        return;
    }
    json_object(out, key);
    json_number(out, "p50", times->p50);
    json_number(out, "p99", times->p99);
    json_number(out, "p999", times->p999);
    json_number(out, "max", times->max);
    json_end_object(out);
}

void put_row(json *out, const Row &row)
{
    json_object(out, nullptr);
    json_text(out, "name", row.name.c_str());
    json_number(out, "d", row.d);
    json_number(out, "D", row.D);
    json_number(out, "experts", row.experts);
    put_times(out, "ours_us", row.ours);
    put_times(out, "textbook_us", row.textbook);
    put_times(out, "lwpr_us", row.lwpr);
    json_number(out, "ratio_p50", row.textbook ? row.textbook->p50 / row.ours->p50 : NAN);
    json_number(out, "ratio_p999", row.textbook ? row.textbook->p999 / row.ours->p999 : NAN);
    json_number(out, "calls", static_cast<double>(row.ours->n));
    json_number(out, "textbook_experts", row.textbook ? row.textbook_experts : NAN);
    json_number(out, "lwpr_fields", row.lwpr ? row.lwpr_fields : NAN);
    json_count(out, "bytes", row.bytes);
    json_number(out, "stream_us", row.stream_us);
    json_number(out, "solutions", row.solutions);
    json_number(out, "concerned", row.textbook ? row.concerned : NAN);
    json_end_object(out);
}

void write_report(const std::vector<Row> &rows, const char *path)
{
    char error[1200];
    output_file file;
    if (output_begin(&file, path, error, sizeof error))
        throw std::runtime_error(error);
    json out{file.stream, 0, {}};
    json_array(&out, nullptr);
    for (const Row &row : rows)
        put_row(&out, row);
    json_end_array(&out);
    if (output_commit(&file, error, sizeof error))
        throw std::runtime_error(error);
}

void measure_cases(const Settings &settings)
{
    char error[1200];
    std::vector<Row> rows;
    bool shows = !settings.quiet && isatty(STDERR_FILENO);
    auto progress = [&](const std::string &what) {
        if (shows)
            fprintf(stderr, "\r\033[K%s", what.c_str());
    };
    if (output_check(settings.json, error, sizeof error))
        throw std::runtime_error(error);
    for (const Case &c : all_cases()) {
        if (label(c).find(settings.only) == std::string::npos)
            continue;
        try {
            for (const Row &row : measure(c, settings.calls, progress))
                rows.push_back(row);
        } catch (const std::runtime_error &reason) {
            throw std::runtime_error(label(c) + ": " + reason.what());
        }
    }
    progress("");
    if (rows.empty())
        throw std::runtime_error(std::string("--only: no case holds '") + settings.only + "'");
    write_report(rows, settings.json);
}

} // namespace

int main(int argc, char **argv)
{
    Settings settings;
    int status = command_line_parse(&line, argc, argv, &settings);
    if (status < 0 && !settings.json)
        status = command_line_wrong(&line, "--json is missing");
    if (status >= 0)
        return status;
    try {
        measure_cases(settings);
    } catch (const std::exception &error) {
        fprintf(stderr, "reach-bench: %s\n", error.what());
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
