#include "wound/membrane.hpp"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace wound {
namespace {

constexpr int coarsest = 4, sweeps = 14;
constexpr float overshoot = 1.5f; // successive over-relaxation; 1 is plain Gauss-Seidel

/// One sweep in place, with Neumann boundary conditions.
void relax(cv::Mat3f& m, const cv::Mat3f& data, const cv::Mat1f& weight)
{
    const int n = m.rows;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            cv::Vec3f sum = data(y, x) * weight(y, x);
            float total = weight(y, x);
            const auto pull = [&](int i, int j) { sum += m(j, i), total += 1; };
            if (x > 0)
                pull(x - 1, y);
            if (x + 1 < n)
                pull(x + 1, y);
            if (y > 0)
                pull(x, y - 1);
            if (y + 1 < n)
                pull(x, y + 1);
            m(y, x) += (sum * (1 / total) - m(y, x)) * overshoot;
        }
}

cv::Vec3f weighted_mean(const cv::Mat3f& data, const cv::Mat1f& weight)
{
    cv::Vec3f sum = cv::Vec3f::all(0);
    float total = 0;
    for (int y = 0; y < data.rows; ++y)
        for (int x = 0; x < data.cols; ++x) {
            sum += data(y, x) * weight(y, x);
            total += weight(y, x);
        }
    return total > 1e-9f ? sum * (1 / total) : cv::Vec3f::all(0); // a denormal's reciprocal is infinite
}

} // namespace

cv::Mat3f membrane(const cv::Mat3f& data, const cv::Mat1f& weight)
{
    const int n = data.rows;
    cv::Mat3f m;
    if (n <= coarsest)
        m = cv::Mat3f(n, n, weighted_mean(data, weight));
    else {
        // Halving the grid leaves the gradient term unchanged and sums the weights of four cells.
        cv::Mat3f half_data(n / 2, n / 2);
        cv::Mat1f half_weight(n / 2, n / 2);
        for (int y = 0; y < n / 2; ++y)
            for (int x = 0; x < n / 2; ++x) {
                const cv::Rect four(2 * x, 2 * y, 2, 2);
                half_data(y, x) = weighted_mean(data(four), weight(four));
                half_weight(y, x) = float(cv::sum(weight(four))[0]);
            }
        cv::resize(membrane(half_data, half_weight), m, data.size(), 0, 0, cv::INTER_LINEAR);
    }
    for (int sweep = 0; sweep < sweeps; ++sweep)
        relax(m, data, weight);
    return m;
}

} // namespace wound
