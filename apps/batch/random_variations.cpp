#include <cmath>
#include <fmt/format.h>
#include <random>

#include "apps/batch/variations.hpp"
#include "wound/synthetic/kind.hpp"

namespace batch_command {
namespace {

/// The standard fixes the output of std::mt19937_64 but not of its distributions, so these are our own.
class Dice
{
  public:
    explicit Dice(std::uint64_t seed) : engine_(seed) {}
    double between(double low, double high) { return low + (high - low) * double(engine_() >> 11) * 0x1p-53; }
    std::size_t below(std::size_t count) { return std::size_t(engine_() % count); }
    template <typename List>
    const auto& one_of(const List& list)
    {
        return list[below(list.size())];
    }

  private:
    std::mt19937_64 engine_;
};

/// Centre and half side of a region for wounds, in face coordinates, and the range of their widths.
struct Area
{
    double x, y, spread, narrowest_mm, widest_mm;
};
constexpr std::array<Area, 5> areas{{{.32, -.06, .07, 10, 42},
                                     {.21, .44, .03, 8, 24},
                                     {.08, -.36, .03, 8, 26},
                                     {.05, .60, .08, 10, 42},
                                     {.03, .10, .02, 6, 14}}};

std::string quoted(const std::string& cell)
{
    if (cell.find_first_of(",\"\n") == std::string::npos)
        return cell;
    std::string result = "\"";
    for (const char c : cell)
        result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + "\"";
}

} // namespace

std::string random_variations(const RandomVariations& options)
{
    Dice dice(options.seed);
    std::string table = "name";
    if (!options.heads.empty())
        table += ",head";
    table +=
        options.photos.empty() ? ",wounds.0.kind,wounds.0.seed" : ",wounds.0.photo,wounds.0.healing.delta";
    table += ",wounds.0.at,wounds.0.width_mm,wounds.0.roll_deg,wounds.0.depth_factor,days,"
             "tissue,lights.0.azimuth_deg,lights.0.elevation_deg,lights.0.intensity,lights.1.intensity,"
             "camera.azimuth_deg,camera.elevation_deg,exposure_stops\n";
    const std::array tissues{"light", "medium", "dark"};
    // One cell at a time: the order of evaluation of function arguments is unspecified.
    const auto number = [&](double low, double high, int digits) {
        table += fmt::format(",{:.{}f}", dice.between(low, high), digits);
    };
    for (std::size_t i = 0; i < options.count; ++i) {
        table += fmt::format("r{:05}", i + 1);
        if (!options.heads.empty())
            table += "," + quoted(dice.one_of(options.heads));
        if (options.photos.empty()) {
            table += fmt::format(",{}", dice.one_of(wound::kind_names()));
            table += fmt::format(",{}", dice.below(1u << 31));
        } else {
            table += "," + quoted(dice.one_of(options.photos));
            // Half closed after 6 to 12 days: slower to faster than is typical of a face. Default wounds
            // close by kind.
            table += fmt::format(",{:.4f}", std::log(2) / std::pow(dice.between(6, 12), 1.5));
        }
        const Area& area = dice.one_of(areas);
        const double side = dice.below(2) == 0 ? -1 : 1;
        const double x = side * (area.x + dice.between(-area.spread, area.spread));
        const double y = area.y + dice.between(-area.spread, area.spread);
        table += fmt::format(",\"[{:.3f}, {:.3f}]\"", x, y);
        number(area.narrowest_mm, area.widest_mm, 1);
        number(-180, 180, 0);
        number(.5, 1.6, 2);
        table += fmt::format(",{}", dice.below(31));
        table += fmt::format(",{}", dice.one_of(tissues));
        number(-65, 65, 0);
        number(-10, 55, 0);
        number(.8, 1.5, 2);
        number(.15, .6, 2);
        // The camera is on the wound's side of the face, or up to 15 degrees on the other side.
        table += fmt::format(",{:.0f}", side * dice.between(-15, 45));
        number(-15, 20, 0);
        number(-.4, .4, 2);
        table += '\n';
    }
    return table;
}

} // namespace batch_command
