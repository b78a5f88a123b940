#include "tests/support/desktop.hpp"

#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "tests/support/process.hpp"

namespace {

using Clock = std::chrono::steady_clock;

std::string text_of(const std::filesystem::path& file)
{
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

/// Polls until `done` returns true. The limit is generous because a busy machine is slow.
bool wait_for(const std::function<bool()>& done, double seconds = 120)
{
    const auto limit = Clock::now() + std::chrono::duration<double>(seconds);
    while (!done()) {
        if (Clock::now() > limit)
            return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(15));
    }
    return true;
}

std::vector<char*> pointers(std::vector<std::string>& words)
{
    std::vector<char*> list;
    for (std::string& word : words)
        list.push_back(word.data());
    list.push_back(nullptr);
    return list;
}

} // namespace

Process::Process(const std::vector<std::string>& words, const std::vector<std::string>& environment,
                 const std::filesystem::path& out, const std::filesystem::path& err)
{
    std::vector<std::string> all{"env"}; // also finds the program in PATH
    all.insert(all.end(), environment.begin(), environment.end());
    all.insert(all.end(), words.begin(), words.end());
    const std::vector<char*> arguments = pointers(all);
    pid_ = ::fork();
    if (pid_ < 0)
        throw std::runtime_error("fork failed");
    if (pid_ > 0)
        return;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
    ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
    ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
    ::execvp("env", arguments.data());
    ::_exit(127);
}

Process::~Process()
{
    kill();
}

bool Process::running() const
{
    return pid_ > 0 && ::waitid(P_PID, id_t(pid_), nullptr, WEXITED | WNOHANG | WNOWAIT) == 0 && [&] {
        siginfo_t info{};
        ::waitid(P_PID, id_t(pid_), &info, WEXITED | WNOHANG | WNOWAIT);
        return info.si_pid == 0;
    }();
}

int Process::wait(double seconds)
{
    if (pid_ > 0 && wait_for([&] { return !running(); }, seconds)) {
        int status = 0;
        ::waitpid(std::exchange(pid_, -1), &status, 0);
        code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    return code_;
}

void Process::kill()
{
    if (pid_ <= 0)
        return;
    ::kill(pid_, SIGKILL);
    ::waitpid(std::exchange(pid_, -1), nullptr, 0);
}

double Process::cpu_seconds() const
{
    // Fields 14 and 15: user and system time in clock ticks; the name in field 2 may hold blanks.
    const std::string stat = text_of(fmt::format("/proc/{}/stat", pid_));
    std::istringstream fields(stat.substr(stat.rfind(')') + 2));
    std::string field;
    for (int i = 3; i < 14; ++i)
        fields >> field;
    double user = 0, system = 0;
    fields >> user >> system;
    return (user + system) / double(::sysconf(_SC_CLK_TCK));
}

Desktop::Desktop()
{
    // The server chooses a free display and writes its number to file descriptor 1, its standard output.
    server_ = std::make_unique<Process>(
        std::vector<std::string>{"Xvfb", "-displayfd", "1", "-screen", "0", "1600x1000x24", "-nolisten",
                                 "tcp", "-noreset", "-fbdir", folder_.path().string()},
        std::vector<std::string>{}, folder_ / "out", folder_ / "err");
    const bool ready =
        wait_for([&] { return text_of(folder_ / "out").ends_with('\n') || !server_->running(); });
    const std::string number = text_of(folder_ / "out");
    if (!ready || number.empty())
        throw std::runtime_error("no desktop (Debian: xvfb): " + text_of(folder_ / "err"));
    display_ = fmt::format(":{}", std::stoi(number));
}

/// Xvfb keeps the screen in a file in XWD format: a header of big-endian words, a colour table, the pixels.
cv::Mat3b Desktop::picture() const
{
    const std::string file = text_of(folder_ / "Xvfb_screen0");
    const auto word = [&](std::size_t index) {
        const auto* bytes = reinterpret_cast<const unsigned char*>(file.data()) + 4 * index;
        return std::uint32_t(bytes[0]) << 24 | std::uint32_t(bytes[1]) << 16 | std::uint32_t(bytes[2]) << 8 |
               bytes[3];
    };
    if (file.size() < 100)
        throw std::runtime_error("no picture of the screen");
    const std::uint32_t header = word(0), width = word(4), height = word(5), stride = word(12),
                        colors = word(19);
    std::string pixels = file.substr(header + std::size_t{12} * colors);
    const cv::Mat4b bgrx(int(height), int(width), reinterpret_cast<cv::Vec4b*>(pixels.data()), stride);
    cv::Mat3b rgb;
    cv::cvtColor(bgrx, rgb, cv::COLOR_BGRA2RGB);
    return rgb;
}

void Desktop::xdotool(const std::vector<std::string>& arguments) const
{
    std::vector<std::string> words{"xdotool"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    Process tool(words, {"DISPLAY=" + display_}, folder_ / "tool_out", folder_ / "tool_err");
    if (tool.wait() != 0)
        throw std::runtime_error(
            fmt::format("xdotool {}: {}", fmt::join(arguments, " "), text_of(folder_ / "tool_err")));
}

Demo::Demo(const Desktop& desktop, std::vector<std::string> arguments)
{
    std::vector<std::string> words{program_path(), "demo", "--validation", "--events", folder_ / "events"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    process_ =
        std::make_unique<Process>(words,
                                  std::vector<std::string>{"DISPLAY=" + desktop.display(),
                                                           "XDG_RUNTIME_DIR=" + folder_.path().string()},
                                  folder_ / "out", folder_ / "err");
}

std::string Demo::out() const
{
    return text_of(folder_ / "out");
}

std::string Demo::err() const
{
    return text_of(folder_ / "err");
}

nlohmann::json Demo::idle(const std::function<bool(const nlohmann::json&)>& wanted, const std::string& what)
{
    nlohmann::json found;
    std::string last;
    const bool done = wait_for([&] {
        const bool alive = process_->running(); // first, so that the last events are read
        std::istringstream lines(text_of(folder_ / "events"));
        std::string line;
        for (std::size_t i = 0; std::getline(lines, line) && !lines.eof(); ++i) {
            if (i < read_)
                continue;
            ++read_;
            last = line;
            const auto event = nlohmann::json::parse(line);
            if (event["event"] == "idle" && wanted(event)) {
                found = event;
                return true;
            }
        }
        if (!alive)
            throw std::runtime_error("the program ended before " + what + ": " + err());
        return false;
    });
    if (!done)
        throw std::runtime_error("timed out waiting for " + what + "; last: " + last);
    return found;
}

nlohmann::json Demo::idle()
{
    return idle([](const nlohmann::json& event) { return event["pictures"] > 0; }, "the first picture");
}
