/* JPEG as cameras send it: with bytes too many or an end too few it still shows a whole picture. */
#ifndef VISION_PICTURES_JPEG_H
#define VISION_PICTURES_JPEG_H

#include <cstddef>
#include <cstdint>

/* Decodes a frame of `width` by `height` pixels into `rgb`, 3 bytes a pixel, rows without gaps.
 * Nothing is decoded whose header names another size. A frame without Huffman tables has the
 * standard ones, as Motion JPEG allows. What libjpeg mends without loss is taken: bytes that belong
 * to nothing, a missing end marker. A picture of which a part is missing is refused.
 *   returns nullptr, or what is wrong with it (a constant text). *found is what its header says,
 *   all 0 where that could not be read. */
struct jpeg_header {
    int width;
    int height;
    bool grey; /* it has no colours; `rgb` is three times the same */
};
const char *jpeg_decode(const uint8_t *data, size_t size, int width, int height, uint8_t *rgb,
                        jpeg_header *found);

#endif
