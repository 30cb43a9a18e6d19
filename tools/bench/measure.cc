#include "tools/bench/measure.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "tools/bench/arm.h"
#include "tools/bench/rival.h"
#ifdef REACH_BENCH_TICK
#include "tools/bench/tick.h"
#endif

namespace
{

constexpr int D = ARM_OUTPUTS;
constexpr int calls_in_turn = 50; // of one rival, so that each finds its own caches warm

struct Contestant {
    std::unique_ptr<Rival> rival;
    durations update{}, predict{};
    double solutions = 0, concerned = 0;

    explicit Contestant(std::unique_ptr<Rival> r) : rival(std::move(r)) {}
    Contestant(const Contestant &) = delete;
    Contestant &operator=(const Contestant &) = delete;
    ~Contestant()
    {
        durations_free(&update);
        durations_free(&predict);
    }
};

struct Field {
    std::unique_ptr<Contestant> ours, textbook, lwpr; // the last two may be missing

    std::vector<Contestant *> all() const
    {
        std::vector<Contestant *> list;
        for (Contestant *c : {ours.get(), textbook.get(), lwpr.get()})
            if (c)
                list.push_back(c);
        return list;
    }
};

// With its published parameters; it decides itself how many fields the stream needs.
learner_config lwpr_config(const Case &c)
{
    learner_config config = learner_config_default(c.d, D);
    config.kind = LEARNER_LWPR;
    config.capacity = 8192;
    return config;
}

Field enter(const Case &c)
{
    Field field;
    field.ours = std::make_unique<Contestant>(make_learner(c.config));
    if (c.config.features == LEARNER_LINEAR) {
        field.textbook = std::make_unique<Contestant>(make_textbook(c.config));
        field.lwpr = std::make_unique<Contestant>(make_learner(lwpr_config(c)));
    }
    return field;
}

// Samples as they were learned, row after row.
struct Samples {
    size_t d;
    std::vector<double> z, x;

    size_t size() const
    {
        return x.size() / D;
    }
    const double *input(size_t i) const
    {
        return &z[i * d];
    }
    const double *output(size_t i) const
    {
        return &x[i * D];
    }
};

int tool_at(const Case &c, int sample)
{
    static const int sequence[] = {0, 1, 0, 2};
    int phase = sample / c.samples_per_tool;
    return c.tools == 0 ? phase : std::min(sequence[phase % 4], c.tools - 1);
}

Samples learn(const Case &c, arm_stream &stream, const Field &field)
{
    Samples samples{size_t(c.d), {}, {}};
    double z[ARM_JOINTS], x[D];
    for (int n = 0; n < c.most_samples && field.ours->rival->experts() < c.experts; n++) {
        arm_stream_take_tool(&stream, tool_at(c, n));
        arm_stream_next(&stream, z, x);
        for (Contestant *contestant : field.all())
            contestant->rival->update(z, x);
        samples.z.insert(samples.z.end(), z, z + c.d);
        samples.x.insert(samples.x.end(), x, x + D);
    }
    if (field.ours->rival->experts() < c.experts)
        throw std::runtime_error("only " + std::to_string(field.ours->rival->experts()) +
                                 " experts after " + std::to_string(c.most_samples) + " samples");
    return samples;
}

// The latest samples come once more: known, so that the number of experts stays.
void time_updates(Contestant &contestant, const Samples &samples, size_t first, int n)
{
    for (int i = 0; i < n; i++) {
        size_t row = (first + size_t(i)) % samples.size();
        int64_t start = durations_clock();
        contestant.rival->update(samples.input(row), samples.output(row));
        durations_add(&contestant.update, start);
        contestant.concerned += contestant.rival->concerned();
    }
}

void time_predictions(Contestant &contestant, const Samples &queries)
{
    for (size_t i = 0; i * queries.d < queries.z.size(); i++) {
        int64_t start = durations_clock();
        int n = contestant.rival->predict(queries.input(i));
        durations_add(&contestant.predict, start);
        contestant.solutions += n;
    }
}

Samples draw_queries(const Case &c, arm_stream &stream, int n)
{
    Samples queries{size_t(c.d), {}, {}};
    double z[ARM_JOINTS];
    for (int i = 0; i < n; i++) {
        arm_stream_query(&stream, z);
        queries.z.insert(queries.z.end(), z, z + c.d);
    }
    return queries;
}

void take_turns(const Case &c, int calls, arm_stream &stream, const Samples &samples,
                const Field &field)
{
    size_t start = samples.size() > size_t(calls) ? samples.size() - size_t(calls) : 0;
    for (int done = 0; done < calls; done += calls_in_turn) {
        int n = std::min(calls_in_turn, calls - done);
        Samples queries = draw_queries(c, stream, n);
        for (Contestant *contestant : field.all()) {
            time_updates(*contestant, samples, start + size_t(done), n);
            time_predictions(*contestant, queries);
        }
    }
}

// Median time of reading a block once, as fast as a plain loop does.
double time_to_stream(size_t bytes)
{
    std::vector<double> block(bytes / sizeof(double), 1.0);
    durations times{};
    volatile double sink = 0;
    for (int i = 0; i < 200; i++) {
        double sums[8] = {};
        int64_t start = durations_clock();
        for (size_t k = 0; k + 8 <= block.size(); k += 8)
            for (size_t lane = 0; lane < 8; lane++)
                sums[lane] += block[k + lane];
        durations_add(&times, start);
        for (double sum : sums)
            sink = sink + sum;
    }
    double median = durations_summarise(&times).p50;
    durations_free(&times);
    return median;
}

size_t bytes_at(const Case &c, int experts)
{
    learner_config config = c.config;
    config.capacity = experts;
    return learner_memory(&config);
}

Row make_row(const Case &c, const char *call, int calls, const Field &field)
{
    bool update = strcmp(call, "update") == 0;
    auto summary = [&](Contestant *contestant) -> std::optional<durations_summary> {
        if (!contestant)
            return std::nullopt;
        return durations_summarise(update ? &contestant->update : &contestant->predict);
    };
    Row row{};
    row.name = c.kind == "linear" ? call : std::string(call) + " " + c.kind;
    row.d = c.d;
    row.D = D;
    row.experts = c.experts;
    row.ours = summary(field.ours.get());
    row.textbook = summary(field.textbook.get());
    row.lwpr = summary(field.lwpr.get());
    row.textbook_experts = field.textbook ? field.textbook->rival->experts() : 0;
    row.lwpr_fields = field.lwpr ? field.lwpr->rival->experts() : 0;
    row.bytes = bytes_at(c, c.experts);
    row.solutions = field.ours->solutions / calls;
    row.concerned = field.textbook ? field.textbook->concerned / calls : 0;
    return row;
}

#ifdef REACH_BENCH_TICK
std::vector<Row> measure_tick(const Case &c, int calls)
{
    char error[512];
    durations times{};
    Row row{};
    if (tick_bench(c.experts, calls, &times, error, sizeof error)) {
        durations_free(&times);
        throw std::runtime_error(error);
    }
    row.name = "tick";
    row.d = c.d;
    row.D = D;
    row.experts = c.experts;
    row.ours = durations_summarise(&times);
    row.bytes = bytes_at(c, c.experts);
    row.stream_us = time_to_stream(row.bytes);
    row.solutions = NAN;
    durations_free(&times);
    return {row};
}
#endif

} // namespace

std::vector<Row> measure(const Case &c, int calls,
                         const std::function<void(const std::string &)> &progress)
{
    std::string what =
        std::to_string(c.experts) + " " + c.kind + " experts, d = " + std::to_string(c.d);
#ifdef REACH_BENCH_TICK
    if (c.kind == "tick") {
        progress(what);
        return measure_tick(c, calls);
    }
#endif
    Field field = enter(c);
    arm_stream stream = arm_stream_start(1, c.d, c.speed);
    progress(what + ": learning");
    Samples samples = learn(c, stream, field);
    progress(what + ": measuring");
    take_turns(c, calls, stream, samples, field);
    std::vector<Row> rows = {make_row(c, "update", calls, field),
                             make_row(c, "predict", calls, field)};
    for (Row &row : rows)
        row.stream_us = time_to_stream(row.bytes);
    return rows;
}
