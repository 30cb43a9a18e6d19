/* hard-pictures: draws the set, lets every chain find the ball, counts. */
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "common/options/command_line.h"
#include "common/program/log.h"
#include "tools/measure/json.h"
#include "tools/pictures/chains.h"

namespace
{
struct arguments {
    const char *json = nullptr;
    const char *draw = nullptr;
    const char *row = nullptr;
    int count = 40;
    bool quiet = false;
};

struct chain {
    const char *name;
    finding (*find)(const hard_picture &);
};

/* What became of one chain in one row. */
struct outcome {
    int found = 0;
    int missed = 0;
    int wrong = 0;              /* seen where it is not */
    std::vector<double> errors; /* of the centre, where found; px */
};
} // namespace

static const chain chains[] = {
    {"reach-vision", chain_ours}, {"contour", chain_contour}, {"hough", chain_hough}};

static const argument_row rows[] = {
    ARGUMENT_INT("count", "N", arguments, count, 1, 100000, "pictures in each row, default 40"),
    ARGUMENT_TEXT("row", 0, "NAME", arguments, row, "only this row"),
    ARGUMENT_TEXT("json", 0, "FILE", arguments, json, "the counts, default: standard output"),
    ARGUMENT_TEXT("draw", 0, "DIR", arguments, draw,
                  "an existing folder for the pictures; the names tell truth and finding"),
    ARGUMENT_ON("quiet", 0, arguments, quiet, "no progress"),
    ARGUMENT_END,
};

static const command_line line = {
    "hard-pictures",
    "hard-pictures [--count N] [--row NAME] [--json FILE] [--draw DIR] [--quiet]",
    "Draws hard pictures of a ball, and counts how often reach-vision and two usual chains of\n"
    "OpenCV's functions find it. Wrong: seen further than a tenth of its radius, and 3 px, from\n"
    "where it is, or seen where there is none.",
    rows,
    "0 done, 1 failure",
    nullptr,
    nullptr,
    nullptr};

static const char *judge(const hard_picture &picture, const finding &found, outcome *row)
{
    const double error = std::hypot(found.centre.column - picture.centre.column,
                                    found.centre.row - picture.centre.row);

    if (!found.seen) {
        (picture.has_ball ? row->missed : row->found)++;
        return picture.has_ball ? "missed" : "rightly_none";
    }
    if (!picture.has_ball || error > std::max(3.0, 0.1 * picture.radius)) {
        row->wrong++;
        return "wrong";
    }
    row->found++;
    row->errors.push_back(error);
    return "found";
}

static double quantile(std::vector<double> values, double share)
{
    if (values.empty())
        return std::nan("");
    const auto place =
        values.begin() + static_cast<long>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

static void write(struct json *json, const char *name, const outcome &row)
{
    json_object(json, name);
    json_integer(json, "found", row.found);
    json_integer(json, "missed", row.missed);
    json_integer(json, "wrong", row.wrong);
    json_number(json, "error_median_px", quantile(row.errors, 0.5));
    json_number(json, "error_95_px", quantile(row.errors, 0.95));
    json_end_object(json);
}

static void keep(const arguments &given, int row, int index, const hard_picture &picture,
                 const char *verdict)
{
    char path[512];
    std::string name = picture_rows[row];

    std::replace(name.begin(), name.end(), ' ', '_');
    snprintf(path, sizeof path, "%s/%s_%03d_u%.1f_v%.1f_r%.1f_%s.png", given.draw, name.c_str(),
             index, picture.centre.column, picture.centre.row, picture.radius, verdict);
    if (!cv::imwrite(path, picture.bgr))
        log_warning("%s cannot be written", path);
}

static void run_row(const arguments &given, int row, struct json *json)
{
    outcome outcomes[std::size(chains)];

    for (int i = 0; i < given.count; i++) {
        const hard_picture picture = picture_draw(row, static_cast<uint64_t>(i));
        const char *first = nullptr;
        for (size_t c = 0; c < std::size(chains); c++) {
            const char *verdict = judge(picture, chains[c].find(picture), &outcomes[c]);
            first = c == 0 ? verdict : first;
        }
        if (given.draw)
            keep(given, row, i, picture, first);
        if (!given.quiet)
            fprintf(stderr, "\r%-20s %d of %d ", picture_rows[row], i + 1, given.count);
    }
    if (!given.quiet)
        fprintf(stderr, "\n");
    json_object(json, picture_rows[row]);
    for (size_t c = 0; c < std::size(chains); c++)
        write(json, chains[c].name, outcomes[c]);
    json_end_object(json);
}

int main(int argc, char **argv)
{
    arguments given;
    const int status = command_line_parse(&line, argc, argv, &given);

    if (status >= 0)
        return status;
    log_open("hard-pictures", LOG_LEVEL_INFO);
    FILE *out = given.json ? fopen(given.json, "w") : stdout;
    if (!out) {
        log_error("%s cannot be written", given.json);
        return 1;
    }
    struct json json = {out, 0, {}};
    json_object(&json, nullptr);
    for (int row = 0; picture_rows[row]; row++)
        if (!given.row || std::string(given.row) == picture_rows[row])
            run_row(given, row, &json);
    json_end_object(&json);
    return fclose(out) == 0 ? 0 : 1;
}
