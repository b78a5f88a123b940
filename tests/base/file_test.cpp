// A file is written whole or not at all, at whatever byte the disk becomes full.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "base/file.hpp"
#include "base/image_io.hpp"
#include "base/input_error.hpp"
#include "tests/support/full_disk.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using testing::HasSubstr;

std::string content(const std::filesystem::path& path)
{
    const std::vector<std::uint8_t> bytes = base::read_file(path, 1 << 20);
    return {bytes.begin(), bytes.end()};
}

/// Checks that `write(path)` on a disk with room for `bytes` fails, that the message names `path`, not the
/// temporary file, and that only the old file is left.
template <typename Write>
void expect_old_file_kept(const char* name, rlim_t bytes, Write write)
{
    const TemporaryFolder folder;
    const auto path = folder.with(name, "old");
    std::string message;
    {
        const FullDisk disk(bytes);
        try {
            write(path);
        } catch (const base::InputError& error) {
            message = error.what();
        }
    }
    EXPECT_THAT(message, HasSubstr(path.string() + ": cannot be written")) << name << ", room for " << bytes;
    EXPECT_EQ(content(path), "old") << name;
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1) << name;
}

TEST(FileOnAFullDisk, KeepsItsOldContent)
{
    const cv::Mat3b noise(64, 64);
    cv::randu(noise, 0, 255);
    const cv::Mat3f light(64, 64, cv::Vec3f(1, 2, 3));
    for (const rlim_t room : {0, 1, 100, 1000}) {
        expect_old_file_kept("a.csv", room,
                             [](const auto& path) { base::write_text(path, std::string(5000, 'x')); });
        expect_old_file_kept("a.json", room,
                             [](const auto& path) { base::write_json(path, std::vector<int>(2000, 7)); });
        expect_old_file_kept("a.png", room, [&](const auto& path) { base::write_png(path, noise); });
        expect_old_file_kept("a.exr", room, [&](const auto& path) { base::write_exr(path, light); });
    }
}

TEST(File, IsWrittenWhole)
{
    const TemporaryFolder folder;
    base::write_text(folder / "a.txt", "one\ntwo\n");
    EXPECT_EQ(content(folder / "a.txt"), "one\ntwo\n");
    base::write_text(folder / "a.txt", "");
    EXPECT_EQ(std::filesystem::file_size(folder / "a.txt"), 0u);
}

TEST(Json, NestedTooDeeplyIsRefused)
{
    const TemporaryFolder folder;
    const auto nested = [](std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
    EXPECT_EQ(base::read_json(folder.with("good.json", nested(100))).size(), 1u);
    for (const std::string& deep :
         {nested(101), nested(200'000), "{\"a\": " + nested(100) + "}", std::string(200'000, '[')})
        try {
            base::read_json(folder.with("deep.json", deep));
            ADD_FAILURE() << "nothing was refused";
        } catch (const base::InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr("deep.json: nests arrays and objects more than 100 deep"));
        }
    // Brackets inside a string, also behind an escaped quote, nest nothing.
    const std::string brackets(1000, '[');
    EXPECT_EQ(base::read_json(folder.with("text.json", "[\"a\\\"" + brackets + "\\\\\"]"))[0],
              "a\"" + brackets + "\\");
}

TEST(Json, NamesThatAreNotUtf8AreWrittenAllTheSame)
{
    const TemporaryFolder folder;
    base::write_json(folder / "a.json", {{"photo", "p\xffq.png"}});
    EXPECT_EQ(base::read_json(folder / "a.json").at("photo"), "p\ufffdq.png");
}

TEST(FileVersion, ChangesWithThePathAndTheTime)
{
    const TemporaryFolder folder;
    const auto path = folder.with("a.txt", "x");
    const std::string before = base::file_version(path);
    EXPECT_EQ(base::file_version(path), before);
    EXPECT_NE(base::file_version(folder.with("b.txt", "x")), before);
    std::filesystem::last_write_time(path, std::filesystem::last_write_time(path) + std::chrono::seconds(1));
    EXPECT_NE(base::file_version(path), before);
    EXPECT_NO_THROW(base::file_version(folder / "absent"));
}

} // namespace
