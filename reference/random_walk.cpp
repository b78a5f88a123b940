#include "reference/random_walk.hpp"

#include <algorithm>
#include <cmath>

#include "reference/directions.hpp"
#include "wound/optics/fresnel.hpp"

namespace reference {
namespace {

/// A walk this long has lost its way out of a body that is not closed.
constexpr int most_steps = 100'000;
/// Russian roulette begins when no channel weighs more: earlier it makes noise, later it costs steps.
constexpr double roulette_weight = 0.1;
/// Longest ray, in mean free paths of the channel that sees furthest: e^-16 of its light goes further.
constexpr double farthest_paths = 16;

base::Color exponential(const base::Color& extinction, double distance)
{
    return {std::exp(-extinction[0] * distance), std::exp(-extinction[1] * distance),
            std::exp(-extinction[2] * distance)};
}

double sum(const base::Color& c)
{
    return c[0] + c[1] + c[2];
}

/// The direction in which diffuse light goes on inside: cosine-weighted outside, of which the boundary
/// passes 1 - F, refracted. All the light that passes counts as the light that entered.
glm::dvec3 entering(double n, const glm::dvec3& normal, Random random)
{
    double outside = std::sqrt(1 - random());
    while (n != 1 && random() < optics::fresnel(1, n, outside))
        outside = std::sqrt(1 - random());
    const double inside = std::sqrt(std::max(0.0, 1 - (1 - outside * outside) / (n * n)));
    return direction_about(-normal, inside, random());
}

class Walk
{
  public:
    Walk(const Medium& medium, const Body& body, std::uint64_t key)
        : medium_(medium), body_(body), key_(key),
          reach_(farthest_paths /
                 std::min({medium.extinction[0], medium.extinction[1], medium.extinction[2]}))
    {
    }

    WalkEnds run(const glm::dvec3& from, const glm::dvec3& normal, const StopsAt& stops_at)
    {
        at_ = from;
        direction_ = entering(medium_.n, normal, Random(key_, 0, 0));
        for (int step = 1; step < most_steps && survives(); ++step) {
            Random random(key_, 0, std::uint64_t(step));
            for (double& draw : draws_)
                draw = random();
            if (const std::optional<SurfaceHit> met = body_.first_on_ray(at_, direction_, reach_))
                split_at(*met);
            else
                scatter_before(reach_);
            if (stops_at && stops_at(at_)) {
                ends_.stopped_at = at_;
                ends_.stopped = weight_;
                break;
            }
        }
        return ends_;
    }

  private:
    /// Of the light that comes to the surface, what passes it leaves; the walk goes on either with what the
    /// surface returns or with what scatters before it. Where two bodies overlap, such as lips, a surface may
    /// be met from outside: the walk is then inside of both, and leaves when it has left both.
    void split_at(const SurfaceHit& met)
    {
        const double cosine = glm::dot(direction_, met.normal);
        const bool leaves = cosine > 0 && depth_ == 1;
        double kept = 1; // share of the light at the surface that stays inside
        const base::Color arriving = weight_.mul(exponential(medium_.extinction, met.distance));
        if (leaves) {
            kept = medium_.n == 1 ? 0 : optics::fresnel(medium_.n, 1, std::min(cosine, 1.0));
            leave(met, (1 - kept) * arriving);
        }
        const double beyond = kept * sum(arriving), before = sum(weight_ - arriving);
        if (draws_[4] * (beyond + before) >= beyond) {
            weight_ *= (beyond + before) / before;
            scatter_before(met.distance);
            return;
        }
        weight_ = kept * arriving * ((beyond + before) / beyond);
        at_ += met.distance * direction_;
        if (leaves)
            direction_ -= 2 * cosine * met.normal;
        else
            depth_ += cosine > 0 ? -1 : 1;
    }

    void leave(const SurfaceHit& met, const base::Color& weight)
    {
        ends_.reflected += weight;
        const double chosen = draws_[5];
        for (int c = 0; c < 3; ++c)
            if (weight[c] > chosen * ends_.reflected[c])
                ends_.exits[std::size_t(c)] = {at_ + met.distance * direction_, met, weight};
    }

    /// The part of the light that scatters within `distance`. The path is drawn from one channel's truncated
    /// exponential, a channel's chance being its share of that light. Weights then divide by the mixture of
    /// the three densities, the balance heuristic of Veach & Guibas 1995 for one sample, so that their sum
    /// depends little on the channels' mean free paths.
    void scatter_before(double distance)
    {
        const base::Color& extinction = medium_.extinction;
        const base::Color share = base::Color(1, 1, 1) - exponential(extinction, distance),
                          scattering = weight_.mul(share);
        const double which = draws_[0] * sum(scattering);
        const int channel = which < scattering[0] ? 0 : which < scattering[0] + scattering[1] ? 1 : 2;
        const double path = -std::log1p(-draws_[1] * share[channel]) / extinction[channel];
        const base::Color density = extinction.mul(exponential(extinction, path));
        const double mixture = weight_.dot(density) / sum(scattering); // of chance x density / share
        weight_ = weight_.mul(density).mul(medium_.single_albedo) / mixture;
        at_ += std::min(path, distance) * direction_;
        direction_ = glm::normalize(
            direction_about(direction_, optics::henyey_greenstein_cosine(medium_.g, draws_[2]), draws_[3]));
    }

    bool survives()
    {
        const double largest = std::max({weight_[0], weight_[1], weight_[2]});
        if (!(largest > 0))
            return false;
        if (largest >= roulette_weight)
            return true;
        if (draws_[6] * roulette_weight >= largest)
            return false;
        weight_ *= roulette_weight / largest;
        return true;
    }

    const Medium& medium_;
    const Body& body_;
    const std::uint64_t key_;
    std::array<double, 7> draws_{}; // of the step, each for one decision
    const double reach_;            // metres
    WalkEnds ends_;
    glm::dvec3 at_{0.0}, direction_{0.0};
    base::Color weight_{1, 1, 1};
    int depth_ = 1;
};

} // namespace

std::optional<SurfaceHit> HalfSpace::first_on_ray(const glm::dvec3& origin, const glm::dvec3& direction,
                                                  double reach) const
{
    const double rising = glm::dot(direction, outward_), below = glm::dot(point_ - origin, outward_);
    if (rising <= 0 || below > reach * rising)
        return std::nullopt;
    return SurfaceHit{.distance = std::max(0.0, below / rising), .normal = outward_};
}

WalkEnds random_walk(const Medium& medium, const Body& body, const glm::dvec3& from, const glm::dvec3& normal,
                     std::uint64_t key, const StopsAt& stops_at)
{
    return Walk(medium, body, key).run(from, normal, stops_at);
}

} // namespace reference
