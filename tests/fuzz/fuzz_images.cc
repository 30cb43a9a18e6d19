/* What vision hears: a pair of pictures, taken apart and decoded, every pixel looked at. */
#include "harness.h"
#include "vision/pictures/decode.h"
#include "vision/pictures/image_message.h"

static void decode_whole(const encoded_image &from)
{
    static decoder decoding;
    camera eye = {};
    image_view view;
    unsigned sum = 0;

    eye.width = 16;
    eye.height = 8;
    if (decoding.decode(from, eye, &view))
        return;
    HARNESS_REQUIRE(view.width == eye.width && view.height == eye.height);
    for (int row = 0; row < view.height; row++)
        for (size_t i = 0; i < 3 * static_cast<size_t>(view.width); i++)
            sum += view.data[static_cast<size_t>(row) * view.stride + i];
    HARNESS_REQUIRE(sum < 1u << 30);
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    image_message message;

    if (image_message_parse(data, size, &message))
        return 0;
    decode_whole(message.left);
    decode_whole(message.right);
    return 0;
}
