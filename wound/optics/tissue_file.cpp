#include "wound/optics/tissue_file.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/ranges.h>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "base/input_error.hpp"
#include "wound/optics/chromophores.hpp"

namespace optics {

using base::InputError;
using base::plain;
using nlohmann::json;

namespace {

// One JSON object at a known place of a file; every message names both.
class Fields
{
  public:
    Fields(const json& object, std::string file, std::string place)
        : object_(object), file_(std::move(file)), place_(std::move(place))
    {
        if (!object.is_object())
            throw InputError(where(""), "not an object", "write {...} here");
    }

    std::string where(std::string_view field) const
    {
        const std::string slash = field.empty() && !place_.empty() ? "" : "/";
        return fmt::format("{}: {}{}{}", file_, place_, slash, field);
    }
    Fields object(std::string_view field) const
    {
        return {at(field), file_, fmt::format("{}/{}", place_, field)};
    }
    bool has(std::string_view field) const { return object_.contains(field); }
    const json& at(std::string_view field) const { return *object_.find(field); }

    void allow_only(std::initializer_list<std::string_view> known) const
    {
        for (const auto& [key, value] : object_.items())
            if (std::find(known.begin(), known.end(), key) == known.end())
                throw InputError(where(key), "unknown field",
                                 fmt::format("known are {}", fmt::join(known, ", ")));
    }

    double number(const json& value, std::string_view field, double low, double high) const
    {
        if (!value.is_number())
            throw InputError(where(field), "not a number",
                             fmt::format("give a number from {} to {}", plain(low), plain(high)));
        const double x = value.get<double>();
        if (!(x >= low && x <= high))
            throw InputError(where(field), plain(x) + " is out of range",
                             fmt::format("give a number from {} to {}", plain(low), plain(high)));
        return x;
    }

    double number_or(std::string_view field, double fallback, double low, double high) const
    {
        return has(field) ? number(at(field), field, low, high) : fallback;
    }

    double required_number(std::string_view field, double low, double high) const
    {
        require(field);
        return number(at(field), field, low, high);
    }

    std::vector<double> channels(std::string_view field, double low, double high) const
    {
        require(field);
        const json& value = at(field);
        if (!value.is_array())
            return {number(value, field, low, high)};
        if (value.empty())
            throw InputError(where(field), "an empty array", "give one number per channel");
        std::vector<double> result;
        for (std::size_t i = 0; i < value.size(); ++i)
            result.push_back(number(value[i], fmt::format("{}/{}", field, i), low, high));
        return result;
    }

  private:
    void require(std::string_view field) const
    {
        if (!has(field))
            throw InputError(where(field), "missing", "add this field");
    }

    const json& object_;
    std::string file_, place_;
};

constexpr double max_per_mm = 1e6, max_mm = 1e9;

double read_unit(const Fields& tissue)
{
    if (!tissue.has("unit"))
        throw InputError(tissue.where("unit"), "missing", R"(add "unit": "1/mm" or "unit": "1/cm")");
    const json& unit = tissue.at("unit");
    if (unit == "1/mm")
        return 1;
    if (unit == "1/cm")
        return 0.1;
    throw InputError(tissue.where("unit"), "not a known unit", R"(use "1/mm" or "1/cm")");
}

double read_thickness(const Fields& fields)
{
    if (fields.has("thickness_mm") && fields.at("thickness_mm") == "inf")
        return std::numeric_limits<double>::infinity();
    return fields.required_number("thickness_mm", 0, max_mm);
}

Chromophores read_chromophores(const Fields& fields)
{
    fields.allow_only({"melanosomes", "blood", "oxygenation", "bilirubin_mmol_l", "water", "baseline",
                       "scattering_500nm_per_mm", "scattering_power"});
    const Chromophores standard;
    return {.melanosomes = fields.number_or("melanosomes", standard.melanosomes, 0, 1),
            .blood = fields.number_or("blood", standard.blood, 0, 1),
            .oxygenation = fields.number_or("oxygenation", standard.oxygenation, 0, 1),
            .bilirubin_mmol_l = fields.number_or("bilirubin_mmol_l", standard.bilirubin_mmol_l, 0, 100),
            .water = fields.number_or("water", standard.water, 0, 1),
            .baseline = fields.number_or("baseline", standard.baseline, 0, 100),
            .scattering_500nm =
                fields.number_or("scattering_500nm_per_mm", standard.scattering_500nm, 0, 1e3),
            .scattering_power = fields.number_or("scattering_power", standard.scattering_power, -10, 10)};
}

Layer read_layer(const Fields& fields, double per_mm)
{
    fields.allow_only(
        {"name", "chromophores", "sigma_a", "sigma_s_reduced", "sigma_s", "g", "n", "thickness_mm"});
    Layer layer;
    if (fields.has("name")) {
        if (!fields.at("name").is_string())
            throw InputError(fields.where("name"), "not a string", "put the name in quotes");
        layer.name = fields.at("name").get<std::string>();
    }
    layer.g = fields.number_or("g", 0, -1, 1);
    layer.n = fields.required_number("n", 1, 3);
    layer.thickness_mm = read_thickness(fields);
    if (fields.has("chromophores")) {
        for (std::string_view field : {"sigma_a", "sigma_s_reduced", "sigma_s"})
            if (fields.has(field))
                throw InputError(fields.where(field), "stands beside chromophores", "give one or the other");
        const Chromophores content = read_chromophores(fields.object("chromophores"));
        return chromophore_layer(layer.name, content, layer.g, layer.n, layer.thickness_mm);
    }
    const double limit = max_per_mm / per_mm;
    layer.sigma_a = fields.channels("sigma_a", 0, limit);
    if (fields.has("sigma_s") == fields.has("sigma_s_reduced"))
        throw InputError(fields.where("sigma_s_reduced"), "scattering is given twice or not at all",
                         "give one of sigma_s_reduced and sigma_s");
    const bool reduced = fields.has("sigma_s_reduced");
    layer.sigma_s_reduced = fields.channels(reduced ? "sigma_s_reduced" : "sigma_s", 0, limit);
    for (double& s : layer.sigma_s_reduced)
        s *= reduced ? per_mm : per_mm * (1 - layer.g);
    for (double& a : layer.sigma_a)
        a *= per_mm;
    return layer;
}

// A single number stands for all channels.
void broadcast(SkinLayers& tissue, const Fields& fields)
{
    std::size_t count = 1;
    for (const Layer& layer : tissue.layers)
        count = std::max({count, layer.sigma_a.size(), layer.sigma_s_reduced.size()});
    for (std::size_t i = 0; i < tissue.layers.size(); ++i)
        for (auto* values : {&tissue.layers[i].sigma_a, &tissue.layers[i].sigma_s_reduced}) {
            if (values->size() != 1 && values->size() != count)
                throw InputError(fields.where(fmt::format("layers/{}", i)),
                                 fmt::format("{} channels where another layer has {}", values->size(), count),
                                 "give every array the same length");
            values->resize(count, values->front());
        }
}

} // namespace

SkinLayers parse_tissue(const json& document, std::string_view file)
{
    const Fields fields(document, std::string(file), "");
    fields.allow_only({"unit", "n_above", "n_below", "layers"});
    const double per_mm = read_unit(fields);
    SkinLayers tissue;
    tissue.n_above = fields.number_or("n_above", 1, 1, 3);
    tissue.n_below = fields.number_or("n_below", 1, 1, 3);
    if (!fields.has("layers") || !fields.at("layers").is_array() || fields.at("layers").empty())
        throw InputError(fields.where("layers"), "not a list of layers",
                         "give at least one layer, from the top down");
    const json& layers = fields.at("layers");
    for (std::size_t i = 0; i < layers.size(); ++i)
        tissue.layers.push_back(
            read_layer(Fields(layers[i], std::string(file), fmt::format("/layers/{}", i)), per_mm));
    broadcast(tissue, fields);
    return tissue;
}

SkinLayers read_tissue(const std::filesystem::path& path)
{
    return parse_tissue(base::read_json(path), path.string());
}

} // namespace optics
