// A film, encoded by the program ffmpeg: raw pictures go down a pipe, an H.264 file comes out.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <sys/types.h>

namespace base {

/// H.264 in MP4, 4:2:0, BT.709: what every player, browser and slide program shows. Whole or absent: the file
/// appears in finish(); without it, ffmpeg is ended and nothing is left.
class Film
{
  public:
    /// Throws InputError when no ffmpeg is found: to be called before long work.
    static void check_ffmpeg();

    /// Starts ffmpeg. An odd width or height is made even by repeating the last column or row. Throws
    /// InputError.
    Film(std::filesystem::path path, std::array<std::uint32_t, 2> size, double fps);
    ~Film();
    Film(const Film&) = delete;
    Film& operator=(const Film&) = delete;

    /// The next picture, RGB, of the film's size. Throws InputError, with ffmpeg's own words, when
    /// ffmpeg has failed.
    void add(const cv::Mat3b& picture);
    void finish();

  private:
    void start(double fps);
    int wait();
    [[noreturn]] void fail(const std::string& what);

    const std::filesystem::path path_, temporary_;
    const cv::Size size_; // as encoded
    int pipe_ = -1, log_ = -1;
    pid_t process_ = -1;
};

} // namespace base
