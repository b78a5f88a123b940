// Pictures in and out of files. Reading checks size and format at the door; writing is atomic (temporary
// name, then rename).
#pragma once
#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>

namespace base {

/// PNG or JPEG (and whatever else OpenCV reads) as 8-bit sRGB, upright (EXIF orientation applied). Alpha is
/// dropped. Throws InputError for a missing, truncated, malformed or absurdly large (> 16384 px a
/// side) file. Never prints.
cv::Mat3b read_rgb(const std::filesystem::path& path);
/// A mask: any picture; 255 where luminance (times alpha, when there is alpha) is above one half, else 0.
cv::Mat1b read_mask(const std::filesystem::path& path);

void write_png(const std::filesystem::path& path, const cv::Mat3b& rgb);
void write_png(const std::filesystem::path& path, const cv::Mat4b& rgba);
void write_png(const std::filesystem::path& path, const cv::Mat1b& gray);
/// Linear light: RGB, or RGB premultiplied by alpha and alpha (the convention of OpenEXR).
enum class ExrDepth : std::uint8_t
{
    Half,
    Float,
};
void write_exr(const std::filesystem::path& path, const cv::Mat3f& rgb, ExrDepth depth = ExrDepth::Float);
void write_exr(const std::filesystem::path& path, const cv::Mat4f& rgba, ExrDepth depth = ExrDepth::Float);
/// One channel, "Y", of any quantity, 32-bit float.
void write_exr(const std::filesystem::path& path, const cv::Mat1f& values);

} // namespace base
