// The systems that Choi & Chin 2014 compares with and whose authors compute on the processor, drawn with the
// reference's surfaces, tissue, lights, shadows and cameras. Each has its own way of light under the skin;
// light from skin to skin and highlights are the path tracer's.
//
// - jensen: the dipole of H. Jensen, S. Marschner, M. Levoy, P. Hanrahan 2001, by the two passes of H.
// Jensen,
//   J. Buhler 2002: irradiance at samples on the surface, no farther apart than the channels' mean of the
//   mean free path, summed by an octree.
// - donner-jensen: C. Donner, H. Jensen 2005. The same sum with the profile of the scene's layers, each a
//   multipole. Textures multiply the profile, as theirs do. A wound's bed and new skin have layers of their
//   own.
// - li: H. Li, F. Pellacini, K. Torrance 2005, "A hybrid Monte Carlo method for accurate and efficient
//   subsurface scattering". Random walks as in the reference, until they are deeper than the longest mean
//   free path. From there a dipole whose source lies at that depth spreads the rest, by the same octree. The
//   reference's control variate takes the noise away where skin is flat and evenly lit.
//
// Tissue: jensen has at every point the diffuse albedo that the reference has there, by albedo inversion, and
// of all mean free paths the one with which the dipole's edge response is nearest (optics::DipoleInversion).
// li has the reference's medium. donner-jensen has the layers from which that medium is made. No profile is
// narrower than the samples are apart.
//
// What stands between frames: the samples' places and the tree with the head, the samples' light with lights
// and day, and the whole picture when nothing has changed. When only the camera moves there is the second
// pass alone.
#pragma once
#include <array>
#include <memory>
#include <string_view>

#include "head/camera.hpp"
#include "reference/surface_light.hpp"
#include "wound/optics/dipole.hpp"

namespace reference {

enum class RivalMethod : std::uint8_t
{
    Jensen,
    DonnerJensen,
    Li,
};
/// In the order of the enumerators.
inline constexpr std::array<std::string_view, 3> rival_names{"jensen", "donner-jensen", "li"};

class Rival
{
  public:
    explicit Rival(RivalMethod method) : method_(method) {}

    /// Premultiplied linear radiance, as Picture::radiance() has it. `rays_per_axis`: of a pixel, at least 1.
    /// The scene must be complete. All cores work.
    cv::Mat4f draw(const scene::LoadedScene& scene, const head::Camera& camera, const cv::Size& size,
                   double day, int rays_per_axis);

    /// What draw() has computed since the beginning: tests ask it.
    struct Work
    {
        int trees = 0, days = 0, lights = 0, pictures = 0;
        bool operator==(const Work&) const = default;
    };
    const Work& work() const { return work_; }
    /// Of samples, tree, profiles and the kept picture.
    std::size_t bytes() const;

  private:
    struct Day;
    void prepare(const scene::LoadedScene& scene, double day);
    base::Color by_dipole(const SurfacePoint& point) const;
    base::Color by_layers(const SurfacePoint& point) const;
    base::Color by_walks(const SurfacePoint& point, const glm::dvec3& normal, Random& random) const;
    /// What leaves of a walk that has stopped at a depth.
    base::Color from_core(const Medium& medium, const WalkEnds& ends, double depth) const;

    const RivalMethod method_;
    std::shared_ptr<SurfaceLight> light_;
    std::shared_ptr<const head::Model> sampled_; // whose samples those are
    std::shared_ptr<Day> day_;
    std::shared_ptr<const optics::DipoleInversion> inversion_; // of jensen
    struct Shown
    {
        head::Camera camera;
        cv::Size size;
        int rays_per_axis = 0;
        cv::Mat4f picture;
    } shown_;
    Work work_;
};

} // namespace reference
