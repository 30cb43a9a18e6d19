#include "vision/pictures/jpeg.h"

#include <cstdio> /* jpeglib.h wants FILE */

#include <jerror.h>
#include <jpeglib.h>

#include <csetjmp>

static const int most_scans = 100; /* of a progressive picture: each costs the time of a picture */
static const char damaged[] = "its JPEG data are damaged";

/* libjpeg calls back and must not return from an error. */
struct jpeg_reader {
    jpeg_decompress_struct codec;
    jpeg_error_mgr errors;
    jpeg_progress_mgr progress;
    jmp_buf failed;
    bool incomplete; /* a part of the picture is missing */
};

static jpeg_reader *reader_of(j_common_ptr codec)
{
    return static_cast<jpeg_reader *>(codec->client_data);
}

[[noreturn]] static void on_error(j_common_ptr codec)
{
    longjmp(reader_of(codec)->failed, 1);
}

/* Of libjpeg's warnings these say that pixels were made up. Others, such as bytes before a marker
 * that belong to nothing, leave the picture whole. */
static void on_warning(j_common_ptr codec, int level)
{
    const int code = codec->err->msg_code;

    if (level < 0)
        codec->err->num_warnings++;
    if (level < 0 && (code == JWRN_HIT_MARKER || code == JWRN_HUFF_BAD_CODE ||
                      code == JWRN_MUST_RESYNC || code == JWRN_BOGUS_PROGRESSION))
        reader_of(codec)->incomplete = true;
}

static void on_progress(j_common_ptr codec)
{
    if (reinterpret_cast<j_decompress_ptr>(codec)->input_scan_number > most_scans)
        on_error(codec);
}

static void prepare(jpeg_reader *reader)
{
    reader->codec.err = jpeg_std_error(&reader->errors);
    reader->errors.error_exit = on_error;
    reader->errors.emit_message = on_warning;
    reader->codec.client_data = reader;
    jpeg_create_decompress(&reader->codec);
    reader->progress.progress_monitor = on_progress;
    reader->codec.progress = &reader->progress;
}

/* Returns what is wrong, or nullptr. */
static const char *read_header(jpeg_reader *reader, const uint8_t *data, size_t size, int width,
                               int height, jpeg_header *found)
{
    jpeg_decompress_struct &codec = reader->codec;

    jpeg_mem_src(&codec, data, size);
    if (jpeg_read_header(&codec, TRUE) != JPEG_HEADER_OK)
        return "its JPEG header is damaged";
    *found = {static_cast<int>(codec.image_width), static_cast<int>(codec.image_height),
              codec.jpeg_color_space == JCS_GRAYSCALE};
    if (codec.image_width != static_cast<JDIMENSION>(width) ||
        codec.image_height != static_cast<JDIMENSION>(height))
        return "its JPEG header names another size than its message";
    return nullptr;
}

static void read_rows(jpeg_reader *reader, uint8_t *rgb)
{
    jpeg_decompress_struct &codec = reader->codec;

    codec.out_color_space = JCS_RGB;
    jpeg_start_decompress(&codec);
    while (codec.output_scanline < codec.output_height) {
        JSAMPROW row = rgb + static_cast<size_t>(codec.output_scanline) * codec.output_width * 3;
        jpeg_read_scanlines(&codec, &row, 1);
    }
    jpeg_finish_decompress(&codec);
}

const char *jpeg_decode(const uint8_t *data, size_t size, int width, int height, uint8_t *rgb,
                        jpeg_header *found)
{
    jpeg_reader reader = {};
    const char *volatile wrong = "its JPEG header is damaged";

    *found = {0, 0, false};
    if (setjmp(reader.failed) == 0) { /* no object with a destructor lives beyond this line */
        prepare(&reader);
        wrong = read_header(&reader, data, size, width, height, found);
        if (!wrong) {
            wrong = damaged;
            read_rows(&reader, rgb);
            wrong = reader.incomplete ? damaged : nullptr;
        }
    }
    jpeg_destroy_decompress(&reader.codec);
    return wrong;
}
