// A film is written whatever its name is.
#include "base/film.hpp"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "tests/support/temporary_folder.hpp"

TEST(Film, NameMayLookLikeAProtocol)
{
    const TemporaryFolder folder;
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    for (const char* name : {"12:30.mp4", "http:x.mp4", "-y.mp4", "100%d.mp4"}) {
        base::Film film(name, {32, 32}, 10);
        for (int i = 0; i < 3; ++i)
            film.add(cv::Mat3b(32, 32, cv::Vec3b(40, 50, 60)));
        EXPECT_NO_THROW(film.finish()) << name;
        EXPECT_GT(std::filesystem::file_size(name), 100u) << name;
    }
    std::filesystem::current_path(before);
}
