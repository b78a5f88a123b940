// Reads and writes picture files. Reading checks size and format first; writing is atomic (temporary name,
// then rename).
#pragma once
#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>

namespace base {

/// Reads PNG, JPEG, WebP, BMP or TIFF as 8-bit sRGB, upright (EXIF orientation applied), alpha dropped.
/// Throws InputError for a missing, truncated, malformed or too large (> 16384 px a side) file. Never prints.
cv::Mat3b read_rgb(const std::filesystem::path& path);
/// Reads any picture as a mask: 255 where luminance (times alpha, if any) is above one half, else 0.
cv::Mat1b read_mask(const std::filesystem::path& path);

void write_png(const std::filesystem::path& path, const cv::Mat3b& rgb);
void write_png(const std::filesystem::path& path, const cv::Mat4b& rgba);
void write_png(const std::filesystem::path& path, const cv::Mat1b& gray);
enum class ExrDepth : std::uint8_t
{
    Half,
    Float,
};
/// Linear RGB, or linear RGBA premultiplied by alpha (the convention of OpenEXR).
void write_exr(const std::filesystem::path& path, const cv::Mat3f& rgb, ExrDepth depth = ExrDepth::Float);
void write_exr(const std::filesystem::path& path, const cv::Mat4f& rgba, ExrDepth depth = ExrDepth::Float);
/// One channel, "Y", of any quantity, as 32-bit float.
void write_exr(const std::filesystem::path& path, const cv::Mat1f& values);

} // namespace base
