#include "vision/pictures/image_message.h"

#include <cstring>

#include "common/base/big_endian.h"

static const uint64_t fingerprint = 0x20ba4f05e8f5e33aULL;
static const int16_t type_left = 0;
static const int16_t type_right = 1;
static const int max_metadata = 64; /* entries of an image: cameras send a handful */

/* The bytes not yet read. Once something was missing, `failed` stays and all reads give 0. */
struct reader {
    const uint8_t *at;
    size_t left;
    bool failed;
};

static const uint8_t *take_bytes(reader *in, size_t n)
{
    const uint8_t *start = in->at;

    if (in->failed || n > in->left) {
        in->failed = true;
        return nullptr;
    }
    in->at += n;
    in->left -= n;
    return start;
}

static uint64_t take_number(reader *in, int n)
{
    const uint8_t *bytes = take_bytes(in, static_cast<size_t>(n));

    return bytes ? big_endian(bytes, n) : 0;
}

static int32_t take_int32(reader *in)
{
    return static_cast<int32_t>(static_cast<uint32_t>(take_number(in, 4)));
}

static int64_t take_int64(reader *in)
{
    return static_cast<int64_t>(take_number(in, 8));
}

static const char *skip_metadata(reader *in)
{
    const int32_t n = take_int32(in);

    if (in->failed)
        return "it ends inside an image";
    if (n < 0 || n > max_metadata)
        return "an image's count of metadata is out of range";
    for (int32_t i = 0; i < n; i++) {
        const int32_t key = take_int32(in); /* with its closing zero */
        if (in->failed || key < 1)
            return "a metadata key is damaged";
        take_bytes(in, static_cast<size_t>(key));
        const int32_t value = take_int32(in);
        if (in->failed || value < 0)
            return "a metadata value is damaged";
        take_bytes(in, static_cast<size_t>(value));
        if (in->failed)
            return "it ends inside an image's metadata";
    }
    return nullptr;
}

static const char *check_rows(const encoded_image &image, const format &kind, int32_t stride)
{
    const size_t row = static_cast<size_t>(image.width) * static_cast<size_t>(kind.row_bytes);
    const size_t rows = static_cast<size_t>(image.height) * (kind.planes ? 3 : 2) / 2;

    if (kind.to_bgr == FORMAT_COMPRESSED)
        return nullptr;
    if (image.width % kind.even || image.height % kind.even)
        return "an image's width or height is odd, which its pixelformat does not allow";
    if (stride < 0 || static_cast<size_t>(stride) < row)
        return "an image's row_stride is shorter than its rows";
    if (image.size < static_cast<size_t>(stride) * (rows - 1) + row)
        return "an image has fewer bytes than its rows need";
    return nullptr;
}

static const char *check_image(encoded_image *image, int32_t stride, image_message *message)
{
    const format *const kind = format_of(image->format);

    if (image->width < 1 || image->height < 1 || image->width > IMAGE_MESSAGE_MAX_SIDE ||
        image->height > IMAGE_MESSAGE_MAX_SIDE)
        return "an image's width or height is out of range";
    if (!kind) {
        format_complain(image->format, message->wrong, sizeof message->wrong);
        return message->wrong;
    }
    if (image->size < 1)
        return "an image's size is out of range";
    const char *wrong = check_rows(*image, *kind, stride);
    image->stride = wrong || kind->to_bgr == FORMAT_COMPRESSED ? 0 : static_cast<size_t>(stride);
    return wrong;
}

/* `is_eye`: else it is passed over. */
static const char *take_image(reader *in, bool is_eye, encoded_image *image, image_message *message)
{
    image->utime = take_int64(in);
    image->width = take_int32(in);
    image->height = take_int32(in);
    const int32_t stride = take_int32(in);
    image->format = take_int32(in);
    const int32_t size = take_int32(in);
    if (in->failed)
        return "it ends inside an image";
    if (size < 0)
        return "an image's size is out of range";
    image->size = static_cast<size_t>(size);
    image->data = take_bytes(in, image->size);
    if (!image->data)
        return "it ends inside an image's pixels";
    const char *wrong = is_eye ? check_image(image, stride, message) : nullptr;
    return wrong ? wrong : skip_metadata(in);
}

static const char *take_images(reader *in, const int16_t *types, int n, image_message *message)
{
    for (int i = 0; i < n; i++) {
        const bool is_eye = types[i] == type_left || types[i] == type_right;
        encoded_image image;
        const char *wrong = take_image(in, is_eye, &image, message);
        if (wrong)
            return wrong;
        if (!is_eye)
            continue;
        encoded_image *place = types[i] == type_left ? &message->left : &message->right;
        if (place->data)
            return "it has two images of one eye";
        *place = image;
    }
    if (in->left > 0)
        return "bytes are left over at its end";
    return message->left.data && message->right.data ? nullptr : "an eye's image is missing";
}

const char *image_message_parse(const uint8_t *data, size_t size, image_message *message)
{
    reader in = {data, size, false};
    int16_t types[IMAGE_MESSAGE_MAX_IMAGES];

    *message = image_message();
    if (take_number(&in, 8) != fingerprint || in.failed)
        return "it is no bot_core.images_t";
    message->utime = take_int64(&in);
    const int32_t n = take_int32(&in);
    if (in.failed || message->utime <= 0)
        return "its utime is out of range";
    if (n < 2 || n > IMAGE_MESSAGE_MAX_IMAGES)
        return "its count of images is out of range";
    for (int32_t i = 0; i < n; i++)
        types[i] = static_cast<int16_t>(static_cast<uint16_t>(take_number(&in, 2)));
    if (in.failed)
        return "it ends inside its image_types";
    return take_images(&in, types, n, message);
}
