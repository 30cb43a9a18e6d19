/* Cameras for machines that have none. Preloaded, it answers open and ioctl for the devices
 * /dev/stand-in-NAME as a V4L2 driver would; everything else goes to the C library.
 *
 * $REACH_STAND_IN names a folder with NAME.jpg, which each picture of that camera is. The camera
 * has one size, $REACH_STAND_IN_SIZE (default 640x480), one format, $REACH_STAND_IN_FORMAT (default
 * MJPG), and at most $REACH_STAND_IN_RATE pictures a second (default 30); it is unplugged after
 * $REACH_STAND_IN_FRAMES of them (default 20). White balance and exposure are automatic. What was
 * asked of it last is written to NAME.asked. */
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/videodev2.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

static const char prefix[] = "/dev/stand-in-";
enum { CAMERAS = 8, BUFFERS = 4, BUFFER_SIZE = 1 << 21 };

struct stand_in {
    bool used;
    int fd; /* of a file in memory: mmap and select take it as it is */
    char name[32];
    int queued[BUFFERS], n_queued;
    int frames;
    unsigned asked_width, asked_height, asked_format, rate;
};
static struct stand_in cameras[CAMERAS];

static const char *setting(const char *name, const char *usual)
{
    const char *value = getenv(name);

    return value ? value : usual;
}

static unsigned number(const char *name, const char *usual)
{
    return (unsigned)strtoul(setting(name, usual), NULL, 10);
}

static struct stand_in *camera_of(int fd)
{
    for (int i = 0; i < CAMERAS; i++)
        if (cameras[i].used && cameras[i].fd == fd)
            return &cameras[i];
    return NULL;
}

static int open_camera(const char *path)
{
    for (int i = 0; i < CAMERAS; i++) {
        struct stand_in *camera = &cameras[i];
        if (camera->used)
            continue;
        memset(camera, 0, sizeof *camera);
        camera->fd = memfd_create("camera", 0);
        if (camera->fd < 0 || ftruncate(camera->fd, (off_t)BUFFERS * BUFFER_SIZE) < 0)
            return -1;
        snprintf(camera->name, sizeof camera->name, "%s", path + sizeof prefix - 1);
        camera->rate = number("REACH_STAND_IN_RATE", "30");
        camera->used = true;
        return camera->fd;
    }
    errno = EMFILE;
    return -1;
}

static void size_of(unsigned *width, unsigned *height)
{
    if (sscanf(setting("REACH_STAND_IN_SIZE", "640x480"), "%ux%u", width, height) != 2)
        *width = *height = 0;
}

static unsigned format_of(void)
{
    const char *name = setting("REACH_STAND_IN_FORMAT", "MJPG");

    return v4l2_fourcc(name[0], name[1], name[2], name[3]);
}

/* As drivers do: takes what is asked for to what it has. */
static int set_format(struct stand_in *camera, struct v4l2_format *format)
{
    struct v4l2_pix_format *pixels = &format->fmt.pix;

    camera->asked_width = pixels->width;
    camera->asked_height = pixels->height;
    camera->asked_format = pixels->pixelformat;
    size_of(&pixels->width, &pixels->height);
    pixels->pixelformat = format_of();
    pixels->field = V4L2_FIELD_NONE;
    pixels->bytesperline = pixels->pixelformat == V4L2_PIX_FMT_MJPEG ? 0 : 2 * pixels->width;
    pixels->sizeimage = BUFFER_SIZE;
    return 0;
}

static int get_format(struct v4l2_format *format)
{
    struct stand_in nobody;

    return set_format(&nobody, format);
}

static int set_rate(struct stand_in *camera, struct v4l2_streamparm *stream)
{
    struct v4l2_fract *period = &stream->parm.capture.timeperframe;
    const unsigned most = number("REACH_STAND_IN_RATE", "30");

    if (period->numerator > 0)
        camera->rate = period->denominator / period->numerator;
    if (camera->rate == 0 || camera->rate > most)
        camera->rate = most;
    stream->parm.capture.capability = V4L2_CAP_TIMEPERFRAME;
    period->numerator = 1;
    period->denominator = camera->rate;
    return 0;
}

static int get_rate(const struct stand_in *camera, struct v4l2_streamparm *stream)
{
    stream->parm.capture.capability = V4L2_CAP_TIMEPERFRAME;
    stream->parm.capture.timeperframe.numerator = 1;
    stream->parm.capture.timeperframe.denominator = camera->rate;
    return 0;
}

static int describe_buffer(struct v4l2_buffer *buffer)
{
    buffer->length = BUFFER_SIZE;
    buffer->m.offset = buffer->index * BUFFER_SIZE;
    return 0;
}

static void write_down(const struct stand_in *camera)
{
    char path[512];

    snprintf(path, sizeof path, "%s/%s.asked", setting("REACH_STAND_IN", "."), camera->name);
    FILE *out = fopen(path, "w");
    if (!out)
        return;
    fprintf(out, "%ux%u %.4s %u\n", camera->asked_width, camera->asked_height,
            (const char *)&camera->asked_format, camera->rate);
    fclose(out);
}

/* The next picture into the buffer that waits longest, when it is due. */
static int take_picture(struct stand_in *camera, struct v4l2_buffer *buffer)
{
    const struct timespec period = {0, 1000000000L / (long)camera->rate};
    char path[512];
    char picture[BUFFER_SIZE / 4];

    if (camera->n_queued == 0) {
        errno = EAGAIN;
        return -1;
    }
    if (camera->frames++ >= (int)number("REACH_STAND_IN_FRAMES", "20")) {
        errno = ENODEV;
        return -1;
    }
    nanosleep(&period, NULL);
    snprintf(path, sizeof path, "%s/%s.jpg", setting("REACH_STAND_IN", "."), camera->name);
    FILE *in = fopen(path, "rb");
    const size_t size = in ? fread(picture, 1, sizeof picture, in) : 0;
    if (in)
        fclose(in);
    buffer->index = (unsigned)camera->queued[0];
    memmove(camera->queued, camera->queued + 1, sizeof camera->queued - sizeof camera->queued[0]);
    camera->n_queued--;
    describe_buffer(buffer);
    /* Uncompressed formats show nothing: as many bytes as they must have, all 0. */
    buffer->bytesused = format_of() == V4L2_PIX_FMT_MJPEG ? (unsigned)size : 2 * 640 * 480;
    if (pwrite(camera->fd, picture, size, (off_t)buffer->m.offset) < 0)
        return -1;
    write_down(camera);
    return 0;
}

static int queue(struct stand_in *camera, const struct v4l2_buffer *buffer)
{
    if (camera->n_queued < BUFFERS)
        camera->queued[camera->n_queued++] = (int)buffer->index;
    return 0;
}

/* The two controls that it has; both are on. */
static int control(unsigned id, struct v4l2_queryctrl *query, struct v4l2_control *value)
{
    if (id != V4L2_CID_AUTO_WHITE_BALANCE && id != V4L2_CID_EXPOSURE_AUTO) {
        errno = EINVAL;
        return -1;
    }
    if (query) {
        query->flags = 0;
        query->minimum = 0;
        query->maximum = 3;
        snprintf((char *)query->name, sizeof query->name, "%s",
                 id == V4L2_CID_EXPOSURE_AUTO ? "Auto Exposure" : "White Balance, Automatic");
    } else {
        value->value = id == V4L2_CID_EXPOSURE_AUTO ? V4L2_EXPOSURE_APERTURE_PRIORITY : 1;
    }
    return 0;
}

static int answer(struct stand_in *camera, unsigned long request, void *what)
{
    struct v4l2_capability *capability = what;
    struct v4l2_requestbuffers *buffers = what;
    struct v4l2_queryctrl *query = what;
    struct v4l2_control *value = what;

    switch (request) {
    case VIDIOC_QUERYCAP:
        memset(capability, 0, sizeof *capability);
        capability->capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
        capability->device_caps = capability->capabilities;
        return 0;
    case VIDIOC_S_INPUT:
    case VIDIOC_STREAMON:
    case VIDIOC_STREAMOFF:
        return 0;
    case VIDIOC_G_INPUT:
        *(int *)what = 0;
        return 0;
    case VIDIOC_G_FMT:
        return get_format(what);
    case VIDIOC_TRY_FMT:
    case VIDIOC_S_FMT:
        return set_format(camera, what);
    case VIDIOC_S_PARM:
        return set_rate(camera, what);
    case VIDIOC_G_PARM:
        return get_rate(camera, what);
    case VIDIOC_REQBUFS:
        buffers->count = buffers->count > BUFFERS ? BUFFERS : buffers->count;
        camera->n_queued = 0;
        return 0;
    case VIDIOC_QUERYBUF:
        return describe_buffer(what);
    case VIDIOC_QBUF:
        return queue(camera, what);
    case VIDIOC_DQBUF:
        return take_picture(camera, what);
    case VIDIOC_QUERYCTRL:
        return control(query->id, query, NULL);
    case VIDIOC_G_CTRL:
        return control(value->id, NULL, value);
    default:
        errno = ENOTTY;
        return -1;
    }
}

typedef int open_fn(const char *, int, ...);
typedef int ioctl_fn(int, unsigned long, ...);
typedef int close_fn(int);

/* The C library's own; by way of memcpy, since ISO C knows no cast from object to function. */
static void find(const char *name, void *function, size_t size)
{
    void *found = dlsym(RTLD_NEXT, name);

    memcpy(function, &found, size);
}

static int open_as(const char *name, const char *path, int flags, mode_t mode)
{
    open_fn *next;

    if (strncmp(path, prefix, sizeof prefix - 1) == 0)
        return open_camera(path);
    find(name, &next, sizeof next);
    return next(path, flags, mode);
}

static mode_t mode_of(int flags, va_list more)
{
    return flags & (O_CREAT | O_TMPFILE) ? va_arg(more, mode_t) : 0;
}

int open(const char *path, int flags, ...)
{
    va_list more;

    va_start(more, flags);
    const mode_t mode = mode_of(flags, more);
    va_end(more);
    return open_as("open", path, flags, mode);
}

int open64(const char *path, int flags, ...)
{
    va_list more;

    va_start(more, flags);
    const mode_t mode = mode_of(flags, more);
    va_end(more);
    return open_as("open64", path, flags, mode);
}

int ioctl(int fd, unsigned long request, ...)
{
    struct stand_in *camera = camera_of(fd);
    ioctl_fn *next;
    va_list more;

    va_start(more, request);
    void *what = va_arg(more, void *);
    va_end(more);
    if (camera)
        return answer(camera, request & 0xffffffffUL, what);
    find("ioctl", &next, sizeof next);
    return next(fd, request, what);
}

int close(int fd)
{
    struct stand_in *camera = camera_of(fd);
    close_fn *next;

    if (camera)
        camera->used = false;
    find("close", &next, sizeof next);
    return next(fd);
}
