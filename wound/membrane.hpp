// Fits a smooth surface to scattered, uncertain data, as Poisson cloning does across a patch.
#pragma once
#include <opencv2/core.hpp>

namespace wound {

/// Minimises  sum weight (m - data)^2 + sum |grad m|^2  over a square grid whose side is a power of two: m
/// follows the data where weights are large and is harmonic where they are 0 (Perez, Gangnet, Blake 2003;
/// screened as in Bhat et al. 2008). Solved by over-relaxation from coarse to fine. m is 0 if all weights
/// are.
cv::Mat3f membrane(const cv::Mat3f& data, const cv::Mat1f& weight);

} // namespace wound
