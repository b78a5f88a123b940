#include "base/image_codec.hpp"

#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <mutex>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <unistd.h>

#include "base/input_error.hpp"

namespace base {
namespace {

using Bytes = std::span<const std::uint8_t>;
constexpr std::uint32_t max_side = 16384; // px

/// Redirects stderr to /dev/null: OpenCV has no option that stops libpng, libjpeg and libtiff from printing.
class QuietCodecs
{
  public:
    QuietCodecs() : lock_(mutex())
    {
        cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
        std::fflush(stderr);
        saved_ = dup(STDERR_FILENO);
        const int nothing = open("/dev/null", O_WRONLY | O_CLOEXEC);
        if (saved_ >= 0 && nothing >= 0)
            dup2(nothing, STDERR_FILENO);
        if (nothing >= 0)
            close(nothing);
    }
    ~QuietCodecs()
    {
        std::fflush(stderr);
        if (saved_ >= 0) {
            dup2(saved_, STDERR_FILENO);
            close(saved_);
        }
    }
    QuietCodecs(const QuietCodecs&) = delete;
    QuietCodecs& operator=(const QuietCodecs&) = delete;

  private:
    static std::mutex& mutex()
    {
        static std::mutex one;
        return one;
    }
    std::lock_guard<std::mutex> lock_;
    int saved_ = -1;
};

struct Header
{
    const char* format = nullptr;        // null: unsupported
    bool complete = true;                // false: the file is truncated
    std::uint32_t width = 0, height = 0; // px; 0: not known before decoding
};

std::uint32_t big_endian(Bytes bytes, std::size_t at, int count)
{
    std::uint32_t value = 0;
    for (int i = 0; i < count; ++i)
        value = value << 8 | bytes[at + i];
    return value;
}

std::uint32_t little_endian(Bytes bytes, std::size_t at)
{
    return bytes[at] | bytes[at + 1] << 8 | bytes[at + 2] << 16 |
           static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

bool starts_with(Bytes bytes, std::string_view magic, std::size_t at = 0)
{
    return bytes.size() >= at + magic.size() &&
           std::memcmp(bytes.data() + at, magic.data(), magic.size()) == 0;
}

/// Reads the chunks up to IEND.
Header png_header(Bytes bytes)
{
    Header header{"PNG", false};
    for (std::size_t at = 8; at + 12 <= bytes.size();) {
        const std::size_t length = big_endian(bytes, at, 4);
        if (length > bytes.size() - at - 12)
            break;
        if (starts_with(bytes, "IHDR", at + 4) && length >= 8) {
            header.width = big_endian(bytes, at + 8, 4);
            header.height = big_endian(bytes, at + 12, 4);
        }
        if (starts_with(bytes, "IEND", at + 4)) {
            header.complete = true;
            break;
        }
        at += length + 12;
    }
    return header;
}

/// Reads the markers up to EOI. Data after EOI is allowed: phones append a video or a second picture.
Header jpeg_header(Bytes bytes)
{
    Header header{"JPEG", false};
    for (std::size_t at = 2; at + 2 <= bytes.size();) {
        const std::uint8_t marker = bytes[at + 1];
        const bool standalone =
            marker == 0x00 || marker == 0x01 || marker == 0xff || (marker >= 0xd0 && marker <= 0xd7);
        if (bytes[at] != 0xff || standalone) { // coded data, its escapes and restarts, fill bytes
            ++at;
            continue;
        }
        if (marker == 0xd9) {
            header.complete = true;
            break;
        }
        if (at + 4 > bytes.size())
            break;
        const bool frame =
            marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
        if (frame && at + 9 <= bytes.size()) {
            header.height = big_endian(bytes, at + 5, 2);
            header.width = big_endian(bytes, at + 7, 2);
        }
        at += 2 + big_endian(bytes, at + 2, 2);
    }
    return header;
}

Header header_of(Bytes bytes)
{
    using namespace std::string_view_literals;
    if (starts_with(bytes, "\x89PNG\r\n\x1a\n"sv))
        return png_header(bytes);
    if (starts_with(bytes, "\xff\xd8\xff"sv))
        return jpeg_header(bytes);
    if (starts_with(bytes, "RIFF"sv) && starts_with(bytes, "WEBP"sv, 8))
        return {"WebP", little_endian(bytes, 4) <= bytes.size() - 8};
    if (starts_with(bytes, "BM"sv) && bytes.size() >= 26) {
        const auto height =
            static_cast<std::int32_t>(little_endian(bytes, 22)); // negative: stored top row first
        return {"BMP", little_endian(bytes, 2) <= bytes.size(), little_endian(bytes, 18),
                height < 0 ? 0u - static_cast<std::uint32_t>(height) : static_cast<std::uint32_t>(height)};
    }
    if (starts_with(bytes, "II*\0"sv) || starts_with(bytes, "MM\0*"sv))
        return {"TIFF"};
    return {};
}

void check_size(std::uint32_t width, std::uint32_t height, std::string_view where)
{
    if (width > max_side || height > max_side)
        throw InputError(where, fmt::format("the picture is {} x {} px", width, height),
                         fmt::format("make it at most {0} x {0}", max_side));
}

} // namespace

cv::Mat decode_picture(Bytes bytes, Channels channels, std::string_view where)
{
    const Header header = header_of(bytes);
    if (!header.format)
        throw InputError(where, "is not a picture of a known format", "use PNG or JPEG");
    if (!header.complete)
        throw InputError(where, fmt::format("the {} picture is cut short", header.format),
                         "copy or export it again");
    check_size(header.width, header.height, where);

    cv::Mat picture;
    try {
        const QuietCodecs quiet;
        const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8U,
                             const_cast<std::uint8_t*>(bytes.data()));
        picture =
            cv::imdecode(buffer, channels == Channels::Opaque ? cv::IMREAD_COLOR : cv::IMREAD_UNCHANGED);
    } catch (const cv::Exception&) {
        picture.release(); // empty, like OpenCV's other failures; reported below
    }
    if (picture.empty())
        throw InputError(where, fmt::format("the {} picture is damaged", header.format),
                         "copy or export it again");
    check_size(picture.cols, picture.rows, where);
    if (picture.depth() == CV_16U)
        picture.convertTo(picture, CV_8U, 1.0 / 257.0);
    if (picture.depth() != CV_8U || picture.channels() == 2)
        throw InputError(where, "has an unsupported pixel type", "save it as 8-bit PNG");
    return picture;
}

std::vector<std::uint8_t> encode_png(const cv::Mat& picture)
{
    std::vector<std::uint8_t> bytes;
    // OpenCV's default compression is faster than level 1 and gives smaller files.
    cv::imencode(".png", picture, bytes);
    return bytes;
}

std::vector<std::uint8_t> encode_jpeg(const cv::Mat& picture, int quality)
{
    std::vector<std::uint8_t> bytes;
    cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
    return bytes;
}

} // namespace base
