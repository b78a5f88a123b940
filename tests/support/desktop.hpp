// A desktop without a screen (Xvfb) and a program on it that is driven as its user would: mouse and keys by
// xdotool, pictures of the screen, and the program's own word on what it has done, so that nothing waits for
// a time to pass.
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
    /// `environment`: VARIABLE=value, added to the test's own. What it prints goes to files.
    Process(const std::vector<std::string>& words, const std::vector<std::string>& environment,
            const std::filesystem::path& out, const std::filesystem::path& err);
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    /// Waits for its end; its exit code, 128 + signal when one ended it, -1 after too long.
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
    /// Of the screen, RGB.
    cv::Mat3b picture() const;
    /// As the user: {"mousemove", "10", "20", "click", "1"}. Throws std::runtime_error when it fails.
    void user(const std::vector<std::string>& does) const;
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

    /// The first "idle" event of the program's, not yet returned, that is as wanted: nothing is left to be
    /// drawn. Throws std::runtime_error, with the last event, after too long or when the program ends.
    nlohmann::json idle(const std::function<bool(const nlohmann::json&)>& wanted, const std::string& what);
    nlohmann::json idle();
    Process& process() { return *process_; }
    std::string out() const, err() const; // all it printed

  private:
    TemporaryFolder folder_;
    std::unique_ptr<Process> process_;
    std::size_t read_ = 0; // lines of its events
};
