#include "simrobot/eyes/tasks.h"

#include <time.h>

#include <algorithm>
#include <cstdio>

#include "common/bus/open.h"
#include "common/logs/event_log.h"
#include "simrobot/eyes/bystander.h"
#include "simrobot/eyes/image_message.h"
#include "simrobot/eyes/renderer.h"
#include "simrobot/eyes/sensor.h"

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

int64_t cpu_us()
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<int64_t>(now.tv_sec) * 1000000 + now.tv_nsec / 1000;
}

/* Time of one part: by the clock, and of all processors together, which other programs on the
 * machine do not lengthen. */
struct Stopwatch {
    const char *part;
    int64_t wall = 0, longest = 0, cpu = 0;
    int64_t wall_start = 0, cpu_start = 0;

    void start()
    {
        wall_start = bus_monotonic_us();
        cpu_start = cpu_us();
    }

    void stop()
    {
        int64_t took = bus_monotonic_us() - wall_start;
        wall += took;
        longest = std::max(longest, took);
        cpu += cpu_us() - cpu_start;
    }

    void print(int64_t count) const
    {
        double scale = 1e-3 / static_cast<double>(count);
        printf("%-28s %8.2f %8.2f %8.2f\n", part, static_cast<double>(wall) * scale,
               static_cast<double>(longest) * 1e-3, static_cast<double>(cpu) * scale);
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
    if (event_log_begins(path.c_str())) {
        *error = path + ": is a log, and is not overwritten";
        return false;
    }
    Snapshot snapshot = simulation.snapshot(1);
    if (!simulation.rig().has_eyes)
        Bystander(config.height / (2 * config.focal_length)).look_on(&snapshot);
    renderer->draw(snapshot, &pixels);
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
    Stopwatch physics = {"physics, 33 steps"}, draw = {"two eyes drawn, read back"},
              noise = {"sensor noise"}, encode = {"encoded"};
    StereoPixels pixels;
    size_t bytes = 0;

    if (!encoder)
        return false;
    /* The first picture includes the driver's compiling of the shaders. */
    renderer->draw(simulation.snapshot(0), &pixels);
    for (int64_t i = 1; i <= count && error->empty(); i++) {
        physics.start();
        for (int step = 0; step < 33; step++)
            simulation.step();
        physics.stop();
        draw.start();
        renderer->draw(simulation.snapshot(i), &pixels);
        draw.stop();
        noise.start();
        sensor.expose(i, &pixels);
        noise.stop();
        encode.start();
        bytes += encoder->encode(i, pixels, error).size();
        encode.stop();
    }
    printf("%lld pairs by %s, mean message %zu kB\n", static_cast<long long>(count),
           renderer->name().c_str(), bytes / static_cast<size_t>(count) / 1000);
    printf("%-28s %8s %8s %8s\n", "a pair", "mean ms", "max ms", "CPU ms");
    for (const Stopwatch &watch : {physics, draw, noise, encode})
        watch.print(count);
    return error->empty();
}

} // namespace sim
