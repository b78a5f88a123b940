#include "base/flip.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "base/color.hpp"

namespace {

const cv::Vec3b black(0, 0, 0), white(255, 255, 255), green(0, 255, 0), blue(0, 0, 255);

cv::Mat3b uniform(const cv::Vec3b& color)
{
    return cv::Mat3b(24, 32, color);
}

cv::Mat3b noise(int seed, int low = 0, int high = 256)
{
    cv::Mat3b image(30, 41);
    cv::RNG(seed).fill(image, cv::RNG::UNIFORM, low, high);
    return image;
}

double mean(const cv::Mat1f& error)
{
    return cv::mean(error)[0];
}

// ---- FLIP of one pixel as the paper writes it, in double and with whole two-dimensional kernels ----------

struct Pixel
{
    const cv::Mat3b& image;
    int x, y;
};

cv::Vec3d ycxcz(const cv::Vec3b& srgb)
{
    const cv::Matx33d xyz_from_rgb(0.4124564, 0.3575761, 0.1804375, 0.2126729, 0.7151522, 0.0721750,
                                   0.0193339, 0.1191920, 0.9503041);
    const cv::Vec3d xyz = xyz_from_rgb * base::linear_from_srgb8(srgb);
    const cv::Vec3d white_xyz = xyz_from_rgb * cv::Vec3d(1, 1, 1);
    const double x = xyz[0] / white_xyz[0], y = xyz[1] / white_xyz[1], z = xyz[2] / white_xyz[2];
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

cv::Vec3d linear_from_ycxcz(const cv::Vec3d& color)
{
    cv::Matx33d from_rgb; // the columns are red, green and blue, relative to black
    const cv::Vec3d zero = ycxcz(black);
    for (int i = 0; i < 3; ++i) {
        cv::Vec3b primary = black;
        primary[i] = 255;
        for (int row = 0; row < 3; ++row)
            from_rgb(row, i) = (ycxcz(primary) - zero)[row];
    }
    return from_rgb.inv() * (color - zero);
}

// The sum over the window of weight(x, y) * ycxcz, borders replicated.
template <class Weight>
cv::Vec3d window_sum(const Pixel& at, int radius, const Weight& weight)
{
    cv::Vec3d sum;
    for (int dy = -radius; dy <= radius; ++dy)
        for (int dx = -radius; dx <= radius; ++dx) {
            const int x = std::clamp(at.x + dx, 0, at.image.cols - 1);
            const int y = std::clamp(at.y + dy, 0, at.image.rows - 1);
            sum += cv::Vec3d(weight(dx, dy)).mul(ycxcz(at.image(y, x)));
        }
    return sum;
}

cv::Vec3d hunt_lab(cv::Vec3d linear)
{
    for (double& channel : linear.val)
        channel = std::clamp(channel, 0., 1.);
    const base::Lab lab = base::lab_from_linear(linear);
    return {lab.l, 0.01 * lab.l * lab.a, 0.01 * lab.l * lab.b};
}

cv::Vec3d seen(const Pixel& at, double ppd)
{
    const double pi = std::numbers::pi;
    const double a1[] = {1, 1, 34.1}, b1[] = {0.0047, 0.0053, 0.04};
    const double a2[] = {0, 0, 13.5}, b2[] = {1e-5, 1e-5, 0.025};
    const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * ppd));
    const auto weight = [&](int x, int y) {
        const double d2 = (x * x + y * y) / (ppd * ppd);
        cv::Vec3d w;
        for (int i = 0; i < 3; ++i)
            w[i] = a1[i] * std::sqrt(pi / b1[i]) * std::exp(-pi * pi * d2 / b1[i]) +
                   a2[i] * std::sqrt(pi / b2[i]) * std::exp(-pi * pi * d2 / b2[i]);
        return w;
    };
    cv::Vec3d total;
    for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x)
            total += weight(x, y);
    cv::Vec3d color = window_sum(at, radius, weight);
    for (int i = 0; i < 3; ++i)
        color[i] /= total[i];
    return hunt_lab(linear_from_ycxcz(color));
}

double color_error(const cv::Vec3d& x, const cv::Vec3d& y)
{
    const auto distance = [](const cv::Vec3d& d) {
        return std::pow(std::abs(d[0]) + std::hypot(d[1], d[2]), 0.7);
    };
    const double found = distance(x - y), largest = distance(hunt_lab({0, 1, 0}) - hunt_lab({0, 0, 1}));
    const double knee = 0.4 * largest;
    return found < knee ? 0.95 / knee * found : 0.95 + (found - knee) / (largest - knee) * 0.05;
}

double response(const Pixel& at, double ppd, bool edge)
{
    const double deviation = 0.5 * 0.082 * ppd;
    const int radius = static_cast<int>(std::ceil(3 * deviation));
    const auto derivative = [&](int x, int y) {
        const double g = std::exp(-(x * x + y * y) / (2 * deviation * deviation));
        return edge ? -x * g : (x * x / (deviation * deviation) - 1) * g;
    };
    double positive = 0, negative = 0;
    for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x)
            (derivative(x, y) > 0 ? positive : negative) += std::abs(derivative(x, y));
    const auto weight = [&](int x, int y) {
        const double d = derivative(x, y);
        return cv::Vec3d::all(d / (d > 0 ? positive : negative) / 116);
    };
    const double along_x = window_sum(at, radius, weight)[0];
    const double along_y = window_sum(at, radius, [&](int x, int y) { return weight(y, x); })[0];
    return std::hypot(along_x, along_y);
}

double flip_of_pixel(const Pixel& reference, const Pixel& test, double ppd)
{
    const double edges = std::abs(response(reference, ppd, true) - response(test, ppd, true));
    const double points = std::abs(response(reference, ppd, false) - response(test, ppd, false));
    const double features = std::sqrt(std::max(edges, points) / std::sqrt(2));
    return std::pow(color_error(seen(reference, ppd), seen(test, ppd)), 1 - features);
}

void expect_paper(const cv::Mat3b& reference, const cv::Mat3b& test, double ppd)
{
    const cv::Mat1f found = base::flip(reference, test, ppd);
    for (const cv::Point at : {cv::Point(0, 0), cv::Point(20, 15), cv::Point(40, 12), cv::Point(7, 29)})
        EXPECT_NEAR(found(at), flip_of_pixel({reference, at.x, at.y}, {test, at.x, at.y}, ppd), 1e-5)
            << at << " at " << ppd << " pixels per degree";
}

} // namespace

TEST(Flip, PixelsPerDegreeOfThePapersViewer)
{
    EXPECT_NEAR(base::usual_pixels_per_degree, 67.02, 0.01);
    EXPECT_DOUBLE_EQ(base::pixels_per_degree(1.4, 3840, 0.7), 2 * base::usual_pixels_per_degree);
}

TEST(Flip, IdenticalPicturesHaveNoError)
{
    EXPECT_EQ(cv::norm(base::flip(noise(1), noise(1)), cv::NORM_INF), 0);
    EXPECT_EQ(cv::norm(base::flip(uniform(green), uniform(green)), cv::NORM_INF), 0);
}

TEST(Flip, IsBetween0And1AndSymmetric)
{
    for (const double ppd : {1., 10., 67.}) {
        const cv::Mat1f error = base::flip(noise(1), noise(2), ppd);
        EXPECT_TRUE(cv::checkRange(error, true, nullptr, 0, 1 + 1e-9)) << ppd;
        EXPECT_GT(mean(error), 0.01) << ppd;
        EXPECT_LT(cv::norm(error, base::flip(noise(2), noise(1), ppd), cv::NORM_INF), 1e-6) << ppd;
    }
}

// Black to white is 100^0.7 = 25.12 and green to blue 41.28, so 0.95 + 0.05 (25.12 - 16.51) / (41.28
// - 16.51).
TEST(Flip, BlackAndWhiteAreFarApartAndGreenAndBlueFarthest)
{
    EXPECT_NEAR(mean(base::flip(uniform(black), uniform(white))), 0.967, 0.001);
    EXPECT_NEAR(mean(base::flip(uniform(green), uniform(blue))), 1, 1e-6);
}

TEST(Flip, UniformPicturesHaveTheErrorOfTheirColors)
{
    const cv::Vec3b skin(205, 160, 140), wound(120, 30, 35);
    const double expected =
        color_error(hunt_lab(base::linear_from_srgb8(skin)), hunt_lab(base::linear_from_srgb8(wound)));
    const cv::Mat1f found = base::flip(uniform(skin), uniform(wound));
    EXPECT_LT(cv::norm(found, cv::Mat1f(found.size(), static_cast<float>(expected)), cv::NORM_INF), 1e-5);
    EXPECT_GT(expected, 0.5);
}

TEST(Flip, EqualsThePapersFormulasPixelByPixel)
{
    for (const double ppd : {9., 30., base::usual_pixels_per_degree}) {
        expect_paper(noise(3), noise(4), ppd);
        expect_paper(noise(5, 100, 130), noise(6, 110, 140), ppd);
    }
}

TEST(Flip, AnEdgeRaisesTheErrorAboveThatOfTheColors)
{
    cv::Mat3b half = uniform(cv::Vec3b::all(120));
    half.colRange(16, 32).setTo(cv::Scalar::all(130));
    const cv::Mat1f error = base::flip(uniform(cv::Vec3b::all(125)), half);
    EXPECT_GT(error(12, 18), 1.1 * error(12, 31));
}

TEST(Flip, FineNoiseDisappearsFromFurtherAway)
{
    const cv::Mat3b gray(30, 41, cv::Vec3b::all(125));
    const cv::Mat3b noisy = noise(7, 110, 141);
    const double near = mean(base::flip(gray, noisy, 20)), usual = mean(base::flip(gray, noisy)),
                 far = mean(base::flip(gray, noisy, 200));
    EXPECT_GT(near, 1.2 * usual);
    EXPECT_GT(usual, 1.2 * far);
}

TEST(Flip, ThePicturesMustHaveTheSameSize)
{
    EXPECT_THROW(base::flip(uniform(black), cv::Mat3b(24, 31, black)), cv::Exception);
    EXPECT_THROW(base::flip(cv::Mat3b(), cv::Mat3b()), cv::Exception);
}
