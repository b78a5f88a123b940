// A head as rays meet it: at a hit, all that shading needs - frames, colour, tissue, gloss - by the
// conventions of shaders/forward.vert and forward.frag.
#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "head/bvh.hpp"
#include "head/materials.hpp"
#include "reference/random_walk.hpp"
#include "reference/wounds.hpp"

namespace reference {

/// One material: what is looked up once. The pictures are the model's.
struct MaterialLook
{
    const head::Material* material = nullptr;
    head::Surface surface = head::Surface::Skin;
    bool blended = false, double_sided = false;
    head::Gloss gloss;
};

struct SurfacePoint
{
    glm::dvec3 at{0.0}; // metres
    /// The same on the smooth surface that the vertex normals describe: rays leave from here, so that a
    /// triangle does not darken itself where its corners' normals still see the light.
    glm::dvec3 lifted{0.0};
    glm::dvec3 flat{0.0}, smooth{0.0}, normal{0.0}; // unit, towards the side that was met: the triangle's,
                                                    // the vertices', and with normal map and wounds
    glm::dvec4 tangent{0.0};
    const MaterialLook* look = nullptr;
    double alpha = 1;
    DayWounds::SkinLook skin; // albedo, gloss and tissue; of what is no skin, its albedo
};

class Surfaces : public Body
{
  public:
    /// Keeps references to both.
    Surfaces(const scene::LoadedScene& scene, const DayWounds& wounds);

    /// The first surface that a viewer sees along the unit vector `direction`, beyond `tmin` metres. Backs of
    /// one-sided materials are looked through; of hair and lashes the caller may look through, too.
    std::optional<head::Hit> seen(const glm::dvec3& origin, const glm::dvec3& direction, double tmin) const;
    /// The first surface that light meets, from either side; hair and lashes let it pass.
    std::optional<head::Hit> met(const glm::dvec3& origin, const glm::dvec3& direction) const;
    /// Whether no surface keeps the light from the point. `sample`: of the light, at the point.
    bool reached_by(const optics::Light& light, const optics::LightSample& sample,
                    const SurfacePoint& point) const;

    SurfacePoint point(const head::Hit& hit) const;
    /// Where a walk has left the skin.
    SurfacePoint point(const SurfaceHit& hit) const;
    const MaterialLook& look(const head::Hit& hit) const { return looks_[hit.material]; }

    std::optional<SurfaceHit> first_on_ray(const glm::dvec3& origin, const glm::dvec3& direction,
                                           double reach) const override;

  private:
    const scene::LoadedScene& scene_;
    const DayWounds& wounds_;
    const head::Model& model_;
    const bool normal_map_;
    head::Bvh all_;
    std::vector<MaterialLook> looks_;
    bool masked_ = false; // some material is cut out, not blended
};

/// shaders/lib/frame.glsl: a normal that turns away from the viewer lies at the horizon of the view instead.
glm::dvec3 bent_to_viewer(const glm::dvec3& normal, const glm::dvec3& to_viewer);
/// Columns: tangent, bitangent, normal.
glm::dmat3 tangent_frame(const glm::dvec3& normal, const glm::dvec4& tangent);

} // namespace reference
