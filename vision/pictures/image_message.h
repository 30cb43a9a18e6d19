/* Reads bot_core.images_t straight from the bytes of a message.
 *
 * The decoder that lcm-gen makes allocates whatever a message claims before it looks whether the
 * bytes are there; a message of 20 bytes can end the process. Here every count, size and length is
 * held against the bytes first, nothing is allocated, and the pixels are not copied. */
#ifndef VISION_PICTURES_IMAGE_MESSAGE_H
#define VISION_PICTURES_IMAGE_MESSAGE_H

#include <cstddef>
#include <cstdint>

#include "vision/pictures/formats.h"

/* A picture as it came, not yet decoded. `data` belongs to the message. For raw formats it has been
 * checked that all rows lie inside the `size` bytes. */
struct encoded_image {
    const uint8_t *data = nullptr;
    size_t size = 0;
    int width = 0;     /* px, 1 .. IMAGE_MESSAGE_MAX_SIDE */
    int height = 0;    /* px, 1 .. IMAGE_MESSAGE_MAX_SIDE */
    size_t stride = 0; /* bytes from row to row; 0 in compressed formats */
    int32_t format = 0;
    int64_t utime = 0; /* the eye's own exposure, 0 = not said; us */
};

enum { IMAGE_MESSAGE_MAX_SIDE = 16384, IMAGE_MESSAGE_MAX_IMAGES = 16 };

struct image_message {
    int64_t utime = 0; /* exposure; us, > 0 */
    encoded_image left;
    encoded_image right;
    char wrong[192] = ""; /* image_message_parse's text, where it is not constant */
};

/* Takes the message apart. Exactly one left and one right image must be there; others, such as a
 * disparity map, are passed over whatever they hold.
 *   returns nullptr, or what is wrong with the message, in a constant text or in message->wrong. */
const char *image_message_parse(const uint8_t *data, size_t size, image_message *message);

#endif
