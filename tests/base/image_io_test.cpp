// Reading and writing of pictures.
#include "base/file.hpp"
#include "base/image_io.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

#include "base/input_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using testing::HasSubstr;

std::string encoded(const std::string& extension, const cv::Mat& picture)
{
    std::vector<std::uint8_t> bytes;
    cv::imencode(extension, picture, bytes);
    return {bytes.begin(), bytes.end()};
}

cv::Mat3b noise(int rows, int columns)
{
    cv::Mat3b picture(rows, columns);
    std::mt19937 random(7);
    for (cv::Vec3b& pixel : picture)
        pixel = {static_cast<uchar>(random()), static_cast<uchar>(random()), static_cast<uchar>(random())};
    return picture;
}

/// The message of the InputError, "" when there is none.
template <typename Read>
std::string refusal(Read&& read)
{
    try {
        read();
        return "";
    } catch (const base::InputError& error) {
        return error.what();
    }
}

class PictureFile : public testing::Test
{
  protected:
    TemporaryFolder folder_;
};

TEST_F(PictureFile, PngKeepsEveryPixelInRgbOrder)
{
    cv::Mat3b rgb = noise(13, 17);
    rgb(2, 3) = {255, 1, 2};
    base::write_png(folder_ / "a.png", rgb);
    EXPECT_EQ(cv::norm(base::read_rgb(folder_ / "a.png"), rgb, cv::NORM_INF), 0);
    EXPECT_EQ(cv::imread((folder_ / "a.png").string()).at<cv::Vec3b>(2, 3),
              cv::Vec3b(2, 1, 255)); // OpenCV: BGR
}

TEST_F(PictureFile, AlphaIsWrittenAndDroppedOnReading)
{
    base::write_png(folder_ / "a.png", cv::Mat4b(4, 4, cv::Vec4b(10, 20, 30, 0)));
    EXPECT_EQ(cv::imread((folder_ / "a.png").string(), cv::IMREAD_UNCHANGED).at<cv::Vec4b>(0, 0),
              cv::Vec4b(30, 20, 10, 0));
    EXPECT_EQ(base::read_rgb(folder_ / "a.png")(1, 1), cv::Vec3b(10, 20, 30));
}

TEST_F(PictureFile, GrayAndSixteenBitPicturesAreRead)
{
    base::write_png(folder_ / "gray.png", cv::Mat1b(3, 3, uchar(99)));
    EXPECT_EQ(base::read_rgb(folder_ / "gray.png")(0, 0), cv::Vec3b(99, 99, 99));
    const auto deep =
        folder_.with("deep.png", encoded(".png", cv::Mat(3, 3, CV_16UC3, cv::Scalar(65535, 32896, 0))));
    EXPECT_EQ(base::read_rgb(deep)(2, 2), cv::Vec3b(0, 128, 255));
}

TEST_F(PictureFile, JpegIsTurnedUprightByItsExifOrientation)
{
    // Left half white, right half black. Orientation 6 turns the picture 90 degrees clockwise, so that the
    // white half is on top.
    cv::Mat3b picture(16, 32, cv::Vec3b(0, 0, 0));
    picture(cv::Rect(0, 0, 16, 16)).setTo(cv::Scalar(255, 255, 255));
    std::string jpeg = encoded(".jpg", picture);
    const std::string exif("\xff\xe1\x00\x22"
                           "Exif\0\0"
                           "MM\0\x2a\0\0\0\x08"
                           "\0\x01"
                           "\x01\x12\0\x03\0\0\0\x01\0\x06\0\0"
                           "\0\0\0\0",
                           36);
    jpeg.insert(2, exif);
    const cv::Mat3b upright = base::read_rgb(folder_.with("a.jpg", jpeg));
    ASSERT_EQ(upright.size(), cv::Size(16, 32));
    EXPECT_GT(upright(4, 8)[0], 200);
    EXPECT_LT(upright(28, 8)[0], 50);
    const cv::Mat1b mask = base::read_mask(folder_ / "a.jpg");
    ASSERT_EQ(mask.size(), cv::Size(16, 32));
    EXPECT_EQ(mask(4, 8), 255);
    EXPECT_EQ(mask(28, 8), 0);
}

TEST_F(PictureFile, MaskIsLuminanceTimesAlphaAboveHalf)
{
    cv::Mat4b picture(1, 4);
    picture(0, 0) = {255, 255, 255, 255};
    picture(0, 1) = {255, 255, 255, 100};
    picture(0, 2) = {100, 100, 100, 255};
    picture(0, 3) = {200, 200, 200, 200};
    base::write_png(folder_ / "a.png", picture);
    const cv::Mat1b mask = base::read_mask(folder_ / "a.png");
    EXPECT_EQ(std::vector<uchar>(mask.begin(), mask.end()), (std::vector<uchar>{255, 0, 0, 255}));
    base::write_png(folder_ / "b.png", cv::Mat1b(2, 2, uchar(128)));
    EXPECT_EQ(base::read_mask(folder_ / "b.png")(0, 0), 255);
}

TEST_F(PictureFile, ExrKeepsLinearFloats)
{
    cv::Mat3f picture(5, 7, cv::Vec3f(0.25f, 1e-3f, 1000.5f));
    base::write_exr(folder_ / "a.exr", picture);
    const cv::Mat read = cv::imread((folder_ / "a.exr").string(), cv::IMREAD_UNCHANGED);
    ASSERT_EQ(read.type(), CV_32FC3);
    EXPECT_EQ(read.at<cv::Vec3f>(4, 6), cv::Vec3f(1000.5f, 1e-3f, 0.25f));
}

TEST_F(PictureFile, MissingForeignAndEmptyFilesAreRefused)
{
    EXPECT_THAT(refusal([&] { base::read_rgb(folder_ / "absent.png"); }),
                HasSubstr("absent.png: there is no such file"));
    EXPECT_THAT(refusal([&] { base::read_rgb(folder_.path()); }), HasSubstr("not a regular file"));
    EXPECT_THAT(refusal([&] { base::read_rgb(folder_.with("a", "")); }), HasSubstr("empty"));
    EXPECT_THAT(refusal([&] { base::read_mask(folder_.with("a", "P3 some text")); }),
                HasSubstr("not a picture"));
    EXPECT_THAT(refusal([&] { base::read_rgb("/dev/zero"); }), HasSubstr("not a regular file"));
}

TEST_F(PictureFile, EveryTruncationIsRefused)
{
    for (const char* extension : {".png", ".jpg"}) {
        const std::string bytes = encoded(extension, noise(24, 24));
        for (std::size_t length = 1; length < bytes.size(); length += 1 + bytes.size() / 150) {
            const auto path = folder_.with("a", bytes.substr(0, length));
            EXPECT_NE(refusal([&] { base::read_rgb(path); }), "") << extension << " " << length;
        }
    }
}

TEST_F(PictureFile, JpegWithDataAfterItsEndIsRead)
{
    const auto path =
        folder_.with("a.jpg", encoded(".jpg", noise(24, 24)) + "a film, as telephones append it");
    EXPECT_EQ(base::read_rgb(path).size(), cv::Size(24, 24));
}

TEST_F(PictureFile, AbsurdSizesAreRefusedBeforeDecoding)
{
    std::string bytes = encoded(".png", noise(4, 4));
    bytes[18] = '\x7f'; // IHDR's width
    EXPECT_THAT(refusal([&] { base::read_rgb(folder_.with("a.png", bytes)); }),
                HasSubstr("make it at most 16384"));
}

TEST_F(PictureFile, DamagedPicturesNeverCrashAndNothingIsPrinted)
{
    std::mt19937 random(11);
    testing::internal::CaptureStderr();
    for (const char* extension : {".png", ".jpg", ".bmp", ".tiff", ".webp"}) {
        const std::string sound = encoded(extension, noise(16, 16));
        for (int round = 0; round < 300; ++round) {
            std::string bytes = sound;
            for (unsigned flips = 1 + random() % 6; flips > 0; --flips)
                bytes[random() % bytes.size()] = static_cast<char>(random());
            const auto path = folder_.with("a", bytes);
            refusal([&] { base::read_rgb(path); });
            refusal([&] { base::read_mask(path); });
        }
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(PictureFile, AFailedWriteLeavesTheOldFileAndNoTemporary)
{
    const auto path = folder_.with("a.txt", "old");
    EXPECT_THROW(base::write_atomically(path,
                                        [](const std::filesystem::path& temporary) {
                                            std::ofstream(temporary) << "half";
                                            throw std::runtime_error("stop");
                                        }),
                 std::runtime_error);
    std::string content;
    std::ifstream(path) >> content;
    EXPECT_EQ(content, "old");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1);
}

TEST_F(PictureFile, UnwritablePlacesAreNamed)
{
    const cv::Mat3b picture(2, 2, cv::Vec3b(1, 2, 3));
    EXPECT_THAT(refusal([&] { base::write_png(folder_ / "no/such/a.png", picture); }),
                HasSubstr("there is no folder"));
    EXPECT_THAT(refusal([&] { base::write_png(folder_.path(), picture); }), HasSubstr("cannot be written"));
}

} // namespace
