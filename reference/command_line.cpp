#include "reference/command_line.hpp"

#include <CLI/CLI.hpp>

#include "base/number_option.hpp"

namespace reference {

void add_level_options(CLI::App& command, Levels& levels)
{
    const auto off = [&](const char* name, bool& level, const char* what) {
        command.add_flag_callback(
            name, [&level] { level = false; }, what);
    };
    off("--no-shadows", levels.shadows, "Light passes through the head");
    off("--no-ambient", levels.ambient, "No light from the surroundings");
    off("--no-subsurface", levels.subsurface, "Skin is Lambertian, of the same albedo");
    off("--no-specular", levels.specular, "No highlights");
    command.add_option("--bounces", levels.bounces, "How often light may go from skin to skin")
        ->transform(base::whole_number_from(0, 64))
        ->capture_default_str();
    command
        .add_option(
            "--anisotropy", levels.medium.anisotropy,
            "Henyey-Greenstein's g of the medium under the skin; how far light spreads stays the same")
        ->check(base::number_from(-0.95, 0.95))
        ->type_name("G")
        ->capture_default_str();
    command
        .add_option(
            "--index", levels.medium.index,
            "Refractive index of that medium for Fresnel reflection at its boundary; 1: matched, none")
        ->check(base::number_from(1, 3))
        ->type_name("N")
        ->capture_default_str();
}

void add_until_options(CLI::App& command, Until& until)
{
    command.add_option("--samples", until.samples, "Stop at so many samples per pixel")
        ->transform(base::whole_number_from(8, 1'000'000))
        ->type_name("N");
    command
        .add_option(
            "--noise", until.noise_de,
            "Stop when two such pictures would differ by this mean CIEDE2000; .5 when nothing is said")
        ->check(base::number_from(0.01, 100))
        ->type_name("DE");
    command.add_option("--seconds", until.seconds, "Stop after this time")
        ->check(base::number_from(1, 1e7))
        ->type_name("S");
}

} // namespace reference
