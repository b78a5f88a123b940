// Decodes and encodes pictures in memory, for read_rgb, write_png and glTF files.
#pragma once
#include <cstdint>
#include <opencv2/core.hpp>
#include <span>
#include <string_view>
#include <vector>

namespace base {

/// The channels of a decoded picture.
enum class Channels : std::uint8_t
{
    Opaque,   // three channels, upright (EXIF orientation applied), alpha dropped
    AsStored, // one, three or four channels, EXIF orientation ignored
};

/// Decodes PNG, JPEG, WebP, BMP or TIFF to 8 bits a channel in OpenCV's order (BGR, BGRA). Throws
/// InputError at `where` for truncated, malformed, unknown or too large (> 16384 px a side) pictures.
/// Prints nothing: the process's stderr goes to /dev/null while it runs, because the codecs print there.
cv::Mat decode_picture(std::span<const std::uint8_t> bytes, Channels channels, std::string_view where);

/// PNG of an 8-bit picture in OpenCV's order.
std::vector<std::uint8_t> encode_png(const cv::Mat& picture);
/// JPEG of an 8-bit picture in OpenCV's order; quality 0..100.
std::vector<std::uint8_t> encode_jpeg(const cv::Mat& picture, int quality);

} // namespace base
