#include "base/image_compare.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "base/image_io.hpp"

namespace {

namespace fs = std::filesystem;
using base::compare_images;

// 100 x 100 = 10 000 pixels: 0.1 % is ten of them.
cv::Mat3b picture()
{
    cv::Mat3b image(100, 100);
    for (int y = 0; y < image.rows; ++y)
        for (int x = 0; x < image.cols; ++x)
            image(y, x) = cv::Vec3b(static_cast<uchar>(2 * x), static_cast<uchar>(2 * y), 128);
    return image;
}

cv::Mat3b changed(int pixels, int by)
{
    cv::Mat3b image = picture();
    for (int i = 0; i < pixels; ++i)
        image(i / 100, i % 100)[2] = static_cast<uchar>(128 + by);
    return image;
}

class GoldenTest : public testing::Test
{
  protected:
    void SetUp() override
    {
        fs::remove_all(folder);
        fs::create_directories(folder);
        base::write_png(golden, picture());
    }
    void TearDown() override { fs::remove_all(folder); }

    const fs::path folder =
        fs::temp_directory_path() /
        ("cicatrix_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    const fs::path golden = folder / "face.png", failures = folder / "failures";
};

} // namespace

TEST(ImageCompare, SamePictureIsEqual)
{
    const auto found = compare_images(picture(), picture());
    EXPECT_TRUE(found.equal);
    EXPECT_EQ(found.largest_difference, 0);
}

TEST(ImageCompare, RoundingEverywhereIsEqualAndOneStepMoreIsNot)
{
    EXPECT_TRUE(compare_images(changed(10'000, 3), picture()).equal);
    EXPECT_FALSE(compare_images(changed(10'000, 4), picture()).equal);
}

TEST(ImageCompare, AThousandthOfThePixelsMayDifferMoreAndOnePixelMoreMayNot)
{
    EXPECT_TRUE(compare_images(changed(10, 32), picture()).equal);
    EXPECT_FALSE(compare_images(changed(11, 32), picture()).equal);
}

TEST(ImageCompare, OnePixelBeyondTheHardBoundFails)
{
    const auto found = compare_images(changed(1, 33), picture());
    EXPECT_FALSE(found.equal);
    EXPECT_EQ(found.largest_difference, 33);
    EXPECT_EQ(found.largest_at, cv::Point(0, 0));
    EXPECT_THAT(found.report, testing::HasSubstr("33/255 at (0, 0)"));
}

TEST(ImageCompare, EachChannelCounts)
{
    for (int channel = 0; channel < 3; ++channel) {
        cv::Mat3b image = picture();
        image(70, 10)[channel] ^= 0x80;
        EXPECT_FALSE(compare_images(image, picture()).equal) << channel;
    }
}

TEST(ImageCompare, AnotherSizeAndEmptyPicturesFail)
{
    EXPECT_FALSE(compare_images(cv::Mat3b(100, 99), picture()).equal);
    EXPECT_FALSE(compare_images(cv::Mat3b(), cv::Mat3b()).equal);
}

TEST(ImageCompare, TheCallerSetsTheBounds)
{
    EXPECT_FALSE(compare_images(changed(1, 1), picture(), {.usual = 0, .exceptions = 0, .hard = 0}).equal);
    EXPECT_TRUE(
        compare_images(changed(5'000, 60), picture(), {.usual = 3, .exceptions = 0.5, .hard = 60}).equal);
}

TEST(ImageCompare, TheFirstNonFinitePixelIsFound)
{
    cv::Mat4f linear(8, 8, cv::Vec4f::all(1));
    EXPECT_FALSE(base::first_non_finite(linear));
    linear(5, 3)[1] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(base::first_non_finite(linear), cv::Point(3, 5));
    linear(2, 7)[3] = -std::numeric_limits<float>::infinity();
    EXPECT_EQ(base::first_non_finite(linear), cv::Point(7, 2));
}

TEST_F(GoldenTest, EqualPictureWritesNothing)
{
    EXPECT_TRUE(base::compare_with_golden(cv::Mat4f(), picture(), golden, failures).equal);
    EXPECT_FALSE(fs::exists(failures));
}

TEST_F(GoldenTest, FailureWritesActualExpectedAndAmplifiedDifference)
{
    EXPECT_FALSE(base::compare_with_golden(cv::Mat4f(), changed(20, 8), golden, failures).equal);
    EXPECT_EQ(base::read_rgb(failures / "face_actual.png")(0, 19)[2], 136);
    EXPECT_EQ(base::read_rgb(failures / "face_expected.png")(0, 19)[2], 128);
    const cv::Mat3b difference = base::read_rgb(failures / "face_difference.png");
    EXPECT_EQ(difference(0, 19), cv::Vec3b(0, 0, 128));
    EXPECT_EQ(difference(0, 20), cv::Vec3b(0, 0, 0));
}

TEST_F(GoldenTest, NotANumberFailsEvenWhenTheEncodedPictureIsEqual)
{
    cv::Mat3f linear(100, 100, cv::Vec3f::all(0));
    linear(50, 40)[0] = std::numeric_limits<float>::quiet_NaN();
    const auto found = base::compare_with_golden(linear, picture(), golden, failures);
    EXPECT_FALSE(found.equal);
    EXPECT_THAT(found.report, testing::HasSubstr("(40, 50)"));
    EXPECT_TRUE(fs::exists(failures / "face_actual.png"));
}

TEST_F(GoldenTest, MissingGoldenFailsAndLeavesThePictureToLookAt)
{
    const auto found = base::compare_with_golden(cv::Mat4f(), picture(), folder / "new.png", failures);
    EXPECT_FALSE(found.equal);
    EXPECT_TRUE(fs::exists(failures / "new_actual.png"));
    EXPECT_FALSE(fs::exists(failures / "new_expected.png"));
}
