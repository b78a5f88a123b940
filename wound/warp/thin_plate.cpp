#include "wound/warp/thin_plate.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace wound {

namespace {

constexpr int anchors_per_side = 16; // the frame between two anchors moves by less than half a texel of 512

/// r^2 log r^2, twice the thin-plate kernel, from the squared distance; 1e-300 makes it 0 at 0.
double kernel(double squared)
{
    return squared * std::log(squared + 1e-300);
}

std::vector<cv::Point2d> frame_anchors()
{
    std::vector<cv::Point2d> anchors;
    for (int i = 0; i < anchors_per_side; ++i) {
        const double t = -1 + 2. * i / anchors_per_side;
        anchors.insert(anchors.end(), {{t, -1}, {1, t}, {-t, 1}, {-1, -t}});
    }
    return anchors;
}

} // namespace

cv::Point2d ThinPlate::apply(cv::Point2d p) const
{
    // x and y are interleaved: map the points as two rows, so that Eigen vectorises the kernel.
    using Points = Eigen::Map<const Eigen::Array<double, 2, Eigen::Dynamic>>;
    const auto count = static_cast<Eigen::Index>(centers.size());
    const Points c(&centers.data()->x, 2, count);
    const Points w(&weights.data()->x, 2, count);
    const Eigen::ArrayXd squared = (c.row(0) - p.x).square() + (c.row(1) - p.y).square();
    const Eigen::ArrayXd phi = squared * (squared + 1e-300).log();
    return p + affine[0] + affine[1] * p.x + affine[2] * p.y +
           cv::Point2d((w.row(0).transpose() * phi).sum(), (w.row(1).transpose() * phi).sum());
}

void apply_in_place(const ThinPlate& step, std::vector<float>& x, std::vector<float>& y)
{
    const auto count = static_cast<Eigen::Index>(x.size());
    Eigen::Map<Eigen::ArrayXf> px(x.data(), count);
    Eigen::Map<Eigen::ArrayXf> py(y.data(), count);
    const auto affine = [&](auto component) -> Eigen::ArrayXf {
        return static_cast<float>(step.affine[0].*component) +
               static_cast<float>(step.affine[1].*component) * px +
               static_cast<float>(step.affine[2].*component) * py;
    };
    Eigen::ArrayXf moved_x = affine(&cv::Point2d::x);
    Eigen::ArrayXf moved_y = affine(&cv::Point2d::y);
    Eigen::ArrayXf squared(count);
    for (std::size_t i = 0; i < step.centers.size(); ++i) {
        squared = (px - static_cast<float>(step.centers[i].x)).square() +
                  (py - static_cast<float>(step.centers[i].y)).square();
        squared *= (squared + 1e-30F).log();
        moved_x += static_cast<float>(step.weights[i].x) * squared;
        moved_y += static_cast<float>(step.weights[i].y) * squared;
    }
    px += moved_x;
    py += moved_y;
}

ThinPlate contraction_step(const std::vector<cv::Point2d>& control_points, cv::Point2d centroid, double from,
                           double to)
{
    ThinPlate step;
    std::vector<cv::Point2d> moves; // backward displacements
    for (cv::Point2d control : control_points) {
        step.centers.push_back(centroid + from * (control - centroid));
        moves.push_back((to - from) * (control - centroid));
    }
    for (cv::Point2d anchor : frame_anchors()) {
        step.centers.push_back(anchor);
        moves.emplace_back(0, 0);
    }
    const auto n = static_cast<Eigen::Index>(step.centers.size());
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 3, n + 3);
    Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(n + 3, 2);
    for (Eigen::Index i = 0; i < n; ++i) {
        const cv::Point2d p = step.centers[i];
        for (Eigen::Index j = 0; j < i; ++j) {
            const cv::Point2d offset = p - step.centers[j];
            system(i, j) = system(j, i) = kernel(offset.dot(offset));
        }
        const Eigen::Vector3d polynomial(1, p.x, p.y);
        system.block<1, 3>(i, n) = polynomial.transpose();
        system.block<3, 1>(n, i) = polynomial;
        right.row(i) << moves[i].x, moves[i].y;
    }
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(system);
    if (!factors.isInvertible())
        throw std::runtime_error("thin-plate system is singular: control points coincide or lie on one line");
    const Eigen::MatrixX2d solution = factors.solve(right);
    for (Eigen::Index i = 0; i < n; ++i)
        step.weights.emplace_back(solution(i, 0), solution(i, 1));
    for (int k = 0; k < 3; ++k)
        step.affine[k] = {solution(n + k, 0), solution(n + k, 1)};
    return step;
}

} // namespace wound
