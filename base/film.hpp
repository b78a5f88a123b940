// A video encoded by the program ffmpeg: raw pictures go through a socket into ffmpeg, which writes H.264.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <sys/types.h>

namespace base {

/// H.264 in MP4, 4:2:0, BT.709: the format that all common players, browsers and slide programs support.
/// finish() creates the file; a Film destroyed without it stops ffmpeg and leaves no file.
class Film
{
  public:
    /// Throws InputError when ffmpeg is not found. Call it before long work.
    static void check_ffmpeg();

    /// Starts ffmpeg. An odd width or height is made even by repeating the last column or row. Throws
    /// InputError.
    Film(std::filesystem::path path, std::array<std::uint32_t, 2> size, double fps);
    ~Film();
    Film(const Film&) = delete;
    Film& operator=(const Film&) = delete;

    /// Adds the next picture, RGB, of the size given to the constructor. Throws InputError with ffmpeg's
    /// message when ffmpeg has failed.
    void add(const cv::Mat3b& picture);
    void finish();

  private:
    void start(double fps);
    int wait();
    [[noreturn]] void fail(const std::string& what);

    const std::filesystem::path path_, temporary_;
    const cv::Size size_; // of the encoded video, even
    int pipe_ = -1, log_ = -1;
    pid_t process_ = -1;
};

} // namespace base
