#include "wound/optics/tissue_choice.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/ranges.h>
#include <span>

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

namespace {

// "epidermis 0.2 mm: G 0.188, B 0.162", or for a spectrum the number of its wavelengths and the least limit.
std::string domain_text(const SkinLayers& tissue, std::size_t layer, std::span<const OutsideDomain> outside)
{
    constexpr std::array<const char*, 3> rgb{"R", "G", "B"};
    const Layer& of = tissue.layers[layer];
    std::vector<std::string> channels;
    double least = of.thickness_mm;
    for (const OutsideDomain& one : outside) {
        if (one.layer != layer)
            continue;
        channels.push_back(tissue.channels() == rgb.size()
                               ? fmt::format("{} {:.3g}", rgb[one.channel], one.limit_mm)
                               : fmt::format("{:.3g}", one.limit_mm));
        least = std::min(least, one.limit_mm);
    }
    if (channels.empty())
        return {};
    const std::string limits =
        channels.size() > rgb.size()
            ? fmt::format("{} of {} wavelengths, down to {:.3g}", channels.size(), tissue.channels(), least)
            : fmt::format("{}", fmt::join(channels, ", "));
    return fmt::format("{} {:.3g} mm: {}", of.name.empty() ? fmt::format("layer {}", layer + 1) : of.name,
                       of.thickness_mm, limits);
}

} // namespace

std::optional<std::string> domain_note(const SkinLayers& tissue, ReflectanceModel model)
{
    const std::vector<OutsideDomain> outside = outside_domain(tissue);
    if (!is_the_papers(model) || outside.empty())
        return {};
    std::vector<std::string> layers;
    for (std::size_t i = 0; i < tissue.layers.size(); ++i)
        if (std::string text = domain_text(tissue, i, outside); !text.empty())
            layers.push_back(std::move(text));
    return fmt::format("eqs. (2) and (3) hold for d below 1/(sigma_a + sigma_s' P), which {} of {} layers "
                       "and channels exceed; "
                       "{} (docs/optics.md). Thickness and limits in mm: {}",
                       outside.size(), tissue.layers.size() * tissue.channels(),
                       model == ReflectanceModel::Published
                           ? "published takes the limit for d there"
                           : "printed goes on, and its colours are wrong, often green",
                       fmt::join(layers, "; "));
}

SkinLayers layers_of(const HealingTissue& tissue)
{
    const auto* table = std::get_if<SkinLayers>(&tissue);
    return table ? *table : std::get<ChromophoreSkin>(tissue).layers();
}

} // namespace optics
