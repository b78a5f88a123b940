// The reflectance table on the CPU, its cache, and the commands `reflect` and `bake`.
#include <fstream>
#include <gmock/gmock.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <unistd.h>

#include "apps/bake/bake.hpp"
#include "apps/reflect/reflect.hpp"
#include "base/file.hpp"
#include "base/image_io.hpp"
#include "base/input_error.hpp"
#include "base/progress.hpp"
#include "passes/reflectance_lut.hpp"
#include "tests/support/gpu.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tools/lab/reflectance.hpp"
#include "wound/optics/chromophores.hpp"
#include "wound/optics/tissue_choice.hpp"
#include "wound/reflectance_table.hpp"

namespace {

class Folder : public testing::Test
{
  protected:
    Folder()
    {
        path = std::filesystem::temp_directory_path() /
               (testing::UnitTest::GetInstance()->current_test_info()->name() + std::to_string(getpid()));
        std::filesystem::create_directories(path);
    }
    ~Folder() override { std::filesystem::remove_all(path); }

    std::vector<std::filesystem::path> files() const
    {
        std::vector<std::filesystem::path> result;
        for (const auto& entry : std::filesystem::directory_iterator(path))
            result.push_back(entry.path());
        return result;
    }
    std::filesystem::path path;
};

using TableCache = Folder;
using Commands = Folder;

bool same(const cv::Mat3f& a, const cv::Mat3f& b)
{
    return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
}

} // namespace

TEST(ReflectanceTable, SamplingInterpolatesWithinThePromisedError)
{
    const optics::HealingTissue light = optics::skin(optics::SkinTone::Light);
    const wound::LutRows rows = wound::lut_rows(light, wound::Healing{}, 64, 60);
    const cv::Mat3f table =
        wound::bake_reflectance_table(rows.days, 64, optics::ReflectanceModel::Calibrated);
    double sum = 0;
    int count = 0;
    for (shared::uint part : {shared::LUT_OPEN, shared::LUT_COVERED})
        for (double depth : {0., .03, .1, .15, .4, .9, 1.7, 3.})
            for (double day : {0., .7, 2.5, 6., 13., 21., 29., 47.}) {
                const base::Color direct =
                    optics::tissue_color(optics::layers_at(wound::tissue_on(light, part, day), depth),
                                         optics::ReflectanceModel::Calibrated);
                const double error =
                    cv::norm(wound::sample_table(table, rows.axes, part, depth, day) - direct);
                sum += error * error;
                ++count;
            }
    EXPECT_LT(std::sqrt(sum / count / 3), .004);
    // Exact at the nodes, including those where the two parts meet.
    for (const auto& [part, day, row] : {std::tuple(shared::LUT_OPEN, 1e9, 63u),
                                         {shared::LUT_COVERED, 0., 64u},
                                         {shared::LUT_COVERED, 1e9, 127u}})
    {
        const base::Color corner = optics::tissue_color(
            optics::layers_at(rows.days[row], rows.axes.deepest_mm), optics::ReflectanceModel::Calibrated);
        EXPECT_LT(cv::norm(wound::sample_table(table, rows.axes, part, 1e9, day) - corner), 1e-6) << row;
    }
}

TEST_F(TableCache, IsReadBackAndKeyedByAllInputs)
{
    std::vector<optics::TissueDay> rows(4, optics::restored_skin(optics::table1(), 1));
    const cv::Mat3f table = wound::cached_reflectance_table(
        path, rows, 4, optics::ReflectanceModel::AddingDoubling, {.angles = 2});
    ASSERT_EQ(files().size(), 1u);
    const auto written = std::filesystem::last_write_time(files()[0]);
    EXPECT_TRUE(same(wound::cached_reflectance_table(path, rows, 4, optics::ReflectanceModel::AddingDoubling,
                                                     {.angles = 2}),
                     table));
    EXPECT_EQ(std::filesystem::last_write_time(files()[0]), written);
    wound::cached_reflectance_table(path, rows, 4, optics::ReflectanceModel::AddingDoubling, {.angles = 3});
    EXPECT_EQ(files().size(), 2u);
    rows[2].intact.layers[1].sigma_a[2] *= 1.0000001;
    wound::cached_reflectance_table(path, rows, 4, optics::ReflectanceModel::AddingDoubling, {.angles = 2});
    EXPECT_EQ(files().size(), 3u);
}

TEST_F(TableCache, ADamagedFileIsBakedAgain)
{
    const std::vector<optics::TissueDay> rows(3, optics::restored_skin(optics::table1(), 1));
    const cv::Mat3f table =
        wound::cached_reflectance_table(path, rows, 4, optics::ReflectanceModel::TwoStream);
    for (const std::string& damage : {std::string(), std::string(4 * 3 * 12, '\xff'), std::string(1000, 'x')})
    {
        std::ofstream(files().at(0), std::ios::binary) << damage;
        EXPECT_TRUE(
            same(wound::cached_reflectance_table(path, rows, 4, optics::ReflectanceModel::TwoStream), table));
    }
    // A folder that cannot be created only costs time.
    std::ofstream(path / "file") << "";
    EXPECT_TRUE(same(wound::cached_reflectance_table(path / "file" / "below", rows, 4,
                                                     optics::ReflectanceModel::TwoStream),
                     table));
}

using UploadedTable = gpu_test::Test;

TEST_F(UploadedTable, EqualsTheTableThatTheShaderBakes)
{
    const std::vector<optics::TissueDay> rows =
        wound::lut_rows(optics::skin(optics::SkinTone::Medium), wound::Healing{}, 4, 60).days;
    const cv::Mat3f table = wound::bake_reflectance_table(rows, 8, optics::ReflectanceModel::TwoStream);
    gpu::Executor executor(gpu_test::device(), gpu_test::shaders());
    graph::Graph graph;
    const auto lut = passes::add_reflectance_lut(graph, "lut", passes::lut_tissue(rows, 60),
                                                 optics::ReflectanceModel::TwoStream, 8);
    const graph::ReadbackId back = graph.readback("lut", lut.reflectance);
    cv::Mat4f baked;
    const gpu::FrameResult frame = executor.run(graph);
    frame.mat(back).convertTo(baked, CV_32F);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(baked(y, x)[c], table(y, x)[c], 3e-5 + table(y, x)[c] * 0x1p-10);
    const gpu::Texture texture = passes::upload_reflectance_table(gpu_test::device(), table, "table");
    EXPECT_EQ(texture.external().desc.format, VK_FORMAT_R16G16B16A16_SFLOAT);
    EXPECT_EQ(texture.external().desc.width, 8u);
}

TEST_F(Commands, ReflectPrintsOneObjectWithAllFields)
{
    std::ofstream(path / "one.json")
        << R"({"unit":"1/cm","layers":[{"name":"slab","sigma_a":10,"sigma_s":90,"g":0.75,"n":1,
                                            "thickness_mm":0.2}]})";
    reflect_command::ReflectOptions options{.tissue = (path / "one.json").string(),
                                            .model = optics::ReflectanceModel::AddingDoubling};
    options.reflectance_options.incidence = optics::Incidence::Normal;
    std::ostringstream out, notes;
    reflect_command::reflect(options, out, notes);
    const auto json = nlohmann::json::parse(out.str());
    EXPECT_NEAR(json.at("r").get<double>(), .09739, 2e-4); // van de Hulst; one wavelength: numbers, not lists
    EXPECT_NEAR(json.at("t").get<double>(), .66096, 2e-4);
    EXPECT_EQ(json.at("r_without_specular"), json.at("r"));
    EXPECT_NEAR(json.at("absorbed").at(0).get<double>(), 1 - .09739 - .66096, 4e-4);
    EXPECT_EQ(json.at("standard_error"), 0);
    EXPECT_EQ(json.at("layers"), nlohmann::json({"slab"}));
    EXPECT_EQ(notes.str(), "");
    for (const auto& [model, list] : {std::pair{optics::ReflectanceModel::Printed, "outside_domain"},
                                      {optics::ReflectanceModel::Published, "limited"}})
    {
        options = {.tissue = "table1", .model = model};
        out.str("");
        notes.str("");
        reflect_command::reflect(options, out, notes);
        const auto paper = nlohmann::json::parse(out.str());
        EXPECT_EQ(paper.at("r").size(), 3u);
        EXPECT_EQ(paper.at("absorbed").size(), 3u);
        ASSERT_EQ(paper.at(list).size(), 5u);
        EXPECT_EQ(paper.at(list).at(0).at("layer"), "epidermis");
        EXPECT_EQ(paper.at(list).at(0).at("channel"), 1);
        EXPECT_EQ(paper.at("layers"), nlohmann::json({"epidermis", "dermis", "subcutis"}));
        EXPECT_THAT(notes.str(), testing::HasSubstr("5 of 9 layers and channels"));
    }
    options.tissue = "light";
    out.str("");
    reflect_command::reflect(options, out, notes);
    EXPECT_EQ(nlohmann::json::parse(out.str()).at("linear_rgb").size(), 3u);
}

TEST_F(Commands, AnInfiniteLayerHasNoPrintedReflectanceAndIsRefusedForWounds)
{
    const std::string file = (path / "deep.json").string();
    std::ofstream(file) << R"({"unit":"1/mm","layers":[
        {"name":"dermis","sigma_a":1,"sigma_s":9,"n":1.4,"thickness_mm":"inf"},
        {"name":"subcutis","sigma_a":1,"sigma_s":9,"n":1.4,"thickness_mm":1}]})";
    std::ostringstream out, notes;
    reflect_command::reflect({.tissue = file, .model = optics::ReflectanceModel::Printed}, out, notes);
    const auto json = nlohmann::json::parse(out.str());
    EXPECT_TRUE(json.at("r").is_null());
    EXPECT_EQ(json.at("outside_domain").at(0).at("thickness_mm"), "inf");
    EXPECT_THAT(notes.str(), testing::HasSubstr("infinite thickness"));
    for (const optics::ReflectanceModel model :
         {optics::ReflectanceModel::Published, optics::ReflectanceModel::TwoStream,
          optics::ReflectanceModel::AddingDoubling})
    {
        out.str("");
        reflect_command::reflect({.tissue = file, .model = model}, out, notes);
        EXPECT_TRUE(nlohmann::json::parse(out.str()).at("r").is_number()) << optics::name(model);
    }
    try {
        optics::healing_tissue_or_file(file);
        ADD_FAILURE() << "accepted";
    } catch (const base::InputError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr(file + ": /layers/0/thickness_mm: dermis is inf mm"));
    }
}

TEST_F(Commands, TheDocumentedTissueFileIsLightSkin)
{
    std::ifstream stream(std::filesystem::path(CICATRIX_DOCS) / "scene.md");
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    text.erase(0, text.find("## The tissue file"));
    text.erase(0, text.find("```json") + 7);
    std::ofstream(path / "tissue.json") << text.substr(0, text.find("```"));
    const optics::HealingTissue tissue = optics::healing_tissue_or_file((path / "tissue.json").string());
    const base::Color expected = optics::tissue_color(optics::skin(optics::SkinTone::Light).layers(),
                                                      optics::ReflectanceModel::TwoStream);
    EXPECT_LT(cv::norm(optics::tissue_color(optics::layers_of(tissue), optics::ReflectanceModel::TwoStream) -
                       expected),
              1e-12);
}

TEST_F(Commands, BakeWritesTablesAndPictures)
{
    bake_command::BakeOptions options{.tissue = "table1",
                                      .model = optics::ReflectanceModel::TwoStream,
                                      .width = 8,
                                      .height = 8,
                                      .out = path};
    std::ostringstream out, notes;
    bake_command::bake(options, out, notes);
    for (const char* name : {"open_bed.exr", "covered.exr", "tables.png", "color_over_days.png"})
        EXPECT_GT(std::filesystem::file_size(path / name), 100u) << name;
    EXPECT_THAT(out.str(), testing::HasSubstr("8 x 8, two-stream"));
    EXPECT_EQ(notes.str(), "");
    const int days_to_60 = base::read_rgb(path / "color_over_days.png").cols;
    options.last_day = 12;
    bake_command::bake(options, out, notes);
    EXPECT_LT(base::read_rgb(path / "color_over_days.png").cols,
              days_to_60); // no days after the table's last
    for (const char* tissue : {"table1", "light"}) {
        options.tissue = tissue;
        options.model = optics::ReflectanceModel::Printed;
        notes.str("");
        bake_command::bake(options, out, notes);
        EXPECT_THAT(notes.str(), testing::HasSubstr("printed goes on")) << tissue;
    }
}

TEST_F(Commands, MistakesAreNamed)
{
    EXPECT_THROW(optics::healing_tissue_or_file("/nowhere.json"), base::InputError);
    std::ofstream(path / "two.json")
        << R"({"unit":"1/mm","layers":[{"sigma_a":[1,2],"sigma_s":1,"n":1.4,"thickness_mm":1}]})";
    EXPECT_THROW(optics::healing_tissue_or_file((path / "two.json").string()), base::InputError);
    EXPECT_THROW(optics::reflectance_model_named("magic"), base::InputError);
    std::ofstream(path / "file") << "";
    EXPECT_THROW(base::make_folder(path / "file" / "below"), base::InputError);
}

TEST(Calibrate, ReproducesTheBuiltInCalibration)
{
    const TemporaryFolder folder;
    lab::TableOptions options;
    options.out = folder.path();
    options.reflectance_options.photons = 4000;
    std::ostringstream out;
    const nlohmann::ordered_json json = lab::calibrate(options, out);
    const auto error = [&](const char* model, const char* which) {
        return json.at(model).at(which).get<double>();
    };
    EXPECT_LE(error("fit", "fitted_rms"), error("calibrated", "fitted_rms"));
    EXPECT_NEAR(error("fit", "fitted_rms"), error("calibrated", "fitted_rms"), .001);
    EXPECT_NEAR(error("fit", "held_out_rms"), error("calibrated", "held_out_rms"), .002);
    EXPECT_LT(error("calibrated", "held_out_rms"), .7 * error("two-stream", "held_out_rms"));
}

TEST(Tables, OfEveryPresetInterpolateWithinThePromisedError)
{
    base::Progress silent(false);
    lab::TableOptions options;
    options.reflectance_options.photons = 100;
    const std::array<std::uint32_t, 1> sizes{options.size};
    const nlohmann::ordered_json errors = lab::measure_table_sizes(options, sizes, silent);
    for (const char* tissue : {"light", "medium", "dark", "table1"})
        EXPECT_LE(errors.at(0).at(tissue).at("rms").get<double>(), .002) << tissue;
}

TEST(Compare, ModelsAreOrderedAsTheDocumentsSay)
{
    // The stacks of docs/optics.md, section 8. Adding-doubling is the reference: it is within .001 of the
    // photon walk there and has no noise.
    const optics::SkinLayers stacks[] = {optics::table1(.2, 1, 4),
                                         optics::table1(.2, 4, 9),
                                         optics::layers_at(optics::restored_skin(optics::table1(), 1), .2),
                                         *optics::tissue_preset("light"),
                                         *optics::tissue_preset("dark"),
                                         *optics::tissue_preset("granulation"),
                                         *optics::tissue_preset("scar")};
    const auto rms = [&](optics::ReflectanceModel model) {
        double sum = 0;
        for (const optics::SkinLayers& tissue : stacks) {
            const base::Color error = optics::tissue_color(tissue, model) -
                                      optics::tissue_color(tissue, optics::ReflectanceModel::AddingDoubling);
            sum += error.dot(error) / 3;
        }
        return std::sqrt(sum / static_cast<double>(std::size(stacks)));
    };
    const optics::ReflectanceModel worst_first[] = {
        optics::ReflectanceModel::Printed,        optics::ReflectanceModel::Published,
        optics::ReflectanceModel::TwoStreamPaper, optics::ReflectanceModel::Exponential,
        optics::ReflectanceModel::TwoStream,      optics::ReflectanceModel::Calibrated};
    double before = std::numeric_limits<double>::infinity();
    for (optics::ReflectanceModel model : worst_first) {
        EXPECT_LT(rms(model), before) << optics::name(model);
        before = rms(model);
    }
    EXPECT_LT(rms(optics::ReflectanceModel::TwoStream), .03);
    EXPECT_LT(rms(optics::ReflectanceModel::Calibrated), .01);
}
