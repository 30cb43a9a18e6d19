/* Messages of every kind of damage: refused with a reason, never a crash, never a byte beyond. */
#include <bot_core_images_t.h>
#include <cstdio>
#include <cstring>
#include <memory>

#include "fixture.h"

/* Check defines a macro `fail`, which the C++ library uses as a name: it comes last. */
#include "tests/unit/suite.h"

/* A copy that ends where the allocation ends, so that the sanitizer sees a read beyond. */
static const char *parse(const uint8_t *bytes, size_t size, image_message *message)
{
    std::unique_ptr<uint8_t[]> exact(new uint8_t[size]);

    memcpy(exact.get(), bytes, size);
    const char *wrong = image_message_parse(exact.get(), size, message);
    if (wrong)
        return wrong;
    /* Every pixel that was promised must be there. */
    unsigned sum = 0;
    for (const encoded_image *image : {&message->left, &message->right})
        for (size_t i = 0; i < image->size; i++)
            sum += image->data[i];
    return sum == 0xffffffffU ? "impossible" : nullptr;
}

/* Writes a number with its highest byte first. */
static void put(std::vector<uint8_t> *bytes, size_t at, uint64_t value, size_t n)
{
    for (size_t i = 0; i < n; i++)
        (*bytes)[at + i] = static_cast<uint8_t>(value >> 8 * (n - 1 - i));
}

/* Offsets in fixture_small_message(). */
enum {
    AT_UTIME = 8,
    AT_N_IMAGES = 16,
    AT_TYPES = 20,
    AT_WIDTH = 32,
    AT_HEIGHT = 36,
    AT_STRIDE = 40,
    AT_FORMAT = 44,
    AT_SIZE = 48,
    AT_METADATA = 52 + 60,
    AT_KEY_LENGTH = AT_METADATA + 4,
    AT_VALUE_LENGTH = AT_KEY_LENGTH + 4 + 5,
};

START_TEST(fingerprints_are_those_that_other_tools_know)
{
    ck_assert(static_cast<uint64_t>(__bot_core_images_t_get_hash()) == 0x20ba4f05e8f5e33aULL);
    ck_assert(static_cast<uint64_t>(__bot_core_image_t_get_hash()) == 0x14739ffe13d5f5f0ULL);
}
END_TEST

START_TEST(a_third_image_is_passed_over)
{
    const std::vector<uint8_t> bytes = fixture_message_with_disparity(77);
    image_message message;

    ck_assert_ptr_null(parse(bytes.data(), bytes.size(), &message));
    ck_assert_int_eq(message.utime, 77);
    ck_assert_int_eq(message.right.width, 8);
}
END_TEST

START_TEST(a_strange_pixelformat_is_named)
{
    std::vector<uint8_t> bytes = fixture_small_message();
    image_message message;

    put(&bytes, AT_FORMAT, 909199180, 4);
    const char *wrong = parse(bytes.data(), bytes.size(), &message);
    ck_assert_ptr_nonnull(wrong);
    ck_assert_ptr_nonnull(strstr(wrong, "909199180 (LE_GRAY16)"));
    ck_assert_ptr_nonnull(strstr(wrong, "MJPEG"));
}
END_TEST

START_TEST(good_message_is_read_without_copying)
{
    const std::vector<uint8_t> bytes = fixture_small_message();
    image_message message;

    ck_assert_ptr_null(image_message_parse(bytes.data(), bytes.size(), &message));
    ck_assert_int_eq(message.utime, 123456);
    ck_assert_ptr_eq(message.left.data, bytes.data() + 52);
    ck_assert_uint_eq(message.left.size, 60);
    ck_assert_uint_eq(message.right.stride, 15);
    ck_assert_int_eq(message.right.width, 5);
    ck_assert_int_eq(message.right.height, 4);
    ck_assert_int_eq(message.right.format, PIXEL_FORMAT_RGB);
}
END_TEST

START_TEST(every_truncation_is_refused)
{
    std::vector<uint8_t> bytes = fixture_small_message();
    image_message message;

    for (size_t size = 0; size < bytes.size(); size++)
        ck_assert_msg(parse(bytes.data(), size, &message), "%zu bytes were accepted", size);
    bytes.push_back(0);
    ck_assert_ptr_nonnull(parse(bytes.data(), bytes.size(), &message));
}
END_TEST

START_TEST(hostile_numbers_are_refused)
{
    static const struct {
        size_t at;
        size_t n;
        uint64_t value;
    } hostile[] = {
        {0, 8, 0},
        {AT_UTIME, 8, 0},
        {AT_UTIME, 8, 0xffffffffffffffffULL},
        {AT_N_IMAGES, 4, 0x7fffffff},
        {AT_N_IMAGES, 4, 0xffffffff},
        {AT_N_IMAGES, 4, 1},
        {AT_N_IMAGES, 4, 3},
        {AT_TYPES, 2, 1},
        {AT_TYPES, 2, 77},
        {AT_WIDTH, 4, 0},
        {AT_WIDTH, 4, 0xffffffff},
        {AT_WIDTH, 4, 6},
        {AT_WIDTH, 4, 0x7fffffff},
        {AT_HEIGHT, 4, 5},
        {AT_HEIGHT, 4, 0},
        {AT_HEIGHT, 4, 0x80000000},
        {AT_STRIDE, 4, 14},
        {AT_STRIDE, 4, 16},
        {AT_STRIDE, 4, 0},
        {AT_STRIDE, 4, 0x7fffffff},
        {AT_STRIDE, 4, 0xffffffff},
        {AT_FORMAT, 4, 0},
        {AT_FORMAT, 4, PIXEL_FORMAT_MJPEG + 1},
        {AT_SIZE, 4, 0},
        {AT_SIZE, 4, 59},
        {AT_SIZE, 4, 61},
        {AT_SIZE, 4, 0x7fffffff},
        {AT_SIZE, 4, 0xffffffff},
        {AT_METADATA, 4, 0x7fffffff},
        {AT_METADATA, 4, 0xffffffff},
        {AT_METADATA, 4, 0},
        {AT_KEY_LENGTH, 4, 0},
        {AT_KEY_LENGTH, 4, 0x7fffffff},
        {AT_KEY_LENGTH, 4, 0xffffffff},
        {AT_VALUE_LENGTH, 4, 0x7fffffff},
        {AT_VALUE_LENGTH, 4, 0xffffffff},
    };
    image_message message;

    for (const auto &one : hostile) {
        std::vector<uint8_t> bytes = fixture_small_message();
        put(&bytes, one.at, one.value, one.n);
        ck_assert_msg(parse(bytes.data(), bytes.size(), &message), "byte %zu = %llx was accepted",
                      one.at, static_cast<unsigned long long>(one.value));
    }
}
END_TEST

/* 20 bytes that make the generated decoder allocate for two thousand million images. */
START_TEST(twenty_bytes_with_all_images_are_refused)
{
    std::vector<uint8_t> bytes(20);
    image_message message;

    put(&bytes, 0, 0x20ba4f05e8f5e33aULL, 8);
    put(&bytes, 8, 5, 8);
    put(&bytes, 16, 0x7fffffff, 4);
    ck_assert_ptr_nonnull(parse(bytes.data(), bytes.size(), &message));
}
END_TEST

START_TEST(random_bytes_never_read_beyond)
{
    std::mt19937_64 random(fixture_seed(11));
    const std::vector<uint8_t> good = fixture_small_message();
    image_message message;
    int accepted = 0;

    for (int i = 0; i < 20000; i++) {
        std::vector<uint8_t> bytes = good;
        const int flips = 1 + static_cast<int>(random() % 6);
        for (int j = 0; j < flips; j++)
            bytes[random() % bytes.size()] = static_cast<uint8_t>(random());
        if (random() % 4 == 0)
            bytes.resize(random() % (bytes.size() + 1));
        accepted += parse(bytes.data(), bytes.size(), &message) == nullptr;
    }
    printf("%d of 20000 damaged messages still made sense\n", accepted);
    ck_assert_int_gt(accepted, 0); /* pixels may be anything */
}
END_TEST

int main()
{
    const TTest *const tests[] = {
        fingerprints_are_those_that_other_tools_know,
        a_third_image_is_passed_over,
        a_strange_pixelformat_is_named,
        good_message_is_read_without_copying,
        every_truncation_is_refused,
        hostile_numbers_are_refused,
        twenty_bytes_with_all_images_are_refused,
        random_bytes_never_read_beyond,
    };

    return SUITE_RUN("vision message", tests);
}
