/* The published mixture as the formulas stand: raw sums, a direct inverse whenever one is needed,
 * every expert in every step. Slow and plain; the daemon's learner is judged by it. It shares no
 * code with the daemon. */
#ifndef REACH_TEXTBOOK_IMLE_H
#define REACH_TEXTBOOK_IMLE_H

#include <Eigen/Dense>
#include <vector>

namespace oracle
{

struct Parameters {
    int d = 1;
    int D = 1;
    Eigen::VectorXd psi0;   /* variances */
    Eigen::VectorXd sigma0; /* variances */
    double alpha = 0.999;
    double w_sigma = 2; /* hyper-prior on Sigma_bar */
    double w_psi = 2;   /* hyper-prior on Psi_bar; may be infinite */
    double w_Sigma = 2; /* each expert's */
    double w_nu = 0;    /* each expert's */
    double w_Psi = 2;   /* each expert's; may be infinite */
    double w_Lambda = 0.1;
    double floor = 0.01; /* least share of w_Sigma, w_nu and w_Psi; w_Sigma never under d */
    double skip = 0;     /* an expert that takes no more than this of a sample has no M-step */
    int n_outliers = 1;
    double p0 = 0.1;
    double significance = 0.99;
    int n_solutions_max = 16;
    int em_pred_iterations = 2;
};

enum class Result { updated, born, outlier };

struct Solution {
    Eigen::VectorXd value;
    Eigen::VectorXd variance;
    double weight;
    Eigen::MatrixXd jacobian; /* exact derivative */
};

class TextbookImle
{
public:
    explicit TextbookImle(const Parameters &parameters);

    Result update(const Eigen::VectorXd &z, const Eigen::VectorXd &x);
    /* Strongest first. */
    std::vector<Solution> predict(const Eigen::VectorXd &z) const;
    Solution predict_single(const Eigen::VectorXd &z) const;
    int experts() const
    {
        return static_cast<int>(experts_.size());
    }

private:
    struct Expert {
        double H, S_h;
        double w_nu, w_Sigma, w_Lambda, w_Psi;
        Eigen::VectorXd S_z, S_x, S_xx;
        Eigen::MatrixXd S_xz, S_zz;
        Eigen::VectorXd nu_0, sigma_birth;
        Eigen::VectorXd nu, mu, Psi;
        Eigen::MatrixXd Lambda, Sigma;
    };
    /* One expert's answer to a query. */
    struct Answer {
        double t, gamma, phi;
        Eigen::VectorXd x;
        Eigen::VectorXd kappa, dgamma;
    };
    struct Cluster {
        std::vector<int> members;
        Eigen::VectorXd center;
    };

    Expert newborn(const Eigen::VectorXd &z, const Eigen::VectorXd &x) const;
    void learn(Expert &e, double h, const Eigen::VectorXd &z, const Eigen::VectorXd &x) const;
    void m_step(Expert &e) const;
    void update_priors();
    double responsibility(const Expert &e, const Eigen::VectorXd &z,
                          const Eigen::VectorXd &x) const;
    Eigen::MatrixXd inverse_C(const Expert &e) const;
    double sigma_divisor(const Expert &e) const;
    Answer answer(const Expert &e, const Eigen::VectorXd &z) const;
    double joint_density(const Expert &e, const Eigen::VectorXd &z, const Eigen::VectorXd &x) const;
    double outlier_input() const;
    double outlier_joint() const;
    Solution fuse(const std::vector<Answer> &answers, const std::vector<int> &members) const;
    std::vector<Cluster> cluster(const std::vector<Answer> &answers) const;
    Eigen::VectorXd precision(const Answer &a, int expert) const;
    Eigen::VectorXd center(const std::vector<Answer> &all, const Eigen::VectorXd &probability,
                           const Eigen::VectorXd &otherwise) const;
    double level(const std::vector<Answer> &all, const Cluster &cluster) const;
    int farthest(const std::vector<Answer> &all, const Cluster &cluster,
                 const Eigen::VectorXd &x) const;
    void em_iteration(const std::vector<Answer> &all, std::vector<Cluster> &clusters) const;
    void assign(const std::vector<Answer> &all, std::vector<Cluster> &clusters) const;
    std::vector<Answer> answers(const Eigen::VectorXd &z) const;
    double deviation(const Answer &a, int expert, const Eigen::VectorXd &center) const;

    Parameters p_;
    std::vector<Expert> experts_;
    Eigen::VectorXd sigma_bar_, psi_bar_;
    int outliers_in_row_ = 0;
};

} /* namespace oracle */

#endif
