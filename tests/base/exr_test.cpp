// Named channels in and out of files.
#include "base/exr.hpp"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.hpp"

namespace {

TEST(Exr, ChannelsOfAnyNameComeBackAsTheyWere)
{
    const TemporaryFolder folder;
    cv::Mat3f color(5, 7, cv::Vec3f(.1f, -2.f, 1e30f));
    color(2, 3) = {1, 2, 3};
    cv::Mat picture = color, read = cv::Mat3f(5, 7), other = cv::Mat3f(4, 7);
    base::write_exr_channels(folder / "a.exr", {7, 5}, base::exr_channels("layer", picture),
                             {{"samples", 12}});
    base::ExrNumbers numbers{{"samples", 0}}, unknown{{"who", 0}};
    base::read_exr_channels(folder / "a.exr", {7, 5}, base::exr_channels("layer", read), numbers);
    EXPECT_EQ(numbers["samples"], 12);
    EXPECT_EQ(cv::norm(picture, read, cv::NORM_INF), 0);

    const auto refused = [&](const std::filesystem::path& path, cv::Size size, const char* layer,
                             base::ExrNumbers wanted) {
        EXPECT_ANY_THROW(base::read_exr_channels(path, size, base::exr_channels(layer, read), wanted));
    };
    refused(folder / "b.exr", {7, 5}, "layer", numbers);
    refused(folder / "a.exr", {7, 4}, "layer", numbers);
    refused(folder / "a.exr", {7, 5}, "other", numbers);
    refused(folder / "a.exr", {7, 5}, "layer", unknown);
    refused(folder.with("broken.exr", "v/1\1 no picture"), {7, 5}, "layer", numbers);
    EXPECT_ANY_THROW(base::write_exr_channels(folder / "none" / "a.exr", {7, 5},
                                              base::exr_channels("layer", picture), {}));
}

} // namespace
