/* Opening the bus, and two programs that want the same role. Runs in its own network namespace. */
#include "common/bus/open.h"
#include "tests/unit/suite.h"

#include <pthread.h>
#include <reach_hello_t.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

static char error[512];

struct owner {
    lcm_t *lcm;
    atomic_bool stop;
};

static void *answer_others(void *user)
{
    struct owner *owner = (struct owner *)user;

    while (!atomic_load(&owner->stop))
        lcm_handle_timeout(owner->lcm, 20);
    return NULL;
}

START_TEST(the_bus_opens_where_multicast_works)
{
    lcm_t *lcm = bus_open(NULL, error, sizeof error);

    ck_assert_msg(lcm != NULL, "%s", error);
    lcm_destroy(lcm);
}
END_TEST

START_TEST(the_address_gets_room_for_pictures)
{
    char url[512];

    bus_url("udpm://1.2.3.4:5", url, sizeof url);
    ck_assert_ptr_nonnull(strstr(url, "udpm://1.2.3.4:5?recv_buf_size="));
    bus_url("udpm://1.2.3.4:5?ttl=0", url, sizeof url);
    ck_assert_ptr_nonnull(strstr(url, "udpm://1.2.3.4:5?ttl=0&recv_buf_size="));
    bus_url("udpm://1.2.3.4:5?recv_buf_size=9", url, sizeof url);
    ck_assert_str_eq(url, "udpm://1.2.3.4:5?recv_buf_size=9");
    bus_url("memq://", url, sizeof url);
    ck_assert_str_eq(url, "memq://");
}
END_TEST

START_TEST(a_wrong_address_is_told)
{
    ck_assert_ptr_null(bus_open("nonsense://1", error, sizeof error));
    ck_assert_ptr_nonnull(strstr(error, "nonsense://1"));
}
END_TEST

START_TEST(the_second_of_a_kind_is_told)
{
    struct owner owner = {.lcm = bus_open(NULL, error, sizeof error)};
    lcm_t *second = bus_open(NULL, error, sizeof error);
    struct bus_claim *first_claim;
    struct bus_claim *second_claim;
    struct bus_claim *other_claim;
    pthread_t thread;

    ck_assert_int_eq(bus_claim_role(owner.lcm, REACH_HELLO_T_DAEMON, 100, &first_claim), 0);
    ck_assert_int_eq(pthread_create(&thread, NULL, answer_others, &owner), 0);
    ck_assert_int_eq(bus_claim_role(second, REACH_HELLO_T_VISION, 100, &other_claim), 0);
    ck_assert_int_eq(bus_claim_role(second, REACH_HELLO_T_DAEMON, 1000, &second_claim), 1);
    atomic_store(&owner.stop, true);
    pthread_join(thread, NULL);
    lcm_destroy(owner.lcm);
    lcm_destroy(second);
    bus_claim_free(first_claim);
    bus_claim_free(second_claim);
    bus_claim_free(other_claim);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        the_bus_opens_where_multicast_works,
        the_address_gets_room_for_pictures,
        a_wrong_address_is_told,
        the_second_of_a_kind_is_told,
    };

    return SUITE_RUN("bus", tests);
}
