#include "reference/regions.hpp"

#include <opencv2/imgproc.hpp>

#include "base/parallel.hpp"
#include "head/vectors.hpp"
#include "reference/surface.hpp"

namespace reference {
namespace {

constexpr double thin_m = .01;
constexpr int edge_px = 2;      // distance from a shadow's border
constexpr double new_skin = .1; // share of new epithelium at which a point counts as the ring

/// Which lights reach a point, of those that it faces: bits.
struct Reached
{
    std::uint32_t lit = 0, blocked = 0;
};

class Classifier
{
  public:
    Classifier(const scene::LoadedScene& scene, const Request& request)
        : scene_(scene), request_(request), wounds_(scene, request.day, std::nullopt),
          surfaces_(scene, wounds_), size_(int(request.size[0]), int(request.size[1])), reached_(size_.area())
    {
        for (cv::Mat1b& region : regions_)
            region = cv::Mat1b(size_, uchar(0));
    }

    Regions run()
    {
        base::in_parallel(std::size_t(size_.height), 0, [&](std::size_t y) {
            for (int x = 0; x < size_.width; ++x)
                classify(x, int(y));
        });
        find_shadow_edges();
        return std::move(regions_);
    }

  private:
    cv::Mat1b& region(Region which) { return regions_[std::size_t(which)]; }

    void classify(int x, int y)
    {
        const glm::dvec3 eye = request_.camera.eye;
        const glm::dvec3 sight =
            glm::normalize(head::sight_through_pixel(request_.camera, {x + .5, y + .5}, size_));
        const std::optional<head::Hit> hit = surfaces_.seen(eye, sight, 0);
        if (!hit || surfaces_.look(*hit).surface != head::Surface::Skin)
            return;
        const SurfacePoint point = surfaces_.point(*hit);
        const Region kind = point.skin.bed >= .5             ? Region::Wound
                            : point.skin.covered >= new_skin ? Region::Ring
                                                             : Region::Skin;
        region(kind)(y, x) = 255;
        if (surfaces_.first_on_ray(point.at - 1e-5 * point.flat, -point.flat, thin_m))
            region(Region::Thin)(y, x) = 255;
        reached_[std::size_t(y) * std::size_t(size_.width) + std::size_t(x)] = lights_at(point);
    }

    Reached lights_at(const SurfacePoint& point) const
    {
        Reached reached;
        for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
            const optics::Light& light = scene_.lights[i];
            const optics::LightSample sample = optics::sample_light(light, head::to_cv(point.at));
            if (glm::dot(point.smooth, head::to_glm(sample.direction)) > 0)
                (surfaces_.reached_by(light, sample, point) ? reached.lit : reached.blocked) |= 1u << i;
        }
        return reached;
    }

    void find_shadow_edges()
    {
        const cv::Mat near = cv::Mat::ones(2 * edge_px + 1, 2 * edge_px + 1, CV_8U);
        cv::Mat1b& edges = region(Region::ShadowEdges);
        for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
            cv::Mat1b lit(size_, uchar(0)), blocked = lit.clone();
            for (std::size_t pixel = 0; pixel < reached_.size(); ++pixel) {
                lit.data[pixel] = (reached_[pixel].lit >> i & 1) != 0 ? 255 : 0;
                blocked.data[pixel] = (reached_[pixel].blocked >> i & 1) != 0 ? 255 : 0;
            }
            const cv::Mat1b faces = lit | blocked;
            cv::dilate(lit, lit, near);
            cv::dilate(blocked, blocked, near);
            edges |= lit & blocked & faces;
        }
    }

    const scene::LoadedScene& scene_;
    const Request& request_;
    const DayWounds wounds_;
    const Surfaces surfaces_;
    const cv::Size size_;
    std::vector<Reached> reached_;
    Regions regions_;
};

} // namespace

Regions find_regions(const scene::LoadedScene& scene, const Request& request)
{
    check_request(scene, request);
    return Classifier(scene, request).run();
}

} // namespace reference
