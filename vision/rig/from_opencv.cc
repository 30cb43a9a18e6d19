#include "vision/rig/from_opencv.h"

#include <opencv2/core.hpp>

#include <cmath>
#include <cstdio>
#include <string>

static const int coefficients = 5; /* k1, k2, p1, p2, k3: more are of a model that we have not */
static const double baseline_most = 2; /* m */

/* The named matrix in doubles, empty where no file has it. */
static cv::Mat read(const char *const *paths, int n_paths, const char *name)
{
    cv::Mat found;

    for (int i = 0; i < n_paths; i++) {
        cv::FileStorage file;
        try {
            if (file.open(paths[i], cv::FileStorage::READ) && !file[name].empty())
                file[name] >> found;
        } catch (const cv::Exception &) {
            found.release();
        }
    }
    if (!found.empty())
        found.convertTo(found, CV_64F);
    return found;
}

static bool take_eye(const cv::Mat &matrix, const cv::Mat &distortion, camera *eye)
{
    double d[coefficients] = {0, 0, 0, 0, 0};

    for (int i = 0; i < static_cast<int>(distortion.total()); i++) {
        const double value = distortion.at<double>(i);
        if (i < coefficients)
            d[i] = value;
        else if (value != 0)
            return false;
    }
    eye->focal = matrix.at<double>(0, 0);
    eye->aspect = matrix.at<double>(1, 1) / eye->focal;
    eye->centre_u = matrix.at<double>(0, 2) - (eye->width - 1) / 2.0;
    eye->centre_v = matrix.at<double>(1, 2) - (eye->height - 1) / 2.0;
    eye->k1 = d[0];
    eye->k2 = d[1];
    eye->p1 = d[2];
    eye->p2 = d[3];
    eye->k3 = d[4];
    return true;
}

/* Into yaw, pitch and roll as in camera_upright; the yaw is that from the common frame. */
static void take_turn(const cv::Matx33d &to_common, camera *eye)
{
    eye->pitch = std::asin(to_common(1, 2));
    eye->roll = std::atan2(to_common(1, 0), to_common(1, 1));
    eye->yaw = std::atan2(to_common(0, 2), to_common(2, 2));
}

/* The common frame has its x along the baseline, and looks where the eyes look on the average. */
static void take_turns(const cv::Matx33d &rotation, const cv::Vec3d &translation, stereo_rig *rig)
{
    const cv::Vec3d x = cv::normalize(rotation.t() * -translation);
    const cv::Vec3d ahead = cv::Vec3d(0, 0, 1) + rotation.t() * cv::Vec3d(0, 0, 1);
    const cv::Vec3d z = cv::normalize(ahead - x * ahead.dot(x));
    const cv::Vec3d y = z.cross(x);
    const cv::Matx33d common(x[0], x[1], x[2], y[0], y[1], y[2], z[0], z[1], z[2]);

    take_turn(common, &rig->left);
    take_turn(common * rotation.t(), &rig->right);
    rig->vergence = rig->left.yaw - rig->right.yaw;
    rig->left.yaw = rig->right.yaw = (rig->left.yaw + rig->right.yaw) / 2;
    rig->baseline = cv::norm(translation);
}

int rig_from_opencv(const char *const *paths, int n_paths, stereo_rig *rig, char *error,
                    size_t error_size)
{
    static const char *const names[] = {"M1", "D1", "M2", "D2", "R", "T"};
    cv::Mat m[6];

    for (int i = 0; i < 6; i++) {
        m[i] = read(paths, n_paths, names[i]);
        if (m[i].total() == (i == 1 || i == 3 ? m[i].total() : i == 5 ? 3 : 9) && !m[i].empty())
            continue;
        snprintf(error, error_size, "%s: no matrix %s as OpenCV's stereo calibration writes it",
                 paths[n_paths - 1], names[i]);
        return -1;
    }
    if (!take_eye(m[0], m[1], &rig->left) || !take_eye(m[2], m[3], &rig->right)) {
        snprintf(error, error_size,
                 "more than five coefficients of distortion: calibrate without "
                 "CALIB_RATIONAL_MODEL");
        return -1;
    }
    take_turns(cv::Matx33d(m[4].ptr<double>()), cv::Vec3d(m[5].ptr<double>()), rig);
    if (rig->baseline > 0 && rig->baseline <= baseline_most)
        return 0;
    snprintf(error, error_size,
             "T is %g long: give the chessboard's squares in metres when you calibrate",
             rig->baseline);
    return -1;
}
