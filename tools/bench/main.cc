// reach-bench: what the learner's calls cost, beside the textbook version and LWPR, in one run.
#include <getopt.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>

#include "common/program/version.h"
#include "tools/bench/cases.h"
#include "tools/bench/measure.h"
#include "tools/measure/json.h"
#include "tools/measure/output_file.h"

namespace
{

constexpr int exit_usage = 2;

const char usage[] =
    "usage: reach-bench --json FILE [--only TEXT] [--calls N]\n"
    "\n"
    "Lets the learner, the textbook version and LWPR learn the same samples and times their calls "
    "on\n"
    "the clock of the thread. docs/performance.md explains the streams and the table.\n"
    "\n"
    "  --json FILE    rows {name, d, D, experts, ours_us, textbook_us, lwpr_us, ratio_p50, ...}\n"
    "  --only TEXT    only cases whose label holds TEXT; labels are like 'linear d=7 M=280'\n"
    "  --calls N      updates and predictions of each case; default 4000\n"
    "  --quiet        no progress\n"
    "  -h, --help     this text\n"
    "  -V, --version  version and git revision\n"
    "exit code: 0 done, 1 the file cannot be written, 2 wrong usage\n";

struct Settings {
    const char *json = nullptr;
    const char *only = "";
    int calls = 4000;
    bool quiet = false;
};

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

void write(const std::vector<Row> &rows, const char *path)
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

int wrong(const std::string &reason)
{
    fprintf(stderr, "reach-bench: %s\n", reason.c_str());
    return exit_usage;
}

int read_calls(const char *text, int *calls)
{
    char *end;
    long number = strtol(text, &end, 10);
    if (end == text || *end || number < 1 || number > 10000000)
        return wrong("--calls: a whole number from 1 to 10000000 is wanted");
    *calls = static_cast<int>(number);
    return 0;
}

// 0 to go on, -1 when everything was said, otherwise the exit code.
int read_command_line(int argc, char **argv, Settings *settings)
{
    static const option options[] = {
        {"json", required_argument, nullptr, 'j'},
        {"only", required_argument, nullptr, 'o'},
        {"calls", required_argument, nullptr, 'c'},
        {"quiet", no_argument, nullptr, 'q'},
        {"help", no_argument, nullptr, 'h'},
        {"version", no_argument, nullptr, 'V'},
        {nullptr, 0, nullptr, 0},
    };
    int result = 0;
    int code;
    argv[0] = program_invocation_short_name;
    while (result == 0 && (code = getopt_long(argc, argv, "hV", options, nullptr)) != -1) {
        if (code == 'j') {
            settings->json = optarg;
        } else if (code == 'o') {
            settings->only = optarg;
        } else if (code == 'c') {
            result = read_calls(optarg, &settings->calls);
        } else if (code == 'q') {
            settings->quiet = true;
        } else if (code == 'h') {
            fputs(usage, stdout);
            result = -1;
        } else if (code == 'V') {
            printf("reach-bench %s\n", reach_version);
            result = -1;
        } else {
            result = exit_usage;
        }
    }
    if (result == 0 && optind < argc)
        return wrong(std::string("unexpected word '") + argv[optind] + "'");
    if (result == 0 && !settings->json)
        return wrong("--json is missing");
    return result;
}

void run(const Settings &settings)
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
    write(rows, settings.json);
}

} // namespace

int main(int argc, char **argv)
{
    Settings settings;
    int result = read_command_line(argc, argv, &settings);
    if (result)
        return result < 0 ? EXIT_SUCCESS : result;
    try {
        run(settings);
    } catch (const std::exception &error) {
        fprintf(stderr, "reach-bench: %s\n", error.what());
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
