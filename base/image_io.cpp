#include "base/image_io.hpp"

#include <atomic>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <unistd.h>

#include "base/file.hpp"
#include "base/image_codec.hpp"
#include "base/input_error.hpp"

namespace base {
namespace {

constexpr std::size_t max_file = std::size_t{1} << 30; // bytes

void write_converted(const std::filesystem::path& path, const cv::Mat& picture,
                     cv::ColorConversionCodes to_opencv)
{
    cv::Mat converted;
    cv::cvtColor(picture, converted, to_opencv);
    write_bytes(path, encode_png(converted));
}

} // namespace

cv::Mat3b read_rgb(const std::filesystem::path& path)
{
    const cv::Mat bgr = decode_picture(read_file(path, max_file), Channels::Opaque, path.string());
    cv::Mat3b rgb;
    cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
    return rgb;
}

cv::Mat1b read_mask(const std::filesystem::path& path)
{
    const auto bytes = read_file(path, max_file);
    const cv::Mat stored = decode_picture(bytes, Channels::AsStored, path.string());
    if (stored.channels() != 4) {
        cv::Mat gray;
        cv::cvtColor(decode_picture(bytes, Channels::Opaque, path.string()), gray, cv::COLOR_BGR2GRAY);
        return gray > 127;
    }
    cv::Mat gray, alpha;
    cv::cvtColor(stored, gray, cv::COLOR_BGRA2GRAY);
    cv::extractChannel(stored, alpha, 3);
    cv::Mat product;
    cv::multiply(gray, alpha, product, 1.0, CV_32S);
    return product > 255 * 255 / 2;
}

void write_png(const std::filesystem::path& path, const cv::Mat3b& rgb)
{
    write_converted(path, rgb, cv::COLOR_RGB2BGR);
}

void write_png(const std::filesystem::path& path, const cv::Mat4b& rgba)
{
    write_converted(path, rgba, cv::COLOR_RGBA2BGRA);
}

void write_png(const std::filesystem::path& path, const cv::Mat1b& gray)
{
    write_bytes(path, encode_png(gray));
}

} // namespace base
