// What the main() functions share: when the program started, its messages and exit codes.
#include "base/program.hpp"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdlib>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <thread>

#include "base/input_error.hpp"
#include "base/interrupt.hpp"

namespace {

/// The exit code of a program whose command `go` runs `work`.
int code_of(const std::function<void()>& work, std::vector<std::string> arguments = {"program", "go"})
{
    CLI::App program("", "program");
    program.add_subcommand("go")->callback(work);
    std::vector<char*> argv;
    for (std::string& argument : arguments)
        argv.push_back(argument.data());
    return base::run_program(program, int(argv.size()), argv.data());
}

} // namespace

TEST(Program, TimeIsCountedFromTheProcessOrFromWhereItWasHandedOver)
{
    const auto seconds = [] {
        using namespace std::chrono;
        return duration<double>(system_clock::now().time_since_epoch()).count();
    };
    ::unsetenv("CICATRIX_STARTED");
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    const double since_process = base::ms_since_start();
    EXPECT_GE(since_process, 280);

    ::setenv("CICATRIX_STARTED", fmt::format("{:.6f}", seconds()).c_str(), 1);
    EXPECT_LT(base::ms_since_start(), since_process - 200);

    // Older than the process, in the future, no number.
    for (const char* wrong : {"1000.5", "-7", "soon", ""}) {
        ::setenv("CICATRIX_STARTED", wrong, 1);
        EXPECT_GE(base::ms_since_start(), since_process) << wrong;
    }
    ::setenv("CICATRIX_STARTED", "99999999999", 1);
    EXPECT_EQ(base::ms_since_start(), 0);
    ::unsetenv("CICATRIX_STARTED");
}

TEST(Program, EachKindOfEndHasItsExitCode)
{
    EXPECT_EQ(code_of([] {}), 0);
    EXPECT_EQ(code_of([] {}, {"program", "--help"}), 0);
    EXPECT_EQ(code_of([] { throw base::InputError("a", "b", "c"); }), 1);
    EXPECT_EQ(code_of([] { throw std::bad_alloc(); }), 1);
    EXPECT_EQ(code_of([] {}, {"program"}), 2);
    EXPECT_EQ(code_of([] {}, {"program", "no"}), 2);
    EXPECT_EQ(code_of([] {}, {"program", "go", "--no"}), 2);
    EXPECT_EQ(code_of([] { throw base::Interrupted(); }), 130);
}

TEST(Program, MessagesAreOneLineAndMoveNoCursor)
{
    using namespace std::string_literals;
    testing::internal::CaptureStderr();
    code_of([] { throw base::InputError("a\0b\x1b[31m.json"s, "is\nbad", "mend \xff"); });
    code_of([] { throw std::runtime_error("x\x1b[2Jy"); });
    code_of([] {}, {"program", "\x1b[2J"});
    const std::string printed = testing::internal::GetCapturedStderr();
    EXPECT_THAT(printed, testing::HasSubstr("program: a\\x00b\\x1b[31m.json: is bad; mend \\xff\n"));
    EXPECT_THAT(printed, testing::HasSubstr("program: x\\x1b[2Jy\n"));
    EXPECT_THAT(printed, testing::Not(testing::HasSubstr("\x1b")));
    EXPECT_EQ(std::ranges::count(printed, '\n'), 3);
}

TEST(ProgramDeathTest, OutputThatCannotBeWrittenIsAnError)
{
    const auto print_to_a_full_disk = [](const std::vector<std::string>& arguments) {
        if (std::freopen("/dev/full", "w", stdout) == nullptr)
            std::_Exit(99);
        std::_Exit(code_of([] { fmt::print("a line\n"); }, arguments));
    };
    EXPECT_EXIT(print_to_a_full_disk({"program", "go"}), testing::ExitedWithCode(1),
                "standard output: cannot be written");
    EXPECT_EXIT(print_to_a_full_disk({"program", "--help"}), testing::ExitedWithCode(1),
                "standard output: cannot be written");
}
