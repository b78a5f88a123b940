// A path-traced picture as it grows: sums per pixel, and what follows from them - means, their standard
// errors, and how much noise an eye would still see.
#pragma once
#include <array>
#include <cstdint>
#include <opencv2/core.hpp>

#include "reference/path_tracer.hpp"

namespace reference {

/// Sums over the samples of a pixel, single precision: what is kept in files is what goes on being summed, so
/// that an interrupted picture ends bit for bit as one that was not.
struct PixelSums
{
    cv::Vec3f diffuse, diffuse_squares, specular, specular_squares;
    cv::Vec3f first_half; // of diffuse and specular together: every other pass, from the first
    float alpha = 0;
};

/// Samples come in passes of this many per pixel.
inline constexpr std::uint32_t samples_per_pass = 4;

class Picture
{
  public:
    Picture() = default;
    explicit Picture(cv::Size size) : size_(size), sums_(std::size_t(size.area())) {}

    cv::Size size() const { return size_; }
    std::uint32_t samples() const { return passes_ * samples_per_pass; } // per pixel
    PixelSums& sums(int x, int y)
    {
        return sums_[std::size_t(y) * std::size_t(size_.width) + std::size_t(x)];
    }
    const PixelSums& sums(int x, int y) const { return const_cast<Picture*>(this)->sums(x, y); }

    std::uint32_t passes() const { return passes_; }
    void set_passes(std::uint32_t passes) { passes_ = passes; }

    /// Linear, premultiplied.
    cv::Mat3f diffuse() const { return mean(&PixelSums::diffuse); }
    cv::Mat3f specular() const { return mean(&PixelSums::specular); }
    cv::Mat4f radiance() const; // both, and alpha
    /// Of the means, from the spread of the samples.
    cv::Mat3f diffuse_error() const { return error(&PixelSums::diffuse, &PixelSums::diffuse_squares); }
    cv::Mat3f specular_error() const { return error(&PixelSums::specular, &PixelSums::specular_squares); }

    /// Expected CIEDE2000 between two such pictures, encoded, per pixel; 0 where no head is seen. Estimated
    /// from the two halves of the samples. Needs two passes.
    cv::Mat1f noise_map(double exposure_stops) const;
    /// Its mean where the head is; infinite before two passes, 0 where no head is seen.
    double noise_de(double exposure_stops) const;

  private:
    cv::Mat3f mean(cv::Vec3f PixelSums::*sum) const;
    cv::Mat3f error(cv::Vec3f PixelSums::*sum, cv::Vec3f PixelSums::*squares) const;

    cv::Size size_;
    std::uint32_t passes_ = 0;
    std::vector<PixelSums> sums_;
};

} // namespace reference
