// What the tests of the program as a process share: its folder, its pictures, and what a refusal looks like.
#pragma once
#include <algorithm>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>
#include <set>

#include "base/image_io.hpp"
#include "tests/support/process.hpp"
#include "tests/support/small_head.hpp"
#include "tests/support/temporary_folder.hpp"

namespace program_test {

inline std::string bytes_of(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

inline std::set<std::string> files_in(const std::filesystem::path& folder)
{
    std::set<std::string> names;
    if (std::filesystem::exists(folder))
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
            names.insert(entry.path().filename().string());
    return names;
}

/// Plain skin with a round wound of `radius` pixels.
inline cv::Mat3b photo(int side = 128, int radius = 24)
{
    cv::Mat3b picture(side, side, cv::Vec3b(208, 162, 140));
    cv::circle(picture, {side / 2, side / 2}, radius, {140, 40, 36}, cv::FILLED);
    return picture;
}

inline cv::Mat1b disc(int side, cv::Point middle, int radius)
{
    cv::Mat1b mask = cv::Mat1b::zeros(side, side);
    cv::circle(mask, middle, radius, 255, cv::FILLED);
    return mask;
}

/// Runs cicatrix in a folder of its own.
class Program : public testing::Test
{
  protected:
    std::string file(std::string_view name) const { return (folder_ / name).string(); }
    std::string with(std::string_view name, std::string_view bytes) const
    {
        return folder_.with(name, bytes).string();
    }
    template <typename Picture>
    std::string with_png(std::string_view name, const Picture& picture) const
    {
        base::write_png(folder_ / name, picture);
        return file(name);
    }

    /// A capture with the arguments `more`.
    Outcome capture(const std::vector<std::string>& more,
                    const std::vector<std::string>& environment = {}) const
    {
        std::vector<std::string> arguments{"capture", "--out", file("out"), "--no-cost"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_program(arguments, environment);
    }
    /// The same on the small head.
    Outcome on_the_head(std::vector<std::string> more) const
    {
        more.insert(more.end(), {"--head", head_});
        return capture(more);
    }

    /// One line on stderr that holds all of `words`, a failing exit code, and nothing in the output folder.
    void expect_refusal(const Outcome& outcome, const std::vector<std::string>& words) const
    {
        EXPECT_GE(outcome.code, 1) << outcome.err;
        EXPECT_LT(outcome.code, 126) << "ended by a signal or not started: " << outcome.err;
        EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
        EXPECT_TRUE(outcome.err.starts_with("cicatrix")) << outcome.err;
        for (const std::string& word : words)
            EXPECT_THAT(outcome.err, testing::HasSubstr(word));
        EXPECT_THAT(files_in(file("out")), testing::IsEmpty()) << outcome.err;
        EXPECT_EQ(outcome.out, "");
    }

    TemporaryFolder folder_;
    const std::string head_ = small::saved(small::head()).string();
};

} // namespace program_test
