// The wounds of a scene on one day, as rays find them: what they make of a point of skin, and the tissue
// under it.
#pragma once
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "reference/tissue.hpp"
#include "scene/loaded_scene.hpp"
#include "wound/skin_blend.hpp"

namespace reference {

/// Mean free path and albedo of the tissues that a wound is made of, each reduced from its layers.
struct WoundTissue
{
    ReducedTissue bed;     // at the depth that half of the bed exceeds
    ReducedTissue covered; // new epithelium over what has regrown: the ring, and the scar
};

class DayWounds
{
  public:
    /// Keeps a reference to `scene`. `walked`: the medium in which light walks under the skin; none: medium()
    /// must not be called. All cores work; with a medium it may take seconds when a tissue is first seen.
    DayWounds(const scene::LoadedScene& scene, double day, const std::optional<MediumChoice>& walked);

    struct SkinLook
    {
        wound::SkinPoint skin;
        double bed = 0, covered = 0; // shares of the tissue at the point; the rest is the face's own skin
        std::size_t wound = 0;       // whose they are
    };
    /// `own`: the face's skin there; `smooth`: the interpolated normal, to which the projection looks.
    SkinLook at(const glm::dvec3& position, const glm::dvec3& smooth, const wound::SkinPoint& own) const;

    /// The medium under a point: the wounds' where they are, else the face's.
    Medium medium(const SkinLook& look, const base::Color& diffuse_albedo) const;

    const ReducedTissue& skin() const { return skin_; }

    /// The layers of a wound: of its bed, or of new epithelium over what has regrown.
    optics::SkinLayers layers_under(std::size_t wound, bool bed) const;
    std::size_t count() const { return wounds_.size(); }

  private:
    struct One
    {
        head::Anchor anchor;
        wound::DayMaps maps;
        cv::Mat3f reflectance;
        shared::LutAxes axes;
        double reach_m;
    };
    const scene::LoadedScene& scene_;
    const double day_;
    MediumChoice choice_;
    std::optional<AlbedoTable> table_; // with a medium
    ReducedTissue skin_;
    std::vector<wound::WoundDay> today_;
    std::vector<One> wounds_;
    std::vector<WoundTissue> tissues_;
};

} // namespace reference
