// Layers reduced to a medium.
#include "reference/tissue.hpp"

#include <gtest/gtest.h>
#include <limits>

#include "tests/support/temporary_folder.hpp"

namespace {

using reference::AlbedoTable;
using reference::MediumChoice;
using reference::ReducedTissue;

/// One endless layer, isotropic and index-matched, the same in all channels but for its scale.
optics::SkinLayers endless_layer(double single_albedo, double free_path_mm)
{
    std::vector<double> absorption, scattering;
    for (const double scale : {1.0, 2.0, 4.0}) {
        absorption.push_back((1 - single_albedo) * scale / free_path_mm);
        scattering.push_back(single_albedo * scale / free_path_mm);
    }
    return {.layers = {{"all", absorption, scattering, 0, 1, std::numeric_limits<double>::infinity()}},
            .n_above = 1,
            .n_below = 1};
}

// Of what the walk can have itself, the reduction gives it back.
TEST(ReducedTissue, OfTheWalksOwnMediumIsThatMedium)
{
    const AlbedoTable table(0, 1);
    const ReducedTissue reduced = reference::reduce(endless_layer(.9, .8), table, {}, 50'000);
    for (int c = 0; c < 3; ++c) {
        const double path_mm = .8 / (1 << c);
        EXPECT_NEAR(reduced.albedo[c], table.diffuse_of(.9), .006);
        EXPECT_NEAR(reduced.mean_free_path_mm[c], path_mm, .04 * path_mm);
        EXPECT_NEAR(reduced.diffuse_mean_free_path_mm[c], path_mm / std::sqrt(3 * .1),
                    .05 * path_mm / std::sqrt(.3));
        EXPECT_NEAR(reduced.scattering_per_m[c], 1e3 * .9 / path_mm, .06 * 1e3 * .9 / path_mm);
        EXPECT_LT(reduced.worst_edge[c], .006);
    }
}

// Table 1's three layers, of different index and anisotropy, spread light as one isotropic medium does.
TEST(ReducedTissue, OfTable1HasItsEdgeResponse)
{
    for (const MediumChoice& choice : {MediumChoice{}, MediumChoice{.anisotropy = .5, .index = 1.4}}) {
        const AlbedoTable table(choice.anisotropy, choice.index);
        const ReducedTissue reduced = reference::reduce(optics::table1(), table, choice, 20'000);
        for (int c = 0; c < 3; ++c)
            EXPECT_LT(reduced.worst_edge[c], .03);
        EXPECT_GT(reduced.mean_free_path_mm[0], 1.2 * reduced.mean_free_path_mm[2]); // red goes furthest
    }
}

TEST(ReducedTissue, ScattersTheSameWhateverItAbsorbs)
{
    const AlbedoTable table(0, 1);
    const base::Color scattering{900, 1500, 2500}, single = table.single_of({.5, .4, .3});
    const reference::Medium own = reference::medium_of(scattering, single, {}),
                            paler = reference::medium_of(scattering, table.single_of({.8, .8, .8}), {}),
                            black = reference::medium_of(scattering, table.single_of({0, 0, 0}), {});
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(own.extinction[c], scattering[c] / single[c], 1e-6);
        EXPECT_NEAR(paler.extinction[c] * paler.single_albedo[c], own.extinction[c] * own.single_albedo[c],
                    1e-6);
        EXPECT_EQ(black.single_albedo[c], 0);
        EXPECT_TRUE(std::isfinite(black.extinction[c]));
    }
}

TEST(ReducedTissue, IsKeptAndWhatIsBrokenIsMadeAnew)
{
    const TemporaryFolder folder;
    const AlbedoTable table(0, 1);
    const optics::SkinLayers layers = endless_layer(.5, 1);
    const auto same = [](const ReducedTissue& a, const ReducedTissue& b) {
        return a.albedo == b.albedo && a.mean_free_path_mm == b.mean_free_path_mm &&
               a.worst_edge == b.worst_edge;
    };
    const ReducedTissue first = reference::kept_reduction(folder.path() / "cache", layers, table, {});
    ASSERT_EQ(std::distance(std::filesystem::directory_iterator(folder.path() / "cache"), {}), 1);
    const std::filesystem::path file = std::filesystem::directory_iterator(folder.path() / "cache")->path();
    const auto written = std::filesystem::last_write_time(file);
    EXPECT_TRUE(same(reference::kept_reduction(folder.path() / "cache", layers, table, {}), first));
    EXPECT_EQ(std::filesystem::last_write_time(file), written);
    for (const char* broken : {"", "{", "[1]", "{\"albedo\": 3}"}) {
        std::ofstream(file) << broken;
        EXPECT_TRUE(same(reference::kept_reduction(folder.path() / "cache", layers, table, {}), first));
    }
    // A folder that cannot be made is no failure.
    const std::filesystem::path no_folder = folder.with("file", "x");
    EXPECT_TRUE(same(reference::kept_reduction(no_folder, layers, table, {}), first));
}

} // namespace
