// `cicatrix capture --gallery`, as a process.
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/image_io.hpp"
#include "tests/support/process.hpp"
#include "tests/support/small_head.hpp"
#include "tests/support/temporary_folder.hpp"
#include "wound/synthetic/kind.hpp"

namespace {

using testing::HasSubstr;

class Gallery : public testing::Test
{
  protected:
    Outcome draw(std::vector<std::string> more) const
    {
        more.insert(more.begin(), {"capture", "--gallery", "--head", small::saved(small::head()).string(),
                                   "--out", out().string()});
        return run_program(more);
    }
    std::filesystem::path out() const { return folder_ / "out"; }

    TemporaryFolder folder_;
};

} // namespace

TEST_F(Gallery, IsOnePageOfAllKindsOfWound)
{
    const Outcome outcome = draw({"--size", "100x80", "--days", "0,9"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto record = nlohmann::json::parse(std::ifstream(out() / "gallery.json"));
    EXPECT_EQ(record.at("pictures").size(), 2 * wound::kind_names().size());
    for (const auto& picture : record.at("pictures"))
        EXPECT_EQ(picture.at("unhealed_ratio") == 1, picture.at("day") == 0) << picture;
    EXPECT_GT(base::read_rgb(out() / "gallery.png").rows, int(wound::kind_names().size()) * 80);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(out()), {}), 2);
}

TEST_F(Gallery, IsNoFilm)
{
    const Outcome outcome = draw({"--orbit", "4"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("--gallery"), HasSubstr("--orbit")));
    EXPECT_FALSE(std::filesystem::exists(out()));
}
