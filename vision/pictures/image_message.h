/* Reads bot_core.images_t straight from the bytes of a message.
 *
 * The decoder that lcm-gen makes allocates whatever a message claims before it looks whether the
 * bytes are there; a message of 20 bytes can end the process. Here every count, size and length is
 * held against the bytes first, nothing is allocated, and the pixels are not copied. */
#ifndef VISION_PICTURES_IMAGE_MESSAGE_H
#define VISION_PICTURES_IMAGE_MESSAGE_H

#include <cstddef>
#include <cstdint>

/* bot_core.image_t.pixelformat: the four letters of the format's name, first letter lowest. */
enum pixel_format : int32_t {
    PIXEL_FORMAT_GRAY = 1497715271,
    PIXEL_FORMAT_RGB = 859981650,
    PIXEL_FORMAT_BGR = 861030210,
    PIXEL_FORMAT_MJPEG = 1196444237,
};

/* A picture as it came, not yet decoded. `data` belongs to the message. For raw formats it has been
 * checked that all rows lie inside the `size` bytes. */
struct encoded_image {
    const uint8_t *data = nullptr;
    size_t size = 0;
    int width = 0;     /* px, 1 .. IMAGE_MESSAGE_MAX_SIDE */
    int height = 0;    /* px, 1 .. IMAGE_MESSAGE_MAX_SIDE */
    size_t stride = 0; /* bytes from row to row; 0 in compressed formats */
    int32_t format = 0;
};

enum { IMAGE_MESSAGE_MAX_SIDE = 16384, IMAGE_MESSAGE_MAX_IMAGES = 16 };

struct image_message {
    int64_t utime = 0; /* exposure; us, > 0 */
    encoded_image left;
    encoded_image right;
};

/* Takes the message apart. Exactly one left and one right image must be there; others are checked
 * and passed over.
 *   returns nullptr, or what is wrong with the message (a constant text); then `message` is
 *   unspecified. */
const char *image_message_parse(const uint8_t *data, size_t size, image_message *message);

#endif
