#include "base/film.hpp"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <opencv2/imgproc.hpp>
#include <spawn.h>
#include <sstream>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include "base/file.hpp"
#include "base/input_error.hpp"

extern char** environ;

namespace base {
namespace {

constexpr const char* install = "install it, on Debian as root: apt-get install ffmpeg";

void close_file(int& file)
{
    if (file >= 0)
        ::close(file);
    file = -1;
}

/// The last line that ffmpeg printed, which gives the reason of a failure.
std::string last_line(int log)
{
    std::string text(4096, '\0');
    const off_t end = ::lseek(log, 0, SEEK_END);
    const ssize_t read = ::pread(log, text.data(), text.size(), std::max<off_t>(0, end - 4096));
    text.resize(std::size_t(std::max<ssize_t>(0, read)));
    std::istringstream lines(text);
    std::string last;
    for (std::string line; std::getline(lines, line);)
        if (!line.empty())
            last = line;
    return last;
}

std::vector<std::string> arguments(cv::Size size, double fps, const std::filesystem::path& file)
{
    return {
        "ffmpeg", "-hide_banner", "-loglevel", "error", "-nostdin", "-y",
        // input: sRGB pictures, full range
        "-f", "rawvideo", "-pixel_format", "rgb24", "-video_size",
        fmt::format("{}x{}", size.width, size.height), "-framerate", fmt::format("{}", fps), "-i", "pipe:0",
        // output: the colour matrix and range that players assume by default, also tagged in the file
        "-vf",
        "scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int+bicubic,format=yuv420p",
        "-color_range", "tv", "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709",
        "-c:v", "libx264", "-preset", "medium", "-crf", "15", "-movflags", "+faststart", "-f", "mp4",
        "file:" + file.string()}; // without "file:", the name 12:30.mp4 has a protocol called 12
}

} // namespace

void Film::check_ffmpeg()
{
    const char* path = std::getenv("PATH");
    std::istringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');)
        if (::access((std::filesystem::path(folder) / "ffmpeg").c_str(), X_OK) == 0)
            return;
    throw InputError("--video", "needs the program ffmpeg, which was not found", install);
}

Film::Film(std::filesystem::path path, std::array<std::uint32_t, 2> size, double fps)
    : path_(std::move(path)), temporary_(temporary_beside(path_)),
      size_(int(size[0] + size[0] % 2), int(size[1] + size[1] % 2))
{
    start(fps);
}

Film::~Film()
{
    if (process_ >= 0)
        ::kill(process_, SIGKILL);
    wait();
    close_file(log_);
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
}

void Film::start(double fps)
{
    // Sockets rather than a pipe: with MSG_NOSIGNAL, writing after ffmpeg has exited is an error, not
    // SIGPIPE.
    std::array<int, 2> ends{-1, -1};
    log_ = ::memfd_create("ffmpeg's output", MFD_CLOEXEC);
    if (log_ < 0 || ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        fail(std::strerror(errno));
    pipe_ = ends[0];
    std::vector<std::string> words = arguments(size_, fps, temporary_);
    std::vector<char*> argv;
    for (std::string& word : words)
        argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, log_, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, log_, STDERR_FILENO);
    // In a separate process group: Ctrl-C reaches only this program, which then stops ffmpeg.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    const int error = ::posix_spawnp(&process_, argv[0], &actions, &attributes, argv.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    close_file(ends[1]);
    if (error != 0) {
        process_ = -1;
        close_file(pipe_);
        close_file(log_);
        throw InputError("--video", fmt::format("cannot start ffmpeg: {}", std::strerror(error)), install);
    }
}

void Film::add(const cv::Mat3b& picture)
{
    cv::Mat3b even;
    cv::copyMakeBorder(picture, even, 0, size_.height - picture.rows, 0, size_.width - picture.cols,
                       cv::BORDER_REPLICATE);
    const auto* bytes = reinterpret_cast<const char*>(even.data);
    for (std::size_t left = even.total() * even.elemSize(); left > 0;) {
        const ssize_t sent = ::send(pipe_, bytes, left, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR)
            continue;
        if (sent < 0)
            fail("");
        bytes += sent;
        left -= std::size_t(sent);
    }
}

void Film::finish()
{
    if (wait() != 0)
        fail("");
    rename_over(temporary_, path_);
}

/// Closes ffmpeg's input and waits until it exits. Returns its exit code, or 0 when no process is running.
int Film::wait()
{
    close_file(pipe_);
    if (process_ < 0)
        return 0;
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void Film::fail(const std::string& what)
{
    wait();
    std::string reason = what.empty() ? last_line(log_) : what;
    if (reason.empty())
        reason = "it printed no message";
    throw InputError(path_.string(), "ffmpeg failed: " + reason,
                     "check that the disk has space and that ffmpeg has the encoder libx264");
}

} // namespace base
