// What the main() functions share: when the program started.
#include "base/program.hpp"

#include <chrono>
#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <thread>

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
