#include "base/flip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "base/color.hpp"

namespace base {
namespace {

using std::numbers::pi;

// All filters of FLIP are products of a function of x and one of y, or sums of such products.
cv::Mat1d filtered(const cv::Mat1d& image, const cv::Mat1d& along_x, const cv::Mat1d& along_y)
{
    cv::Mat1d result;
    cv::sepFilter2D(image, result, CV_64F, along_x, along_y, {-1, -1}, 0, cv::BORDER_REPLICATE);
    return result;
}

// The values of `function` at -radius, ..., radius.
template <class Function>
cv::Mat1d sampled(int radius, const Function& function)
{
    cv::Mat1d kernel(2 * radius + 1, 1);
    for (int i = 0; i < kernel.rows; ++i)
        kernel(i) = function(static_cast<double>(i - radius));
    return kernel;
}

// ---- Colour ---------------------------------------------------------------------------------------------

// The eye's contrast sensitivity at f cycles per degree is a sum of terms a exp(-b f^2).
struct SensitivityTerm
{
    double a, b; // b in square degrees
};
using Sensitivity = std::vector<SensitivityTerm>;

const std::array<Sensitivity, 3> sensitivities{
    Sensitivity{{.a = 1, .b = 0.0047}},                          // achromatic
    Sensitivity{{.a = 1, .b = 0.0053}},                          // red-green
    Sensitivity{{.a = 34.1, .b = 0.04}, {.a = 13.5, .b = 0.025}} // blue-yellow
};
constexpr double widest_b = 0.04;

// Y, X - Y and Y - Z relative to white. This is YCxCz without its offset and factors, which do not matter to
// filters that sum to 1.
cv::Matx33d opponent_from_linear()
{
    return cv::Matx33d(0, 1, 0, 1, -1, 0, 0, 1, -1) * relative_xyz_from_linear();
}

std::vector<cv::Mat1d> opponent_channels(const cv::Mat3b& srgb)
{
    cv::Mat3d linear;
    linear_from_srgb(srgb).convertTo(linear, CV_64F);
    cv::transform(linear, linear, opponent_from_linear());
    std::vector<cv::Mat1d> channels;
    cv::split(linear, channels);
    return channels;
}

// Blurs a channel as the eye does. A term of the sensitivity becomes a sqrt(pi/b) exp(-(pi x)^2 / b) at x
// degrees; the paper keeps the factor sqrt(pi/b) of one dimension in two.
cv::Mat1d blurred(const cv::Mat1d& channel, const Sensitivity& sensitivity, double pixels_per_degree)
{
    const int radius = static_cast<int>(std::ceil(3 * std::sqrt(widest_b / 2) / pi * pixels_per_degree));
    cv::Mat1d sum = cv::Mat1d::zeros(channel.size());
    double total = 0;
    for (const auto& [a, b] : sensitivity) {
        const double rate = pi * pi / (b * pixels_per_degree * pixels_per_degree);
        const cv::Mat1d gauss = sampled(radius, [&](double x) { return std::exp(-rate * x * x); });
        const double factor = a * std::sqrt(pi / b), gauss_sum = cv::sum(gauss)[0];
        sum += factor * filtered(channel, gauss, gauss);
        total += factor * gauss_sum * gauss_sum;
    }
    return sum / total;
}

// Hunt: a colour looks less colourful when it is darker.
cv::Vec3f hunt_adjusted(const cv::Vec3f& lab)
{
    return {lab[0], lab[1] * lab[0] / 100, lab[2] * lab[0] / 100};
}

// CIELAB with Hunt's adjustment of what the eye resolves.
cv::Mat3f seen_colors(const std::vector<cv::Mat1d>& opponent, double pixels_per_degree)
{
    std::array<cv::Mat, 3> channels;
    for (int i = 0; i < 3; ++i)
        channels[i] = blurred(opponent[i], sensitivities[i], pixels_per_degree);
    cv::Mat3d linear;
    cv::merge(channels, linear);
    cv::transform(linear, linear, opponent_from_linear().inv());
    cv::Mat3f lab = lab_from_linear(cv::Mat3f(linear)); // clamps to 0..1
    std::transform(lab.begin(), lab.end(), lab.begin(), hunt_adjusted);
    return lab;
}

// HyAB distance to the power q_c = 0.7.
double color_distance(const cv::Vec3f& x, const cv::Vec3f& y)
{
    return std::pow(std::abs(x[0] - y[0]) + std::hypot(x[1] - y[1], x[2] - y[2]), 0.7);
}

// Green to blue, the largest distance in sRGB.
double largest_color_distance()
{
    const auto hunt_lab = [](const Color& linear) {
        const Lab lab = lab_from_linear(linear);
        return hunt_adjusted(cv::Vec3d(lab.l, lab.a, lab.b));
    };
    return color_distance(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1}));
}

// Distances below 0.4 (p_c) of the largest take the errors up to 0.95 (p_t): beyond, all look wrong.
double color_error(double distance, double largest)
{
    const double knee = 0.4 * largest;
    if (distance < knee)
        return 0.95 * distance / knee;
    return std::min(0.95 + 0.05 * (distance - knee) / (largest - knee), 1.);
}

// ---- Features: edges and points -------------------------------------------------------------------------

// Scales the positive values to sum to 1 and the negative ones to -1.
cv::Mat1d balanced(cv::Mat1d kernel)
{
    double positive = 0, negative = 0;
    for (const double value : kernel)
        (value > 0 ? positive : negative) += std::abs(value);
    for (double& value : kernel)
        value /= value > 0 ? positive : negative;
    return kernel;
}

// A Gaussian that sums to 1 and its first (edge) and second (point) derivative, balanced.
struct FeatureKernels
{
    cv::Mat1d gauss, edge, point;
};

FeatureKernels feature_kernels(double pixels_per_degree)
{
    constexpr double width_deg = 0.082; // of a detector in human vision, from peak to trough
    const double deviation = width_deg / 2 * pixels_per_degree;
    const int radius = static_cast<int>(std::ceil(3 * deviation));
    const auto kernel = [&](const auto& factor) {
        return sampled(radius, [&](double x) {
            const double t = x / deviation;
            return factor(t) * std::exp(-t * t / 2);
        });
    };
    const cv::Mat1d gauss = kernel([](double) { return 1.; });
    return {.gauss = gauss / cv::sum(gauss)[0],
            .edge = balanced(kernel([](double t) { return -t; })),
            .point = balanced(kernel([](double t) { return t * t - 1; }))};
}

// Length of the vector of the responses along x and y.
cv::Mat1d response(const cv::Mat1d& luminance, const cv::Mat1d& detector, const cv::Mat1d& gauss)
{
    cv::Mat1d length;
    cv::magnitude(filtered(luminance, detector, gauss), filtered(luminance, gauss, detector), length);
    return length;
}

// 0..1: the larger difference of the responses of edges and points, to the power q_f = 0.5.
cv::Mat1d feature_error(const cv::Mat1d& reference, const cv::Mat1d& test, double pixels_per_degree)
{
    const auto [gauss, edge, point] = feature_kernels(pixels_per_degree);
    cv::Mat edges, points, error; // not Mat1d, for which cv::max is std::max
    cv::absdiff(response(reference, edge, gauss), response(test, edge, gauss), edges);
    cv::absdiff(response(reference, point, gauss), response(test, point, gauss), points);
    cv::max(edges, points, error);
    cv::sqrt(error / std::numbers::sqrt2, error);
    return error;
}

} // namespace

cv::Mat1f flip(const cv::Mat3b& reference, const cv::Mat3b& test, double pixels_per_degree)
{
    CV_Assert(!reference.empty() && reference.size() == test.size() && pixels_per_degree >= 1);
    const auto reference_channels = opponent_channels(reference), test_channels = opponent_channels(test);
    const cv::Mat3f reference_colors = seen_colors(reference_channels, pixels_per_degree);
    const cv::Mat3f test_colors = seen_colors(test_channels, pixels_per_degree);
    const cv::Mat1d features = feature_error(reference_channels[0], test_channels[0], pixels_per_degree);

    const double largest = largest_color_distance();
    cv::Mat1f error(reference.size());
    for (int y = 0; y < error.rows; ++y)
        for (int x = 0; x < error.cols; ++x) {
            const double color =
                color_error(color_distance(reference_colors(y, x), test_colors(y, x)), largest);
            error(y, x) = static_cast<float>(std::pow(color, 1 - features(y, x)));
        }
    return error;
}

} // namespace base
