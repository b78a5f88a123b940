// Batches: tables of variations, shares, resuming after a stop, and the resulting COCO documents.
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "apps/batch/batch.hpp"
#include "apps/batch/name_locks.hpp"
#include "apps/batch/variations.hpp"
#include "base/file.hpp"
#include "base/image_io.hpp"
#include "base/input_error.hpp"
#include "base/json_fields.hpp"
#include "shaders/shared/labels.h"
#include "stage/coco.hpp"
#include "tests/support/full_disk.hpp"
#include "tests/support/process.hpp"
#include "tests/support/small_head.hpp"
#include "tests/support/temporary_folder.hpp"
#include "wound/synthetic/kind.hpp"

namespace {

using batch_command::Variation;
using nlohmann::json;
using testing::HasSubstr;

/// Decodes an uncompressed mask like pycocotools: column by column, the first run is outside.
cv::Mat1b decoded(const json& rle)
{
    cv::Mat1b mask = cv::Mat1b::zeros(rle.at("size")[0], rle.at("size")[1]);
    int at = 0;
    bool inside = false;
    for (const json& run : rle.at("counts")) {
        for (int k = 0; k < run.get<int>(); ++k, ++at)
            mask(at % mask.rows, at / mask.rows) = inside ? 255 : 0;
        inside = !inside;
    }
    EXPECT_EQ(at, int(mask.total()));
    return mask;
}

bool same(const cv::Mat1b& a, const cv::Mat1b& b)
{
    return a.size() == b.size() && cv::countNonZero((a != 0) != (b != 0)) == 0;
}

/// Checks the ids, picture sizes, areas and boxes of a COCO document against its pictures and masks.
void expect_sound(const json& coco, const std::filesystem::path& folder)
{
    std::set<int> images, regions, categories;
    for (const json& category : coco.at("categories"))
        categories.insert(category.at("id").get<int>());
    for (const json& image : coco.at("images")) {
        EXPECT_TRUE(images.insert(image.at("id").get<int>()).second);
        const cv::Mat3b picture = base::read_rgb(folder / image.at("file_name").get<std::string>());
        EXPECT_EQ(picture.size(), cv::Size(image.at("width"), image.at("height")));
    }
    for (const json& region : coco.at("annotations")) {
        EXPECT_TRUE(regions.insert(region.at("id").get<int>()).second);
        EXPECT_TRUE(images.contains(region.at("image_id").get<int>()));
        EXPECT_TRUE(categories.contains(region.at("category_id").get<int>()));
        EXPECT_EQ(region.at("iscrowd"), 0);
        const cv::Mat1b mask = decoded(region.at("segmentation"));
        EXPECT_EQ(region.at("area"), cv::countNonZero(mask));
        const json& box = region.at("bbox");
        EXPECT_EQ(cv::boundingRect(mask), cv::Rect(box[0], box[1], box[2], box[3]));
    }
}

std::string refusal(const std::function<void()>& work)
{
    try {
        work();
    } catch (const base::InputError& error) {
        return error.what();
    }
    return "nothing was refused";
}

class Batch : public testing::Test
{
  protected:
    std::vector<Variation> read(const std::string& table, const scene::Scene& base = {}) const
    {
        return batch_command::read_variations(folder_.with("table.csv", table), base);
    }
    std::string refused(const std::string& table) const
    {
        return refusal([&] {
            for (const Variation& variation : read(table))
                batch_command::check_files(variation);
        });
    }
    Outcome batch(std::vector<std::string> more) const
    {
        more.insert(more.begin(), {"batch", (folder_ / "table.csv").string(), "--head", head_, "--size",
                                   "96x64", "--labels"});
        return run_program(more);
    }
    TemporaryFolder folder_;
    const std::string head_ = small::saved(small::head()).string();
};

} // namespace

TEST(Coco, MasksSurviveTheirRunLengths)
{
    cv::Mat1b mask = cv::Mat1b::zeros(7, 5);
    EXPECT_EQ(stage::run_lengths(mask).at("counts"), json({35}));
    mask(0, 0) = mask(6, 1) = mask(0, 2) = mask(3, 4) = mask(4, 4) = 255;
    const json rle = stage::run_lengths(mask);
    EXPECT_EQ(rle.at("size"), json({7, 5}));
    EXPECT_EQ(rle.at("counts")[0], 0) << "the first run is outside the mask";
    EXPECT_TRUE(same(decoded(rle), mask));
    mask.setTo(255);
    EXPECT_EQ(stage::run_lengths(mask).at("counts"), json({0, 35}));
}

TEST(Coco, JoinedDocumentsKeepTheirRegionsAtTheirImages)
{
    cv::Mat1b mask = cv::Mat1b::zeros(4, 4);
    mask(1, 2) = 255;
    stage::Coco one, all;
    one.add_region(one.add_image("a.png", mask.size(), {{"day", 3}}), stage::CocoCategory::OpenBed, mask, {});
    one.add_region(one.add_image("b.png", mask.size(), {}), stage::CocoCategory::Wound, mask, {});
    one.add_region(1, stage::CocoCategory::NewEpithelium, cv::Mat1b::zeros(4, 4), {}); // empty
    all.join(one.document(), "first");
    all.join(one.document(), "second");
    const json joined = all.document();
    ASSERT_EQ(joined.at("images").size(), 4u);
    ASSERT_EQ(joined.at("annotations").size(), 4u);
    EXPECT_EQ(joined.at("images")[2].at("file_name"), "second/a.png");
    EXPECT_EQ(joined.at("images")[2].at("day"), 3);
    EXPECT_EQ(joined.at("annotations")[3].at("image_id"), joined.at("images")[3].at("id"));
    EXPECT_EQ(joined.at("annotations")[3].at("id"), 4);
}

TEST_F(Batch, RowsChangeTheFieldsTheyName)
{
    scene::Scene base;
    base.exposure_stops = 1.5;
    base.wounds[0].photo = "old.png";
    base.wounds[0].mask = "old_mask.png";
    const auto rows =
        read("name,wounds.0.width_mm,wounds.0.at,wounds.0.photo,days,wounds.1.at,lights.0.azimuth_deg\r\n"
             "a,12.5,\"[0.1, 0.2]\",new.png,\"0,5\",chin,-20\r\n"
             "\r\n"
             "b,,cheek,,7,,\r\n",
             base);
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].name, "a");
    EXPECT_EQ(rows[0].scene.wounds.size(), 2u);
    EXPECT_EQ(rows[0].scene.wounds[0].width_mm, 12.5);
    EXPECT_EQ(std::get<head::FacePoint>(rows[0].scene.wounds[0].place).y, .2);
    EXPECT_EQ(rows[0].scene.wounds[0].photo, folder_ / "new.png");
    EXPECT_TRUE(rows[0].scene.wounds[0].mask.empty()) << "the mask belonged to the old photograph";
    EXPECT_EQ(rows[0].scene.days, (std::vector<double>{0, 5}));
    EXPECT_EQ(rows[0].scene.lights[0].from.azimuth_deg, -20);
    EXPECT_EQ(rows[0].scene.lights[0].intensity, base.lights[0].intensity);
    EXPECT_EQ(rows[0].scene.exposure_stops, 1.5);
    EXPECT_EQ(rows[1].scene.wounds.size(), 1u);
    EXPECT_EQ(rows[1].scene.wounds[0].width_mm, base.wounds[0].width_mm);
    EXPECT_EQ(rows[1].scene.wounds[0].mask.filename(), "old_mask.png");
    EXPECT_EQ(rows[1].scene.days, std::vector<double>{7});
}

TEST_F(Batch, ScenesCanBeColumnsAndFolders)
{
    folder_.with("wide.json", R"({"wounds": [{"width_mm": 50}], "days": "4"})");
    const auto rows = read("scene,wounds.0.seed\nwide.json,9\n,10\n");
    EXPECT_EQ(rows[0].scene.wounds[0].width_mm, 50);
    EXPECT_EQ(rows[0].scene.wounds[0].seed, 9u);
    EXPECT_EQ(rows[1].scene.wounds[0].width_mm, scene::Wound{}.width_mm);
    EXPECT_EQ(rows[0].name, "0001");

    TemporaryFolder scenes;
    scenes.with("b.json", "{}");
    scenes.with("a.json", R"({"days": "3"})");
    scenes.with("notes.txt", "no scene");
    const auto files = batch_command::read_variations(scenes / ".", {});
    ASSERT_EQ(files.size(), 2u);
    EXPECT_EQ(files[0].name, "a");
    EXPECT_EQ(files[0].scene.days, std::vector<double>{3});
}

TEST_F(Batch, BadTablesAreRefusedByLineAndColumn)
{
    EXPECT_THAT(refused("wounds.0.width_mm\n12\n900\n"),
                testing::AllOf(HasSubstr("table.csv: line 3, column wounds.0.width_mm: is 900"),
                               HasSubstr("from 1 to 200")));
    EXPECT_THAT(refused("wounds.0.widht\n3\n"),
                HasSubstr("line 2, column wounds.0.widht: is not a known field"));
    EXPECT_THAT(refused("wounds.2.seed\n3\n"), HasSubstr("column wounds.2.seed"));
    EXPECT_THAT(refused("size.x\n3\n"), HasSubstr("column size.x"));
    EXPECT_THAT(refused("a,b\n3\n"), HasSubstr("has 1 cells, the header 2"));
    EXPECT_THAT(refused("days,days\n3,4\n"), HasSubstr("occurs twice"));
    EXPECT_THAT(refused("name\nx\nx\n"), HasSubstr("line 3, column name: \"x\" occurs twice"));
    EXPECT_THAT(refused("name\n../x\n"), HasSubstr("not a valid folder name"));
    EXPECT_THAT(refused("days\n"), HasSubstr("holds no variations"));
    EXPECT_THAT(refused("days\n\"3\n"), HasSubstr("unclosed quote"));
    const std::string deep = std::string(200'000, '[') + std::string(200'000, ']');
    EXPECT_THAT(refused("size\n\"" + deep + "\"\n"), HasSubstr("line 2, column size: nests arrays"));
    EXPECT_THAT(refused("wounds.0.photo\nx\xffy.png\n"),
                HasSubstr("line 2, column wounds.0.photo: is not UTF-8"));
    const std::string on_a_head = "head,wounds.0.at,wounds.0.photo,tissue\n" + head_;
    EXPECT_THAT(refused(on_a_head + ",elbow,,\n"), HasSubstr("column wounds.0.at: \"elbow\""));
    EXPECT_THAT(refused(on_a_head + ",chin,none.png,\n"),
                HasSubstr("column wounds.0.photo: there is no file"));
    EXPECT_THAT(refused(on_a_head + ",chin,,none.json\n"), HasSubstr("column tissue"));
    EXPECT_EQ(refused(on_a_head + ",chin,,dark\n"), "nothing was refused");
}

TEST(Shares, AreDisjointAndTogetherAll)
{
    for (const std::size_t count : {1u, 7u, 16u, 100u})
        for (const std::size_t shares : {1u, 3u, 16u}) {
            std::multiset<std::size_t> seen;
            std::size_t smallest = count, largest = 0;
            for (std::size_t share = 1; share <= shares; ++share) {
                const auto mine = batch_command::share_of(count, share, shares);
                seen.insert(mine.begin(), mine.end());
                smallest = std::min(smallest, mine.size());
                largest = std::max(largest, mine.size());
            }
            EXPECT_EQ(seen.size(), count);
            EXPECT_EQ(std::set<std::size_t>(seen.begin(), seen.end()).size(), count);
            EXPECT_LE(largest - smallest, 1u);
        }
}

TEST_F(Batch, RandomTablesAreReproducibleAndValid)
{
    batch_command::RandomVariations options{.count = 200, .seed = 5};
    const std::string table = batch_command::random_variations(options);
    EXPECT_EQ(table, batch_command::random_variations(options));
    const auto rows = read(table);
    ASSERT_EQ(rows.size(), 200u);
    std::set<std::string> tissues, kinds;
    std::set<double> days;
    for (const Variation& row : rows) {
        tissues.insert(row.scene.tissue);
        kinds.insert(row.scene.wounds[0].kind);
        days.insert(row.scene.days[0]);
    }
    EXPECT_EQ(tissues.size(), 3u);
    EXPECT_EQ(kinds.size(), wound::kind_names().size());
    EXPECT_GT(days.size(), 20u);
    options.seed = 6;
    EXPECT_NE(table, batch_command::random_variations(options));
    options.photos = {"a, b.png", "c.png"};
    options.heads = {head_};
    std::set<std::string> photos;
    for (const Variation& row : read(batch_command::random_variations(options)))
        photos.insert(row.scene.wounds[0].photo.filename());
    EXPECT_EQ(photos, (std::set<std::string>{"a, b.png", "c.png"}));
}

TEST_F(Batch, SharesCompleteTheBatchAndAStoppedBatchResumes)
{
    folder_.with("table.csv", "name,wounds.0.width_mm,days\nsmall,14,0\nlarge,40,\"0,9\"\nlate,30,12\n");
    const std::string out = (folder_ / "out").string();
    ASSERT_EQ(batch({"--out", out, "--share", "1/2"}).code, 0);
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out/small/variation.json"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out/large"));
    const Outcome early = batch({"--out", out, "--merge"});
    EXPECT_EQ(early.code, 1);
    EXPECT_THAT(early.err, HasSubstr("1 of 3 variations are not finished, the first is large"));

    // A half-drawn variation and one with a changed row are drawn again; a finished one is kept.
    std::filesystem::create_directories(folder_ / "out/.large.partial");
    folder_.with("out/.large.partial/day_000.png", "half");
    const auto untouched = std::filesystem::last_write_time(folder_ / "out/small/variation.json");
    folder_.with("table.csv", "name,wounds.0.width_mm,days\nsmall,14,0\nlarge,40,\"0,9\"\nlate,30,15\n");
    const Outcome rest = batch({"--out", out});
    ASSERT_EQ(rest.code, 0) << rest.err;
    EXPECT_THAT(rest.out, HasSubstr("2 variations drawn, 1 kept, 0 failed"));
    EXPECT_EQ(std::filesystem::last_write_time(folder_ / "out/small/variation.json"), untouched);
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out/late/day_015.png"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out/late/day_012.png"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out/.large.partial"));

    const json coco = base::read_json(folder_ / "out/coco.json");
    EXPECT_EQ(coco.at("images").size(), 4u);
    expect_sound(coco, folder_ / "out");
    const json index = base::read_json(folder_ / "out/batch.json");
    EXPECT_EQ(index.at("variations")[1].at("pictures")[1].at("file"), "large/day_009.png");
    std::ifstream table(folder_ / "out/measurements.csv");
    std::string line;
    int lines = 0;
    while (std::getline(table, line))
        ++lines;
    EXPECT_EQ(lines, 5);
}

TEST_F(Batch, TwoBatchesDoNotDrawTheSameVariationIntoOneFolder)
{
    const auto out = folder_ / "out";
    std::filesystem::create_directories(out);
    std::filesystem::create_directories(out / ".one.partial"); // what the other batch is drawing
    {
        batch_command::NameLocks other(out);
        other.take("one");
        folder_.with("table.csv", "name,days\ntwo,0\none,0\n");
        const Outcome refused = batch({"--out", out.string()});
        EXPECT_EQ(refused.code, 1);
        EXPECT_THAT(refused.err, HasSubstr("another batch is drawing \"one\" here"));
        EXPECT_TRUE(std::filesystem::exists(out / ".one.partial"));
        EXPECT_FALSE(std::filesystem::exists(out / "two"));
        EXPECT_EQ(batch({"--out", out.string(), "--share", "1/2"}).code, 0); // two alone
    }
    const Outcome after = batch({"--out", out.string()});
    EXPECT_EQ(after.code, 0) << after.err;
    EXPECT_THAT(after.out, HasSubstr("1 variations drawn, 1 kept, 0 failed"));
}

/// Killed after the old variation was set aside and before the new one replaced it.
TEST_F(Batch, ResumesAfterAKillDuringTheReplacementOfAVariation)
{
    folder_.with("table.csv", "name,days\none,0\n");
    const auto out = folder_ / "out";
    ASSERT_EQ(batch({"--out", out.string()}).code, 0);
    std::filesystem::rename(out / "one", out / ".one.replaced");
    const Outcome again = batch({"--out", out.string()});
    ASSERT_EQ(again.code, 0) << again.err;
    EXPECT_THAT(again.out, HasSubstr("0 variations drawn, 1 kept, 0 failed"));

    // The same with a changed row: the variation set aside is replaced again, and no folder is left over.
    std::filesystem::rename(out / "one", out / ".one.replaced");
    folder_.with("table.csv", "name,days\none,3\n");
    ASSERT_EQ(batch({"--out", out.string()}).code, 0);
    EXPECT_TRUE(std::filesystem::exists(out / "one/day_003.png"));
    EXPECT_FALSE(std::filesystem::exists(out / ".one.replaced"));
}

TEST_F(Batch, MergingOnAFullDiskFailsAndKeepsTheOldFiles)
{
    folder_.with("table.csv", "name,days\none,0\n");
    const auto out = folder_ / "out";
    ASSERT_EQ(batch({"--out", out.string()}).code, 0);
    const std::vector<std::uint8_t> before = base::read_file(out / "measurements.csv", 1 << 20);
    scene::Scene scene;
    scene.head = head_;
    scene.size = {96, 64};
    const std::vector<batch_command::Variation> variations =
        batch_command::read_variations(folder_ / "table.csv", scene);
    const FullDisk disk(1);
    EXPECT_THROW(batch_command::merge_batch(variations, {.out = out, .views = {}, .labels = true}),
                 base::InputError);
    EXPECT_EQ(base::read_file(out / "measurements.csv", 1 << 20), before);
}

TEST_F(Batch, AFailingVariationDoesNotStopTheOthers)
{
    base::write_png(folder_ / "blank.png", cv::Mat3b(64, 64, cv::Vec3b(200, 160, 140)));
    folder_.with("broken.glb", "no head");
    folder_.with("table.csv", "name,head,wounds.0.photo,wounds.0.at,days\n"
                              "bad,,blank.png,,0\n"
                              "good,,,,0\n"
                              "headless,broken.glb,,,0\n"
                              "astray,,,\"[2.9, 2.9]\",0\n"
                              "worse,,blank.png,,0\n"
                              "late,,,chin,9\n");
    const Outcome outcome = batch({"--out", (folder_ / "out").string()});
    EXPECT_EQ(outcome.code, 1);
    for (const char* name : {"bad", "headless", "astray", "worse"}) {
        EXPECT_THAT(outcome.err, HasSubstr(fmt::format("failed: {}: ", name)));
        EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / name));
    }
    EXPECT_THAT(outcome.err, HasSubstr("4 of 6 variations failed"));
    for (const char* name : {"good", "late"})
        EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / name / "variation.json"));
}

TEST_F(Batch, VariationsDoNotDependOnEarlierOnes)
{
    std::filesystem::copy_file(head_, folder_ / "other.glb");
    folder_.with("table.csv",
                 "name,head,tissue,wounds.0.kind,wounds.0.at,wounds.1.at,lights.0.azimuth_deg,days\n"
                 "a,,light,laceration,cheek,chin,-40,5\n"
                 "b,other.glb,dark,avulsion,forehead,,30,\"2,20\"\n"
                 "c,,light,laceration,cheek,,-40,5\n");
    ASSERT_EQ(batch({"--out", (folder_ / "together").string()}).code, 0);
    for (const char* share : {"1/3", "2/3", "3/3"})
        ASSERT_EQ(batch({"--out", (folder_ / "alone").string(), "--share", share}).code, 0);
    int pictures = 0;
    for (const auto& file : std::filesystem::recursive_directory_iterator(folder_ / "alone")) {
        if (file.path().extension() != ".png" && file.path().extension() != ".exr")
            continue;
        const auto twin = folder_ / "together" / std::filesystem::relative(file.path(), folder_ / "alone");
        constexpr std::size_t most_bytes = 1 << 20;
        EXPECT_TRUE(base::read_file(file.path(), most_bytes) == base::read_file(twin, most_bytes)) << twin;
        ++pictures;
    }
    EXPECT_GT(pictures, 20);
}

TEST_F(Batch, CaptureWritesLabelsBesideItsPictures)
{
    const std::filesystem::path out = folder_ / "out";
    const Outcome outcome =
        run_program({"capture", "--head", head_, "--size", "160x120", "--days", "0,9", "--views",
                     "front,close-up", "--tile", "64", "--labels", "--no-cost", "--out", out.string()});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const json labels = base::read_json(out / "labels.json");
    ASSERT_EQ(labels.at("frames").size(), 4u);
    expect_sound(base::read_json(out / "coco.json"), out);
    for (const json& frame : labels.at("frames")) {
        const json& files = frame.at("labels");
        for (const auto& [what, file] : files.items())
            EXPECT_TRUE(std::filesystem::exists(out / file.get<std::string>())) << what;
        const cv::Mat1b mask = base::read_mask(out / files.at("mask").get<std::string>());
        const json& wound = frame.at("wounds")[0];
        EXPECT_EQ(wound.at("bed_px").get<int>() + wound.at("new_epithelium_px").get<int>(),
                  cv::countNonZero(mask));
        EXPECT_GT(wound.at("visible_fraction"), .9);
        EXPECT_GT(wound.at("bed_mm2"), 50);
        EXPECT_TRUE(frame.contains("camera"));
    }
    // The size of the wound does not depend on the view.
    EXPECT_EQ(labels.at("frames")[0].at("wounds")[0].at("bed_mm2"),
              labels.at("frames")[1].at("wounds")[0].at("bed_mm2"));
}
