#include "apps/report/comparison.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "base/input_error.hpp"
#include "base/json_fields.hpp"

namespace report_command {
namespace {
using nlohmann::json;

constexpr double level = 0.05; // for all comparisons together

/// The numbers of an array, without nulls.
std::vector<double> numbers(const json& values)
{
    std::vector<double> result;
    for (const json& value : values)
        if (!value.is_null())
            result.push_back(value.get<double>());
    return result;
}

struct Pair
{
    std::string where, what;
    std::vector<double> before, after;
};

/// Every frame and pass with samples in both reports.
std::vector<Pair> pairs(const json& before, const json& after)
{
    constexpr std::size_t least = 5; // samples
    std::vector<Pair> found;
    const auto add = [&](const std::string& where, const std::string& what, const json& a, const json& b) {
        Pair pair{where, what, numbers(a), numbers(b)};
        if (pair.before.size() >= least && pair.after.size() >= least)
            found.push_back(std::move(pair));
    };
    for (const json& now : after.at("cases"))
        for (const json& then : before.at("cases")) {
            if (now.at("name") != then.at("name"))
                continue;
            const json &a = then.at("samples"), &b = now.at("samples");
            add(now.at("name"), "frame", a.at("wall_ms"), b.at("wall_ms"));
            for (const auto& [pass, samples] : b.at("gpu_ms").items())
                if (a.at("gpu_ms").contains(pass))
                    add(now.at("name"), pass, a.at("gpu_ms").at(pass), samples);
        }
    return found;
}

void warn(std::vector<std::string>& warnings, const json& before, const json& after, const char* pointer,
          const char* name)
{
    const json::json_pointer place(pointer);
    const json a = before.value(place, json(nullptr)), b = after.value(place, json(nullptr));
    if (a == b)
        return;
    warnings.push_back(a.is_structured() || b.is_structured()
                           ? fmt::format("{} differs", name)
                           : fmt::format("{} differs: {} before, {} now", name, a.dump(), b.dump()));
}

} // namespace

json read_report(const std::filesystem::path& path)
{
    const json report = base::read_json(path);
    if (!report.is_object() || report.value("format", json()) != "cicatrix report")
        throw base::InputError(path.string(), "is not a report",
                               "give a report.json written by cicatrix report");
    if (report.value("version", json()) != 1)
        throw base::InputError(path.string() + ": /version",
                               "is " + report.value("version", json()).dump() + ", supported is 1",
                               "create it again with this version of cicatrix");
    try {
        pairs(report, report); // reads every field that a comparison reads
    } catch (const json::exception& error) {
        throw base::InputError(path.string(), fmt::format("is damaged: {}", error.what()),
                               "create it again with cicatrix report");
    }
    return report;
}

Comparison compare_reports(const json& before, const json& after, const std::filesystem::path& against)
{
    Comparison comparison{.against = against.string()};
    for (const auto& [pointer, name] : {std::pair("/device/name", "the device"),
                                        {"/device/driver", "the driver"},
                                        {"/machine/cpu", "the processor"},
                                        {"/machine/cores", "the number of cores"},
                                        {"/program/build", "the build"},
                                        {"/program/sanitizers", "the use of sanitizers"},
                                        {"/settings/size", "the size"},
                                        {"/settings/samples_per_pixel", "the number of samples per pixel"},
                                        {"/settings/validation", "the use of validation"},
                                        {"/head", "the head"},
                                        {"/scene", "the scene"}})
        warn(comparison.warnings, before, after, pointer, name);
    const std::vector<Pair> all = pairs(before, after);
    for (const Pair& pair : all) {
        ComparedTime time{pair.where, pair.what};
        time.before_ms = base::quantile(pair.before, 0.5);
        time.after_ms = base::quantile(pair.after, 0.5);
        if (!(time.before_ms > 0 && time.after_ms > 0))
            continue; // shorter than the clock's resolution
        time.ratio = base::ratio_of_medians(pair.before, pair.after, level / double(all.size()));
        time.drift = std::max(base::drift_of(pair.before), base::drift_of(pair.after));
        time.exceeds_noise = time.ratio.low > time.drift || time.ratio.high < 1 / time.drift;
        comparison.times.push_back(time);
    }
    return comparison;
}

std::string to_text(const Comparison& comparison)
{
    std::string text = fmt::format("against {}:\n", comparison.against);
    for (const std::string& warning : comparison.warnings)
        text += fmt::format("  warning: {}\n", warning);
    text += fmt::format("  {:<14} {:<20} {:>9} {:>9} {:>7}  {:<15} {:>6}\n", "case", "what", "before ms",
                        "now ms", "ratio", "interval", "drift");
    std::size_t beyond = 0;
    for (const ComparedTime& time : comparison.times) {
        beyond += time.exceeds_noise;
        text += fmt::format("  {:<14} {:<20} {:9.3f} {:9.3f} {:7.3f}  {:<15} {:6.3f}  {}\n", time.where,
                            time.what, time.before_ms, time.after_ms, time.ratio.ratio,
                            fmt::format("{:.3f} .. {:.3f}", time.ratio.low, time.ratio.high), time.drift,
                            !time.exceeds_noise    ? "within the noise"
                            : time.ratio.ratio > 1 ? "slower"
                                                   : "faster");
    }
    return text +
           fmt::format("  {} of {} differences exceed the noise (moving-block bootstrap of the ratio "
                       "of medians, {:g} % for all together, and more than the drift within either run)\n",
                       beyond, comparison.times.size(), 100 * level);
}

} // namespace report_command
