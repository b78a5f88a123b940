// Writes files with the OpenEXR library, first into memory, so that only complete files reach the disk.
#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <algorithm>
#include <cstring>
#include <vector>

#include "base/file.hpp"
#include "base/image_io.hpp"

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

/// `names`: the channel names in the picture's channel order.
void write_channels(const std::filesystem::path& path, const cv::Mat& picture,
                    const std::vector<const char*>& names, ExrDepth depth)
{
    cv::Mat stored;
    picture.convertTo(stored, depth == ExrDepth::Half ? CV_16F : CV_32F);
    const Imf::PixelType type = depth == ExrDepth::Half ? Imf::HALF : Imf::FLOAT;
    const std::size_t bytes = stored.elemSize1();
    Imf::Header header(stored.cols, stored.rows);
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < names.size(); ++c) {
        header.channels().insert(names[c], Imf::Channel(type));
        frame.insert(names[c], Imf::Slice(type, reinterpret_cast<char*>(stored.data) + c * bytes,
                                          stored.elemSize(), stored.step[0]));
    }
    MemoryStream stream;
    {
        Imf::OutputFile file(stream, header);
        file.setFrameBuffer(frame);
        file.writePixels(stored.rows);
    } // the destructor writes the line offset table
    write_bytes(path, stream.bytes());
}

} // namespace

void write_exr(const std::filesystem::path& path, const cv::Mat1f& values)
{
    write_channels(path, values, {"Y"}, ExrDepth::Float);
}

void write_exr(const std::filesystem::path& path, const cv::Mat3f& rgb, ExrDepth depth)
{
    write_channels(path, rgb, {"R", "G", "B"}, depth);
}

void write_exr(const std::filesystem::path& path, const cv::Mat4f& rgba, ExrDepth depth)
{
    write_channels(path, rgba, {"R", "G", "B", "A"}, depth);
}

} // namespace base
