// Pictures in and out of files. Reading checks size and format at the door; writing is atomic (temporary
// name, then rename).
#pragma once
#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <system_error>
#include <utility>

namespace engine {

/// PNG or JPEG (and whatever else OpenCV reads) as 8-bit sRGB, upright (EXIF orientation applied). Alpha is
/// dropped. Throws cicatrix::InputError for a missing, truncated, malformed or absurdly large (> 16384 px a
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

/// The two halves of write_atomically that need no template.
std::filesystem::path temporary_beside(const std::filesystem::path& path);
void rename_over(const std::filesystem::path& temporary, const std::filesystem::path& path);

/// Runs `write(temporary)` and renames the temporary to `path`; on any failure the temporary is gone and
/// `path` is as it was. `write` takes the temporary's path, which lies beside `path`. Failures to write or
/// rename are cicatrix::InputError.
template <typename Write>
void write_atomically(const std::filesystem::path& path, Write&& write)
{
    const std::filesystem::path temporary = temporary_beside(path);
    try {
        std::forward<Write>(write)(temporary);
        rename_over(temporary, path);
    } catch (...) {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        throw;
    }
}

} // namespace engine
