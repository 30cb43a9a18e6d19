#include "simrobot/eyes/image_message.h"

#include <bot_core_images_t.h>
#include <turbojpeg.h>

#include <string>

namespace sim
{
namespace
{

/* LCM's structures are not const; they are only read here. */
std::vector<bot_core_image_metadata_t> metadata_of(const std::vector<ImageNote> &notes, int eye)
{
    std::vector<bot_core_image_metadata_t> metadata;

    for (const ImageNote &note : notes)
        if (note.eye == eye)
            metadata.push_back({const_cast<char *>(note.key.c_str()),
                                static_cast<int32_t>(note.value.size()),
                                const_cast<uint8_t *>(note.value.data())});
    return metadata;
}

} // namespace

ImageMessage::ImageMessage(const Config &config)
    : width_(config.width), height_(config.height), quality_(config.jpeg_quality),
      jpeg_(config.image_format == static_cast<int>(ImageFormat::jpeg))
{
}

std::unique_ptr<ImageMessage> ImageMessage::create(const Config &config, std::string *error)
{
    std::unique_ptr<ImageMessage> message(new ImageMessage(config));
    auto pixels = static_cast<size_t>(config.width) * static_cast<size_t>(config.height);

    message->compressor_ = tjInitCompress();
    if (!message->compressor_) {
        *error = std::string("eyes: TurboJPEG: ") + tjGetErrorStr2(nullptr);
        return nullptr;
    }
    for (auto &data : message->data_)
        data.resize(message->jpeg_ ? tjBufSize(config.width, config.height, TJSAMP_422)
                                   : 3 * pixels);
    return message;
}

ImageMessage::~ImageMessage()
{
    if (compressor_)
        tjDestroy(compressor_);
}

/* 4:2:2, as cameras send it: the ball's outline is mostly colour. */
bool ImageMessage::compress(const uint8_t *pixels, int eye, std::string *error)
{
    unsigned char *out = data_[eye].data();

    size_[eye] = data_[eye].size();
    if (tjCompress2(compressor_, pixels, width_, 2 * width_ * 4, height_, TJPF_RGBX, &out,
                    &size_[eye], TJSAMP_422, quality_, TJFLAG_NOREALLOC | TJFLAG_FASTDCT) == 0)
        return true;
    *error = std::string("eyes: TurboJPEG: ") + tjGetErrorStr2(compressor_);
    return false;
}

void ImageMessage::strip(const uint8_t *pixels, int eye)
{
    uint8_t *out = data_[eye].data();

    for (int y = 0; y < height_; y++, pixels += 2 * width_ * 4)
        for (int x = 0; x < width_; x++, out += 3) {
            out[0] = pixels[4 * x];
            out[1] = pixels[4 * x + 1];
            out[2] = pixels[4 * x + 2];
        }
    size_[eye] = data_[eye].size();
}

std::vector<uint8_t> ImageMessage::encode(int64_t utime, const std::vector<uint8_t> &pixels,
                                          std::string *error, const std::vector<ImageNote> &notes)
{
    std::vector<bot_core_image_metadata_t> metadata[2] = {metadata_of(notes, 0),
                                                          metadata_of(notes, 1)};
    int16_t types[2] = {BOT_CORE_IMAGES_T_LEFT, BOT_CORE_IMAGES_T_RIGHT};
    bot_core_image_t images[2] = {};
    bot_core_images_t message = {};

    for (int eye = 0; eye < 2; eye++) {
        const uint8_t *start = pixels.data() + eye * width_ * 4;
        if (!jpeg_)
            strip(start, eye);
        else if (!compress(start, eye, error))
            return {};
        images[eye].utime = utime;
        images[eye].width = width_;
        images[eye].height = height_;
        images[eye].row_stride = jpeg_ ? 0 : 3 * width_;
        images[eye].pixelformat =
            jpeg_ ? BOT_CORE_IMAGE_T_PIXEL_FORMAT_MJPEG : BOT_CORE_IMAGE_T_PIXEL_FORMAT_RGB;
        images[eye].size = static_cast<int32_t>(size_[eye]);
        images[eye].data = data_[eye].data();
        images[eye].nmetadata = static_cast<int32_t>(metadata[eye].size());
        images[eye].metadata = metadata[eye].data();
    }
    message.utime = utime;
    message.n_images = 2;
    message.image_types = types;
    message.images = images;
    std::vector<uint8_t> bytes(static_cast<size_t>(bot_core_images_t_encoded_size(&message)));
    if (bot_core_images_t_encode(bytes.data(), 0, static_cast<int>(bytes.size()), &message) < 0)
        *error = "eyes: images_t cannot be encoded";
    return bytes;
}

} // namespace sim
