/* LCM's packets as they come from the socket, well-formed and not. */
#include "tests/unit/suite.h"
#include "tools/reachctl/doctor/packet.h"

#include <stdio.h>
#include <string.h>
#include <time.h>

static struct packet packet;

static bool read_bytes(const char *bytes, size_t size)
{
    return packet_read((const unsigned char *)bytes, size, &packet);
}

/* Without the terminating zero of the literal. */
#define READ(literal) read_bytes(literal, sizeof(literal) - 1)

START_TEST(a_whole_message)
{
    ck_assert(READ("LC02\0\0\0\7"
                   "NAME\0\1\2\3\4\5\6\7\10tail"));
    ck_assert_str_eq(packet.channel, "NAME");
    ck_assert_uint_eq(packet.payload_size, 12);
    ck_assert_uint_eq(packet.message_size, 12);
    ck_assert_int_eq(packet_fingerprint(&packet), 0x0102030405060708);
}
END_TEST

START_TEST(the_first_fragment)
{
    ck_assert(READ("LC03\0\0\0\7\0\1\0\0\0\0\0\0\0\0\0\2"
                   "IMAGES\0abc"));
    ck_assert_str_eq(packet.channel, "IMAGES");
    ck_assert_uint_eq(packet.payload_size, 3);
    ck_assert_uint_eq(packet.message_size, 65536);
    ck_assert_int_eq(packet_fingerprint(&packet), 0);
}
END_TEST

START_TEST(what_begins_no_message)
{
    ck_assert(!READ("LC03\0\0\0\7\0\1\0\0\0\0\0\0\0\1\0\2"
                    "IMAGES\0abc"));
    ck_assert(!READ("LC04\0\0\0\7NAME\0"));
    ck_assert(!READ("LC02\0\0\0\7NAME"));
    ck_assert(!READ("LC02\0\0"));
    ck_assert(!READ("LC03\0\0\0\7\0\1\0\0"));
    ck_assert(!READ(""));
    ck_assert(!READ("LC02\0\0\0\7"
                    "0123456789012345678901234567890123456789012345678901234567890123\0"));
}
END_TEST

START_TEST(noise_does_no_harm)
{
    unsigned char data[96];
    const char *given = getenv("REACH_TEST_SEED");
    unsigned int seed = given ? (unsigned int)atoi(given) : (unsigned int)time(NULL);

    printf("seed %u\n", seed);
    srand(seed);
    for (int i = 0; i < 200000; i++) {
        size_t size = (size_t)rand() % (sizeof data + 1);
        for (size_t j = 0; j < size; j++)
            data[j] = (unsigned char)(rand() % 3 ? 0 : rand());
        if (size > 4)
            memcpy(data, rand() % 2 ? "LC02" : "LC03", 4);
        if (!packet_read(data, size, &packet))
            continue;
        ck_assert(packet.payload >= data);
        ck_assert(packet.payload + packet.payload_size <= data + size);
    }
}
END_TEST

int main(void)
{
    const TTest *tests[] = {a_whole_message, the_first_fragment, what_begins_no_message,
                            noise_does_no_harm};

    return SUITE_RUN("packet", tests);
}
