/* What reachctl writes of a body moves as the body does: a URDF, read back, and Denavit's and
 * Hartenberg's numbers. */
#include "common/base/random.h"
#include "learner/finder/urdf.h"

extern "C" {
#include "tools/reachctl/body/dh.h"
#include "tools/reachctl/body/show.h"
}

#include <Eigen/Geometry>
#include <cstdio>
#include <cstring>
#include <string>
#include <unistd.h>

/* Last: Check's macro `fail` is a member's name in the library's headers. */
#include "tests/unit/suite.h"

namespace
{

random_state source = random_seed(5);

double uniform(double low, double high)
{
    return random_uniform(&source, low, high);
}

/* An arm with every case: skew axes, parallel ones, some that meet, one that slides. */
struct chain some_chain(int seed)
{
    static const double special[4][3] = {{0, 0, 1}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
    struct chain chain = {};

    source = random_seed(seed);
    chain.n = 6;
    for (int i = 0; i < chain.n; i++) {
        Eigen::Map<Eigen::Vector3d> axis(chain.axis[i]);
        if (i < 4)
            axis = Eigen::Map<const Eigen::Vector3d>(special[i]);
        else
            axis = Eigen::Vector3d(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized();
        for (double &offset : chain.offset[i])
            offset = i == 3 ? 0 : uniform(-0.5, 0.5);
        chain.middle[i] = uniform(-1, 1);
    }
    chain.slides[4] = seed % 2 == 1;
    return chain;
}

Eigen::Isometry3d frame_of(const struct chain &chain, const double *q)
{
    chain_pose pose;
    Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();

    chain_at(&chain, q, &pose);
    frame.linear() =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(pose.turn[chain.n]);
    frame.translation() = Eigen::Map<const Eigen::Vector3d>(pose.p);
    return frame;
}

Eigen::Isometry3d frame_of(const struct chain &chain, const dh &dh, const double *q)
{
    Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();

    for (int c = 0; c < 3; c++)
        frame.linear().col(c) = Eigen::Map<const Eigen::Vector3d>(dh.base + 3 * c);
    frame.translation() = Eigen::Map<const Eigen::Vector3d>(dh.base + 9);
    for (int i = 0; i < dh.n; i++) {
        const dh_row &row = dh.row[i];
        double turned = row.theta + (chain.slides[i] ? 0 : q[i]);
        double shifted = row.d + (chain.slides[i] ? q[i] : 0);
        frame = frame * Eigen::AngleAxisd(turned, Eigen::Vector3d::UnitZ()) *
                Eigen::Translation3d(row.a, 0, shifted) *
                Eigen::AngleAxisd(row.alpha, Eigen::Vector3d::UnitX());
    }
    return frame;
}

void some_joints(double *q)
{
    for (int i = 0; i < CHAIN_MAX_JOINTS; i++)
        q[i] = uniform(-3, 3);
}

struct body body_of(const struct chain &chain)
{
    struct body body = {};

    body.chain = chain;
    for (double &range : body.range)
        range = 1;
    return body;
}

} // namespace

START_TEST(dh_moves_as_the_chain_does)
{
    for (int seed = 1; seed <= 20; seed++) {
        struct chain chain = some_chain(seed);
        const double zero[CHAIN_MAX_JOINTS] = {0};
        double q[CHAIN_MAX_JOINTS];
        dh dh;
        dh_of_chain(&chain, &dh);
        /* What follows the last frame is the same everywhere. */
        Eigen::Isometry3d behind = frame_of(chain, dh, zero).inverse() * frame_of(chain, zero);
        for (int n = 0; n < 20; n++) {
            some_joints(q);
            Eigen::Isometry3d both = frame_of(chain, dh, q) * behind;
            double apart = (both.matrix() - frame_of(chain, q).matrix()).cwiseAbs().maxCoeff();
            ck_assert_msg(apart < 1e-9, "arm %d: %g apart", seed, apart);
        }
    }
}
END_TEST

START_TEST(urdf_comes_back_as_the_same_chain)
{
    for (int seed = 1; seed <= 20; seed++) {
        struct chain chain = some_chain(seed);
        struct chain back;
        struct body body = body_of(chain);
        double q[CHAIN_MAX_JOINTS];
        char error[200] = "";
        char path[] = "/tmp/test_body_export_XXXXXX";
        const double zero[CHAIN_MAX_JOINTS] = {0};
        FILE *stream = fdopen(mkstemp(path), "w");
        body_write_urdf(&body, stream);
        fclose(stream);
        ck_assert_msg(finder_read_urdf(path, nullptr, chain.n, &back, error, sizeof error) == 0,
                      "%s", error);
        unlink(path);
        Eigen::Isometry3d behind = frame_of(back, zero).inverse() * frame_of(chain, zero);
        for (int n = 0; n < 20; n++) {
            some_joints(q);
            double apart = ((frame_of(back, q) * behind).matrix() - frame_of(chain, q).matrix())
                               .cwiseAbs()
                               .maxCoeff();
            ck_assert_msg(apart < 1e-7, "arm %d: %g apart", seed, apart);
        }
    }
}
END_TEST

START_TEST(what_is_no_start_is_refused)
{
    const std::string robots = std::string(getenv("REACH_SOURCE_DIR")) + "/etc/robots/";
    struct chain chain;
    char error[200];

    ck_assert_int_eq(finder_read_urdf((robots + "sixaxis.urdf").c_str(), nullptr, 6, &chain, error,
                                      sizeof error),
                     0);
    ck_assert_int_eq(finder_read_urdf((robots + "sixaxis.urdf").c_str(), nullptr, 9, &chain, error,
                                      sizeof error),
                     -1);
    ck_assert_ptr_nonnull(strstr(error, "6 moving joints, 9 are wanted"));
    ck_assert_int_eq(finder_read_urdf((robots + "sixaxis.urdf").c_str(), "nowhere", 6, &chain,
                                      error, sizeof error),
                     -1);
    ck_assert_ptr_nonnull(strstr(error, "no link nowhere"));
    ck_assert_int_eq(finder_read_urdf("/dev/null", nullptr, 6, &chain, error, sizeof error), -1);
}
END_TEST

int main()
{
    const TTest *const tests[] = {dh_moves_as_the_chain_does, urdf_comes_back_as_the_same_chain,
                                  what_is_no_start_is_refused};

    return SUITE_RUN("a body for other programs", tests);
}
