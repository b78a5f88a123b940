// Transport `preintegrated` against the walk of the reference, in bodies whose shape is known.
#include "wound/optics/transport.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numbers>

#include "reference/random_walk.hpp"
#include "reference/single_albedo.hpp"
#include "reference/tissue.hpp"
#include "wound/optics/skin_presets.hpp"

namespace {

using reference::SurfaceHit;

class Ball : public reference::Body
{
  public:
    explicit Ball(double radius) : radius_(radius) {}
    std::optional<SurfaceHit> first_on_ray(const glm::dvec3& origin, const glm::dvec3& direction,
                                           double reach) const override
    {
        const double along = glm::dot(origin, direction);
        const double inside = along * along - glm::dot(origin, origin) + radius_ * radius_;
        const double distance = -along + std::sqrt(std::max(inside, 0.0)); // from inside there is one
        if (distance > reach)
            return std::nullopt;
        return SurfaceHit{.distance = distance, .normal = glm::normalize(origin + distance * direction)};
    }

  private:
    double radius_;
};

/// The body between z = -thickness and z = 0.
class Slab : public reference::Body
{
  public:
    explicit Slab(double thickness) : thickness_(thickness) {}
    std::optional<SurfaceHit> first_on_ray(const glm::dvec3& origin, const glm::dvec3& direction,
                                           double reach) const override
    {
        const bool up = direction.z > 0;
        const double distance = ((up ? 0 : -thickness_) - origin.z) / direction.z;
        if (!(distance <= reach))
            return std::nullopt;
        return SurfaceHit{.distance = std::max(distance, 0.0), .normal = {0, 0, up ? 1 : -1}};
    }

  private:
    double thickness_;
};

/// Mean of max(cosine, 0) over the points of a ball whose normal is at an angle with cosine `away` from one at which
/// the light falls with this cosine.
double mean_on_circle(double cosine, double away)
{
    const double level = cosine * away,
                 swing = std::sqrt(std::max(0.0, (1 - cosine * cosine) * (1 - away * away)));
    if (level >= swing)
        return level;
    if (level <= -swing)
        return 0;
    const double lit = std::acos(-level / swing);
    return (level * lit + swing * std::sin(lit)) / std::numbers::pi;
}

// A walk that starts where light leaves ends where it came in.
TEST(Preintegrated, BallIsThatOfTheWalk)
{
    constexpr int walks = 30'000;
    const reference::AlbedoTable table(0, 1);
    const base::Color albedo{.5, .35, .25};
    const reference::Medium medium =
        reference::medium_of(base::Color::all(1000), table.single_of(albedo), {}); // 1 mm between scatterings
    for (const double radius_mm : {60., 20., 8., 4.}) {
        const double radius = 1e-3 * radius_mm;
        const Ball ball(radius);
        const glm::dvec3 top(0, 0, 1);
        std::array<base::Color, 21> walked{};
        for (int i = 0; i < walks; ++i) {
            const reference::WalkEnds ends =
                reference::random_walk(medium, ball, radius * top, top, reference::Random::mixed(std::uint64_t(i)));
            for (int c = 0; c < 3; ++c)
                if (ends.reflected[c] > 0)
                    for (std::size_t k = 0; k < walked.size(); ++k)
                        walked[k][c] += ends.reflected[c] / walks *
                                        mean_on_circle(.1 * double(k) - 1,
                                                       ends.exits[std::size_t(c)].surface.normal.z);
        }
        for (int c = 0; c < 3; ++c) {
            const double turn = optics::diffusion_width(albedo[c], 1) / radius_mm;
            double worst = 0, plain = 0;
            for (std::size_t k = 0; k < walked.size(); ++k) {
                const double cosine = .1 * double(k) - 1;
                const double ours = albedo[c] * optics::bend_gain(albedo[c], turn) * optics::received_bent(cosine, turn);
                worst = std::max(worst, std::abs(ours - walked[k][c]));
                plain = std::max(plain, std::abs(albedo[c] * std::max(cosine, 0.0) - walked[k][c]));
            }
            fmt::print("ball of {} mm, d x curvature {:.3f}: {:.4f}, lambert {:.4f}\n", radius_mm, turn, worst, plain);
            EXPECT_LT(worst, turn < .1 ? .012 : .025) << radius_mm << ' ' << c;
            if (turn > .02) {
                EXPECT_LT(worst, .5 * plain) << radius_mm << ' ' << c;
            }
        }
    }
}

// Light from all around falls on both sides of a slab.
TEST(Preintegrated, SlabInTheOpenIsThatOfTheWalk)
{
    constexpr int walks = 30'000;
    const reference::AlbedoTable table(0, 1);
    const base::Color albedo{.7, .5, .3};
    const reference::Medium medium =
        reference::medium_of(base::Color::all(1000), table.single_of(albedo), {}); // 1 mm between scatterings
    for (const double thickness_mm : {.5, 1., 2., 3., 4., 6., 9., 15.}) {
        base::Color walked;
        for (int i = 0; i < walks; ++i)
            walked += reference::random_walk(medium, Slab(1e-3 * thickness_mm), {0, 0, 0}, {0, 0, 1},
                                             reference::Random::mixed(std::uint64_t(i)))
                          .reflected /
                      walks;
        for (int c = 0; c < 3; ++c) {
            const double width = optics::diffusion_width(albedo[c], 1);
            const double ours = albedo[c] * (1 + optics::surroundings_passed(albedo[c], thickness_mm, width));
            fmt::print("slab of {} mm, albedo {}: {:.4f}, walked {:.4f}\n", thickness_mm, albedo[c], ours,
                       walked[c]);
            EXPECT_NEAR(ours, walked[c], .014) << thickness_mm << ' ' << c;
        }
    }
}

// The short walk that gives the rasteriser its length and the long one of the reference's medium.
TEST(Preintegrated, LengthOfTheSkinIsThatOfTheReferencesMedium)
{
    const reference::AlbedoTable table(0, 1);
    const optics::SkinLayers layers = optics::table1();
    const reference::ReducedTissue reduced = reference::reduce(layers, table, {}, 20'000);
    const base::Color length = optics::scattering_length_mm(layers);
    for (int c = 0; c < 3; ++c) {
        fmt::print("{:.4f} mm, {:.4f}\n", length[c], 1e3 / reduced.scattering_per_m[c]);
        EXPECT_NEAR(length[c] * reduced.scattering_per_m[c] / 1e3, 1, .25);
    }
}

} // namespace
