// OpenEXR files with channels of any names, by OpenEXR's own library. Simple pictures: base/image_io.hpp.
#pragma once
#include <cstddef>
#include <filesystem>
#include <map>
#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <vector>

namespace base {

/// Where a channel's values lie in memory; strides in bytes.
struct ExrChannel
{
    std::string name; // "R", "diffuse.R"
    void* first = nullptr;
    std::size_t x_stride = 0, y_stride = 0;
};

/// The channels of a picture of 1, 3 or 4 channels: layer "" gives "R", "G", ..., layer "diffuse" gives
/// "diffuse.R", ...; of one channel, "Y". They point into the picture's data, which the cv::Mat shares.
std::vector<ExrChannel> exr_channels(const std::string& layer, const cv::Mat& picture);

/// Numbers beside the picture, in the file's header.
using ExrNumbers = std::map<std::string, double>;

/// Single precision. Atomic. Throws InputError when the file cannot be written.
void write_exr_channels(const std::filesystem::path& path, cv::Size size,
                        std::span<const ExrChannel> channels, const ExrNumbers& numbers);

/// Fills the channels. Throws InputError for a file that is not there, is broken, is of another size or
/// lacks a channel or a number; what the channels point to is undefined then.
void read_exr_channels(const std::filesystem::path& path, cv::Size size, std::span<const ExrChannel> channels,
                       ExrNumbers& numbers);

} // namespace base
