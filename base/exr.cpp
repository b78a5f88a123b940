// Writes files with the OpenEXR library, first into memory, so that only complete files reach the disk.
#include "base/exr.hpp"

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <array>
#include <cstring>
#include <exception>
#include <fmt/format.h>

#include "base/file.hpp"
#include "base/image_io.hpp"
#include "base/input_error.hpp"

namespace base {
namespace {

class MemoryStream : public Imf::OStream
{
  public:
    MemoryStream() : OStream("memory") {}

    void write(const char c[], int n) override
    {
        bytes_.resize(std::max(bytes_.size(), at_ + std::size_t(n)));
        std::memcpy(bytes_.data() + at_, c, std::size_t(n));
        at_ += std::size_t(n);
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t pos) override { at_ = pos; }

    const std::vector<std::uint8_t>& bytes() const { return bytes_; }

  private:
    std::vector<std::uint8_t> bytes_;
    std::size_t at_ = 0;
};

Imf::FrameBuffer frame_buffer(std::span<const ExrChannel> channels, Imf::PixelType type)
{
    Imf::FrameBuffer buffer;
    for (const ExrChannel& channel : channels)
        buffer.insert(channel.name, Imf::Slice(type, static_cast<char*>(channel.first), channel.x_stride,
                                               channel.y_stride));
    return buffer;
}

void write(const std::filesystem::path& path, cv::Size size, std::span<const ExrChannel> channels,
           const ExrNumbers& numbers, Imf::PixelType type)
{
    Imf::Header header(size.width, size.height);
    for (const ExrChannel& channel : channels)
        header.channels().insert(channel.name, Imf::Channel(type));
    for (const auto& [name, number] : numbers)
        header.insert(name, Imf::DoubleAttribute(number));
    MemoryStream stream;
    {
        Imf::OutputFile file(stream, header);
        file.setFrameBuffer(frame_buffer(channels, type));
        file.writePixels(size.height);
    } // the destructor writes the line offset table
    write_bytes(path, stream.bytes());
}

void write_picture(const std::filesystem::path& path, const cv::Mat& picture, ExrDepth depth)
{
    cv::Mat stored;
    picture.convertTo(stored, depth == ExrDepth::Half ? CV_16F : CV_32F);
    write(path, stored.size(), exr_channels("", stored), {},
          depth == ExrDepth::Half ? Imf::HALF : Imf::FLOAT);
}

/// What is wrong with the file, or nothing when it has been read.
std::string read(const std::filesystem::path& path, cv::Size size, std::span<const ExrChannel> channels,
                 ExrNumbers& numbers)
{
    Imf::InputFile file(path.c_str());
    if (file.header().dataWindow() != Imath::Box2i({0, 0}, {size.width - 1, size.height - 1}))
        return "is of another size";
    for (const ExrChannel& channel : channels)
        if (const Imf::Channel* found = file.header().channels().findChannel(channel.name);
            !found || found->type != Imf::FLOAT)
            return fmt::format("has no channel {}", channel.name);
    for (auto& [name, number] : numbers) {
        const auto* found = file.header().findTypedAttribute<Imf::DoubleAttribute>(name);
        if (!found)
            return fmt::format("does not say {}", name);
        number = found->value();
    }
    file.setFrameBuffer(frame_buffer(channels, Imf::FLOAT));
    file.readPixels(0, size.height - 1);
    return {};
}

} // namespace

std::vector<ExrChannel> exr_channels(const std::string& layer, const cv::Mat& picture)
{
    static constexpr std::array<const char*, 4> colors{"R", "G", "B", "A"};
    CV_Assert(picture.channels() <= 4);
    std::vector<ExrChannel> channels;
    for (int c = 0; c < picture.channels(); ++c)
        channels.push_back(
            {(layer.empty() ? "" : layer + ".") + (picture.channels() == 1 ? "Y" : colors[std::size_t(c)]),
             picture.data + std::size_t(c) * picture.elemSize1(), picture.elemSize(), picture.step[0]});
    return channels;
}

void write_exr_channels(const std::filesystem::path& path, cv::Size size,
                        std::span<const ExrChannel> channels, const ExrNumbers& numbers)
{
    write(path, size, channels, numbers, Imf::FLOAT);
}

void read_exr_channels(const std::filesystem::path& path, cv::Size size, std::span<const ExrChannel> channels,
                       ExrNumbers& numbers)
{
    std::string wrong;
    try {
        wrong = read(path, size, channels, numbers);
    } catch (const std::exception&) { // OpenEXR's words are about its own code
        wrong = "is missing or damaged";
    }
    if (!wrong.empty())
        throw InputError(path.string(), wrong, "remove it, so that it is made again");
}

void write_exr(const std::filesystem::path& path, const cv::Mat1f& values)
{
    write_picture(path, values, ExrDepth::Float);
}

void write_exr(const std::filesystem::path& path, const cv::Mat3f& rgb, ExrDepth depth)
{
    write_picture(path, rgb, depth);
}

void write_exr(const std::filesystem::path& path, const cv::Mat4f& rgba, ExrDepth depth)
{
    write_picture(path, rgba, depth);
}

} // namespace base
