#include "simrobot/eye_tasks.h"

#include <cstdio>

#include "common/bus.h"
#include "simrobot/image_message.h"
#include "simrobot/renderer.h"
#include "simrobot/sensor.h"

namespace sim
{
namespace
{

bool write_ppm(const std::string &path, int width, int height, const StereoPixels &pixels)
{
    FILE *file = fopen(path.c_str(), "wb");
    bool good = file && fprintf(file, "P6\n%d %d\n255\n", width, height) > 0;

    for (size_t i = 0; good && i < pixels.size(); i += 4)
        good = fwrite(&pixels[i], 1, 3, file) == 3;
    if (file && fclose(file) != 0)
        good = false;
    return good;
}

/* Sums of one part's time. */
struct Stopwatch {
    const char *part;
    int64_t sum, longest;

    void add(int64_t from)
    {
        int64_t took = bus_monotonic_us() - from;
        sum += took;
        longest = took > longest ? took : longest;
    }

    void print(int64_t count) const
    {
        printf("%-28s %8.2f %8.2f\n", part,
               static_cast<double>(sum) / static_cast<double>(count) / 1e3,
               static_cast<double>(longest) / 1e3);
    }
};

} // namespace

bool eye_task_snapshot(const Config &config, const Simulation &simulation, uint64_t seed,
                       const std::string &path, std::string *error)
{
    std::unique_ptr<Renderer> renderer = Renderer::create(config, error);
    StereoPixels pixels;

    if (!renderer)
        return false;
    renderer->draw(simulation.snapshot(1), &pixels);
    Sensor(config.sensor_noise, seed).expose(1, &pixels);
    if (write_ppm(path, 2 * config.width, config.height, pixels))
        return true;
    *error = path + ": cannot be written";
    return false;
}

bool eye_task_bench(const Config &config, Simulation &simulation, uint64_t seed, int64_t count,
                    std::string *error)
{
    std::unique_ptr<Renderer> renderer = Renderer::create(config, error);
    std::unique_ptr<ImageMessage> encoder =
        renderer ? ImageMessage::create(config, error) : nullptr;
    Sensor sensor(config.sensor_noise, seed);
    Stopwatch physics = {"physics, 33 steps", 0, 0}, draw = {"two eyes drawn, read back", 0, 0},
              noise = {"sensor noise", 0, 0}, encode = {"encoded", 0, 0};
    StereoPixels pixels;
    size_t bytes = 0;

    if (!encoder)
        return false;
    for (int64_t i = 1; i <= count && error->empty(); i++) {
        int64_t start = bus_monotonic_us();
        for (int step = 0; step < 33; step++)
            simulation.step();
        physics.add(start);
        start = bus_monotonic_us();
        renderer->draw(simulation.snapshot(i), &pixels);
        draw.add(start);
        start = bus_monotonic_us();
        sensor.expose(i, &pixels);
        noise.add(start);
        start = bus_monotonic_us();
        bytes += encoder->encode(i, pixels, error).size();
        encode.add(start);
    }
    printf("%lld pairs by %s, mean message %zu kB\n%-28s %8s %8s\n", static_cast<long long>(count),
           renderer->name().c_str(), bytes / static_cast<size_t>(count) / 1000, "a pair", "mean ms",
           "max ms");
    for (const Stopwatch &watch : {physics, draw, noise, encode})
        watch.print(count);
    return error->empty();
}

} // namespace sim
