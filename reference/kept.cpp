#include "reference/kept.hpp"

#include <cstddef>
#include <fmt/format.h>

#include "base/exr.hpp"
#include "base/file.hpp"
#include "base/input_error.hpp"

namespace reference {
namespace {

constexpr std::size_t floats = sizeof(PixelSums) / sizeof(float);
static_assert(floats == 16, "a channel for each");

std::vector<base::ExrChannel> channels_of(Picture& picture)
{
    const std::size_t row = sizeof(PixelSums) * std::size_t(picture.size().width);
    auto* first = reinterpret_cast<float*>(&picture.sums(0, 0));
    std::vector<base::ExrChannel> channels;
    for (std::size_t i = 0; i < floats; ++i)
        channels.push_back({fmt::format("sum{:02}", i), first + i, sizeof(PixelSums), row});
    return channels;
}

/// Where a truth's numbers stand in the file.
void put(base::ExrNumbers& numbers, const std::string& name, const base::Color& color)
{
    for (int c = 0; c < 3; ++c)
        numbers[fmt::format("{}{}", name, c)] = color[c];
}

base::Color taken(const base::ExrNumbers& numbers, const std::string& name)
{
    return {numbers.at(name + "0"), numbers.at(name + "1"), numbers.at(name + "2")};
}

base::ExrNumbers numbers_of(const Truth& truth)
{
    const ReducedTissue skin = truth.skin.value_or(ReducedTissue{});
    base::ExrNumbers numbers{{"passes", truth.picture.passes()}, {"cpu_seconds", truth.cpu_seconds}};
    put(numbers, "albedo", skin.albedo);
    put(numbers, "mean_free_path_mm", skin.mean_free_path_mm);
    put(numbers, "diffuse_mean_free_path_mm", skin.diffuse_mean_free_path_mm);
    put(numbers, "worst_edge", skin.worst_edge);
    put(numbers, "scattering_per_m", skin.scattering_per_m);
    return numbers;
}

} // namespace

std::filesystem::path kept_path(std::uint64_t key)
{
    return base::cache_folder() / "reference" / fmt::format("{:016x}.exr", key);
}

void read_kept(const std::filesystem::path& path, Truth& truth)
{
    Picture picture(truth.picture.size());
    base::ExrNumbers numbers = numbers_of(truth);
    try {
        base::read_exr_channels(path, picture.size(), channels_of(picture), numbers);
    } catch (const base::InputError&) {
        return; // missing or damaged: it is traced and written anew
    }
    picture.set_passes(std::uint32_t(numbers.at("passes")));
    truth.picture = std::move(picture);
    truth.cpu_seconds = numbers.at("cpu_seconds");
    if (const base::Color path_mm = taken(numbers, "mean_free_path_mm"); path_mm[0] > 0)
        truth.skin = {taken(numbers, "albedo"), path_mm, taken(numbers, "diffuse_mean_free_path_mm"),
                      taken(numbers, "worst_edge"), taken(numbers, "scattering_per_m")};
}

std::string write_kept(const std::filesystem::path& path, const Truth& truth)
{
    Picture& picture = const_cast<Picture&>(truth.picture); // ExrChannel points to what may be read into
    try {
        base::make_folder(path.parent_path());
        base::write_exr_channels(path, picture.size(), channels_of(picture), numbers_of(truth));
        return {};
    } catch (const base::InputError& error) {
        return fmt::format("the picture is not kept for the next time: {}: {}", error.where(),
                           error.problem());
    }
}

} // namespace reference
