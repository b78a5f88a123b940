// Runs the program on a virtual X server (Xvfb). xdotool sends mouse and key events; tests look at pictures
// of the screen and wait for the program's own events, never for a fixed time.
#pragma once
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.hpp"

/// A child process, killed with its parent and when it goes out of scope.
class Process
{
  public:
    /// `environment`: VARIABLE=value, added to the variables of the test. `out`, `err`: files for its output.
    Process(const std::vector<std::string>& words, const std::vector<std::string>& environment,
            const std::filesystem::path& out, const std::filesystem::path& err);
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    /// Waits for the process to end. Returns its exit code, 128 + the signal that ended it, or -1 on timeout.
    int wait(double seconds = 120);
    void kill();
    bool running() const;
    /// CPU time used so far.
    double cpu_seconds() const;

  private:
    int pid_ = -1;
    int code_ = -1;
};

class Desktop
{
  public:
    /// Throws std::runtime_error without Xvfb.
    Desktop();

    const std::string& display() const { return display_; }
    /// The screen, RGB.
    cv::Mat3b picture() const;
    /// Runs xdotool, e.g. {"mousemove", "10", "20", "click", "1"}. Throws std::runtime_error when it fails.
    void xdotool(const std::vector<std::string>& arguments) const;
    void shut_down() { server_->kill(); }

  private:
    TemporaryFolder folder_;
    std::string display_;
    std::unique_ptr<Process> server_;
};

/// `cicatrix demo` on a desktop.
class Demo
{
  public:
    Demo(const Desktop& desktop, std::vector<std::string> arguments);

    /// Waits for the next "idle" event (nothing is left to draw) that `wanted` accepts. Throws
    /// std::runtime_error on timeout, with the last event, or when the program ends.
    nlohmann::json idle(const std::function<bool(const nlohmann::json&)>& wanted, const std::string& what);
    nlohmann::json idle();
    Process& process() { return *process_; }
    std::string out() const, err() const; // all it printed

  private:
    TemporaryFolder folder_;
    std::unique_ptr<Process> process_;
    std::size_t read_ = 0; // event lines read so far
};
