#include "wound/optics/tissue_choice.hpp"

#include <filesystem>
#include <fmt/ranges.h>

#include "base/input_error.hpp"
#include "wound/optics/spectrum.hpp"
#include "wound/optics/tissue_file.hpp"

namespace optics {

using base::InputError;

namespace {

SkinLayers read_unless_missing(const std::string& name, const std::vector<std::string_view>& presets)
{
    if (!std::filesystem::exists(name))
        throw InputError(name, "is neither a file nor a preset",
                         fmt::format("name a tissue file or one of {}", fmt::join(presets, ", ")));
    return read_tissue(name);
}

// The reflectance table's depth axis reaches to the last layer; above 100 mm a wound would cover one texel.
void require_wounds_reach(const SkinLayers& tissue, const std::string& file)
{
    constexpr double thickest_mm = 100;
    for (std::size_t i = 0; i + 1 < tissue.layers.size(); ++i)
        if (const Layer& layer = tissue.layers[i]; layer.thickness_mm > thickest_mm)
            throw InputError(
                fmt::format("{}: /layers/{}/thickness_mm", file, i),
                fmt::format("{} is {} mm thick, too thick for a wound to reach what is under it",
                            layer.name.empty() ? "the layer" : layer.name, base::plain(layer.thickness_mm)),
                fmt::format("give at most {} mm, or end the tissue with this layer", thickest_mm));
}

} // namespace

HealingTissue healing_tissue_or_file(const std::string& name)
{
    if (const auto preset = healing_tissue_named(name))
        return *preset;
    SkinLayers tissue = read_unless_missing(name, healing_tissue_names());
    if (channel_weights(tissue.channels()).empty())
        throw InputError(name, fmt::format("has {} channels", tissue.channels()),
                         fmt::format("give 1, 3 or {} channels", wavelength_count));
    require_wounds_reach(tissue, name);
    return tissue;
}

SkinLayers tissue_or_file(const std::string& name)
{
    const auto preset = tissue_preset(name);
    return preset ? *preset : read_unless_missing(name, tissue_preset_names());
}

std::optional<std::string> domain_note(const SkinLayers& tissue)
{
    const std::size_t outside = outside_domain(tissue).size();
    if (outside == 0)
        return {};
    return fmt::format("eqs. (2) and (3) as printed are outside their domain in {} of {} layers and "
                       "channels: colours are wrong, often green (docs/optics.md)",
                       outside, tissue.layers.size() * tissue.channels());
}

SkinLayers layers_of(const HealingTissue& tissue)
{
    const auto* table = std::get_if<SkinLayers>(&tissue);
    return table ? *table : std::get<ChromophoreSkin>(tissue).layers();
}

} // namespace optics
