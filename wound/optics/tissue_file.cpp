#include "wound/optics/tissue_file.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "base/json_fields.hpp"
#include "wound/optics/chromophores.hpp"

namespace optics {

using base::Fields;
using nlohmann::json;

namespace {

constexpr double max_per_mm = 1e6, max_mm = 1e9;

double read_unit(Fields& tissue)
{
    if (!tissue.has("unit"))
        tissue.fail("unit", "is missing", R"(add "unit": "1/mm" or "unit": "1/cm")");
    return tissue.choice("unit", "", {"1/mm", "1/cm"}) == "1/mm" ? 1 : 0.1;
}

double read_thickness(Fields& fields)
{
    const json* value = fields.get("thickness_mm");
    if (value != nullptr && *value == "inf")
        return std::numeric_limits<double>::infinity();
    return fields.required_number("thickness_mm", 0, max_mm);
}

Chromophores read_chromophores(const json& object, const std::string& where)
{
    Fields fields(object, where);
    const Chromophores standard;
    const Chromophores content{
        .melanosomes = fields.number("melanosomes", standard.melanosomes, 0, 1),
        .blood = fields.number("blood", standard.blood, 0, 1),
        .oxygenation = fields.number("oxygenation", standard.oxygenation, 0, 1),
        .bilirubin_mmol_l = fields.number("bilirubin_mmol_l", standard.bilirubin_mmol_l, 0, 100),
        .water = fields.number("water", standard.water, 0, 1),
        .baseline = fields.number("baseline", standard.baseline, 0, 100),
        .scattering_500nm = fields.number("scattering_500nm_per_mm", standard.scattering_500nm, 0, 1e3),
        .scattering_power = fields.number("scattering_power", standard.scattering_power, -10, 10)};
    fields.finish();
    return content;
}

void read_coefficients(Fields& fields, Layer& layer, double per_mm)
{
    const double limit = max_per_mm / per_mm;
    layer.sigma_a = fields.number_or_list("sigma_a", 0, limit);
    const bool reduced = fields.has("sigma_s_reduced");
    if (fields.has("sigma_s") == reduced)
        fields.fail("sigma_s_reduced", "scattering is given twice or not at all",
                    "give one of sigma_s_reduced and sigma_s");
    layer.sigma_s_reduced = fields.number_or_list(reduced ? "sigma_s_reduced" : "sigma_s", 0, limit);
    for (double& s : layer.sigma_s_reduced)
        s *= reduced ? per_mm : per_mm * (1 - layer.g);
    for (double& a : layer.sigma_a)
        a *= per_mm;
}

Layer read_layer(const json& object, const std::string& where, double per_mm)
{
    Fields fields(object, where);
    Layer layer;
    layer.name = fields.text("name", "");
    layer.g = fields.number("g", 0, -1, 1);
    layer.n = fields.required_number("n", 1, 3);
    layer.thickness_mm = read_thickness(fields);
    if (const json* content = fields.get("chromophores")) {
        for (const char* field : {"sigma_a", "sigma_s_reduced", "sigma_s"})
            if (fields.has(field))
                fields.fail(field, "is given beside chromophores", "give one or the other");
        layer = chromophore_layer(layer.name, read_chromophores(*content, fields.where("chromophores")),
                                  layer.g, layer.n, layer.thickness_mm);
    } else
        read_coefficients(fields, layer, per_mm);
    fields.finish();
    return layer;
}

// Repeats a single number for all channels.
void broadcast(SkinLayers& tissue, const Fields& fields)
{
    std::size_t count = 1;
    for (const Layer& layer : tissue.layers)
        count = std::max({count, layer.sigma_a.size(), layer.sigma_s_reduced.size()});
    for (std::size_t i = 0; i < tissue.layers.size(); ++i)
        for (auto* values : {&tissue.layers[i].sigma_a, &tissue.layers[i].sigma_s_reduced}) {
            if (values->size() != 1 && values->size() != count)
                fields.fail(fmt::format("layers/{}", i),
                            fmt::format("{} channels where another layer has {}", values->size(), count),
                            "give every array the same length");
            values->resize(count, values->front());
        }
}

} // namespace

SkinLayers parse_tissue(const json& document, std::string_view file)
{
    Fields fields(document, fmt::format("{}: ", file));
    const double per_mm = read_unit(fields);
    SkinLayers tissue;
    tissue.n_above = fields.number("n_above", 1, 1, 3);
    tissue.n_below = fields.number("n_below", 1, 1, 3);
    const json* layers = fields.get("layers");
    fields.finish();
    if (layers == nullptr || !layers->is_array() || layers->empty())
        fields.fail("layers", "is not a list of layers", "give at least one layer, from the top down");
    for (std::size_t i = 0; i < layers->size(); ++i)
        tissue.layers.push_back(
            read_layer((*layers)[i], fmt::format("{}/{}", fields.where("layers"), i), per_mm));
    broadcast(tissue, fields);
    return tissue;
}

SkinLayers read_tissue(const std::filesystem::path& path)
{
    return parse_tissue(base::read_json(path), path.string());
}

} // namespace optics
