// The reflectance table's shader against the double-precision reference: thousands of random tissues and all
// corners.
#include <gtest/gtest.h>
#include <random>

#include "engine/gpu/executor.hpp"
#include "passes/reflectance_lut.hpp"
#include "tests/support/gpu.hpp"
#include "wound/optics/skin_presets.hpp"

namespace {

class ReflectanceLutTest : public gpu_test::Test
{
  protected:
    cv::Mat4f bake(const passes::LutTissue& tissue, optics::ReflectanceModel model, std::uint32_t width = 16)
    {
        graph::Graph graph;
        const passes::ReflectanceLut lut = passes::add_reflectance_lut(graph, "lut", tissue, model, width);
        const graph::ReadbackId back = graph.readback("lut", lut.reflectance);
        last = executor.run(graph);
        cv::Mat4f pixels;
        last.mat(back).convertTo(pixels, CV_32F);
        return pixels;
    }

    gpu::Executor executor{gpu_test::device(), gpu_test::shaders()};
    gpu::FrameResult last;
};

constexpr double last_day = 30;
constexpr optics::ReflectanceModel shader_models[] = {
    optics::ReflectanceModel::Printed,     optics::ReflectanceModel::Published,
    optics::ReflectanceModel::Exponential, optics::ReflectanceModel::TwoStreamPaper,
    optics::ReflectanceModel::TwoStream,   optics::ReflectanceModel::Calibrated};

double as_float(double x)
{
    return static_cast<float>(x);
}

class RandomTissue
{
  public:
    explicit RandomTissue(unsigned seed) : random_(seed) {}
    double uniform(double low, double high)
    {
        return as_float(std::uniform_real_distribution(low, high)(random_));
    }
    double logarithmic(double low, double high)
    {
        return as_float(std::exp(uniform(std::log(low), std::log(high))));
    }
    double coefficient(double low, double high)
    {
        const int corner = std::uniform_int_distribution(0, 9)(random_);
        return corner == 0 ? 0 : corner == 1 ? high : logarithmic(low, high);
    }
    optics::Layer layer(double thickness, double low, double high)
    {
        optics::Layer result{.name = "", .sigma_a = {}, .sigma_s_reduced = {}, .thickness_mm = thickness};
        for (int c = 0; c < 3; ++c) {
            result.sigma_a.push_back(coefficient(low, high));
            result.sigma_s_reduced.push_back(coefficient(low, high));
        }
        result.g = uniform(-1, 1);
        result.n = std::uniform_int_distribution(0, 3)(random_) ? uniform(1, 3) : 1.4f;
        return result;
    }

    /// One day per row: intact layers of the given thicknesses; some rows have regrown tissue and a cover.
    std::vector<optics::TissueDay> rows(std::size_t count, const std::vector<double>& thicknesses, double low,
                                        double high, bool injured)
    {
        std::vector<optics::TissueDay> result(count);
        const double above = uniform(1, 3), below = uniform(1, 3);
        for (optics::TissueDay& day : result) {
            day.intact.n_above = above;
            day.intact.n_below = below;
            for (double thickness : thicknesses)
                day.intact.layers.push_back(layer(as_float(thickness), low, high));
            day.missing_ratio = injured ? uniform(0, 1) : 0;
            day.regrown_ratio =
                injured && uniform(0, 1) < .5 ? as_float((1 - day.missing_ratio) * uniform(0, 1)) : 0;
            day.regrown = layer(0, low, high);
            day.cover = layer(uniform(0, 1) < .3 ? logarithmic(1e-3, 10) : 0, low, high);
        }
        return result;
    }

  private:
    std::mt19937 random_;
};

double expected(double color)
{
    return color > 0 ? std::min(color, 65504.0) : 0;
}

// The shader computes in single precision and stores half floats, which some drivers truncate: an error of
// one unit in the last place.
void expect_table(const cv::Mat4f& table, const std::vector<optics::TissueDay>& rows,
                  const passes::LutTissue& tissue, optics::ReflectanceModel model, double absolute)
{
    ASSERT_EQ(table.rows, static_cast<int>(rows.size()));
    for (int y = 0; y < table.rows; ++y)
        for (int x = 0; x < table.cols; ++x) {
            const float injury = shared::lut_value(static_cast<float>(x), static_cast<float>(table.cols),
                                                   tissue.parameters.axes.deepest_mm);
            const base::Color color = optics::tissue_color(
                optics::layers_at(rows[static_cast<std::size_t>(y)], injury, optics::is_the_papers(model)),
                model);
            for (int c = 0; c < 3; ++c) {
                const double want = expected(color[c]);
                const double got = table(y, x)[c];
                ASSERT_NEAR(got, want, absolute + want * 0x1p-10)
                    << optics::name(model) << " row " << y << " column " << x << " channel " << c;
            }
        }
}

} // namespace

TEST_F(ReflectanceLutTest, EqualsTheReferenceOnRandomTissue)
{
    RandomTissue random(1);
    for (int i = 0; i < 6; ++i) {
        const std::vector<optics::TissueDay> rows = random.rows(200, {.2, 1, .5, 4}, 1e-6, 1e3, true);
        const passes::LutTissue tissue = passes::lut_tissue(rows, last_day);
        for (optics::ReflectanceModel model :
             {optics::ReflectanceModel::Published, optics::ReflectanceModel::Exponential,
              optics::ReflectanceModel::TwoStreamPaper, optics::ReflectanceModel::TwoStream,
              optics::ReflectanceModel::Calibrated})
            expect_table(bake(tissue, model), rows, tissue, model, 3e-5);
    }
}

TEST_F(ReflectanceLutTest, IntegratesTheSpectrumOfChromophoreTissue)
{
    std::vector<optics::TissueDay> rows;
    for (std::size_t i = 0; i < 24; ++i) {
        const double day = wound::lut_row_day(i, 24, last_day);
        rows.push_back(i % 2
                           ? optics::open_bed(optics::skin(optics::SkinTone::Light), day, 1 - day / last_day)
                           : optics::covered_bed(optics::skin(optics::SkinTone::Dark), day, 20));
    }
    const passes::LutTissue tissue = passes::lut_tissue(rows, last_day);
    expect_table(bake(tissue, optics::ReflectanceModel::TwoStream, 32), rows, tissue,
                 optics::ReflectanceModel::TwoStream, 3e-5);
    expect_table(bake(tissue, optics::ReflectanceModel::Calibrated, 32), rows, tissue,
                 optics::ReflectanceModel::Calibrated, 3e-5);
}

TEST_F(ReflectanceLutTest, PrintedModelEqualsTheReferenceWhereItStaysFinite)
{
    RandomTissue random(2);
    const std::vector<optics::TissueDay> rows = random.rows(200, {.2, 1, .5, 4}, 1e-3, .2, true);
    const passes::LutTissue tissue = passes::lut_tissue(rows, last_day);
    expect_table(bake(tissue, optics::ReflectanceModel::Printed), rows, tissue,
                 optics::ReflectanceModel::Printed, 3e-5);
}

TEST_F(ReflectanceLutTest, IsFiniteAndNotNegativeAtEveryExtreme)
{
    RandomTissue random(3);
    for (double thickness : {0., 1e-9, 1e9}) {
        const std::vector<optics::TissueDay> rows =
            random.rows(300, {thickness, 1e9, thickness}, 1e-9, 1e6, false);
        const passes::LutTissue tissue = passes::lut_tissue(rows, last_day);
        for (optics::ReflectanceModel model : shader_models) {
            const cv::Mat4f table = bake(tissue, model, 4);
            for (const cv::Vec4f& texel : table)
                for (int c = 0; c < 3; ++c)
                    ASSERT_TRUE(texel[c] >= 0 &&
                                texel[c] <= (model == optics::ReflectanceModel::Printed ? 65504.f : 1.f))
                        << optics::name(model);
            if (model != optics::ReflectanceModel::Printed)
                expect_table(table, rows, tissue, model, 3e-5);
        }
    }
}

TEST_F(ReflectanceLutTest, EqualsTheReferenceAtAllCorners)
{
    std::vector<optics::TissueDay> rows;
    for (double a : {0., 1e-30, 1e6})
        for (double s : {0., 1e-30, 1e6})
            for (double g : {-1., 0., 1e-7, 1.})
                for (double n : {1., 1 + 1e-6, 1.29, 1.31, 3.})
                    for (double d : {0., 1e-9, 1e9}) {
                        const optics::Layer layer{"",          {a, as_float(1.7), as_float(.3)},
                                                  {s, 0, 1e6}, as_float(g),
                                                  as_float(n), as_float(d)};
                        optics::TissueDay day = optics::restored_skin(
                            {.layers = {layer, layer}, .n_above = 1, .n_below = as_float(1.4)}, 0);
                        day.cover.thickness_mm = 0;
                        rows.push_back(day);
                    }
    const passes::LutTissue tissue = passes::lut_tissue(rows, last_day);
    for (optics::ReflectanceModel model :
         {optics::ReflectanceModel::Published, optics::ReflectanceModel::Exponential,
          optics::ReflectanceModel::TwoStreamPaper, optics::ReflectanceModel::TwoStream,
          optics::ReflectanceModel::Calibrated})
        expect_table(bake(tissue, model, 2), rows, tissue, model, 3e-5);
}

TEST_F(ReflectanceLutTest, IsBakedAgainOnlyWhenTheTissueChanges)
{
    std::vector<optics::TissueDay> rows(8, optics::restored_skin(optics::table1(), 1));
    const passes::LutTissue tissue = passes::lut_tissue(rows, last_day);
    bake(tissue, optics::ReflectanceModel::TwoStream);
    EXPECT_EQ(last.pass("lut").state, graph::PassState::Run);
    bake(tissue, optics::ReflectanceModel::TwoStream);
    EXPECT_NE(last.pass("lut").state, graph::PassState::Run);
    rows[3].intact.layers[0].sigma_a[0] = .05;
    bake(passes::lut_tissue(rows, last_day), optics::ReflectanceModel::TwoStream);
    EXPECT_EQ(last.pass("lut").state, graph::PassState::Run);
}

TEST(LutCoordinate, BakerAndSamplerAgreeAtEveryTexelCentre)
{
    for (int size : {2, 8, 64, 256})
        for (int i = 0; i < size; ++i) {
            const auto n = static_cast<float>(size);
            const float depth = shared::lut_value(static_cast<float>(i), n, 3.2f);
            EXPECT_NEAR(shared::lut_coordinate(depth, n, 3.2f) * n, static_cast<float>(i) + .5f, 1e-4f * n);
        }
    EXPECT_EQ(shared::lut_coordinate(-1.f, 8, 3.2f), .5f / 8);
    EXPECT_EQ(shared::lut_coordinate(99.f, 8, 3.2f), 7.5f / 8);
    EXPECT_EQ(shared::lut_coordinate(1.f, 8, 0.f), .5f / 8);
    EXPECT_EQ(shared::lut_coordinate(NAN, 8, 3.2f), .5f / 8);
    EXPECT_DOUBLE_EQ(wound::lut_row_day(63, 64, 30), 30);
}
