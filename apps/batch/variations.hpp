// The variations of a batch: the rows of a CSV, each a base scene with some fields changed, or the scene
// files of a folder. All of them are read and checked before the first picture is drawn.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace batch_command {

struct Variation
{
    std::string name;  // of its output folder; letters, digits, - _ .
    std::string where; // "variations.csv: line 3", for error messages
    scene::Scene scene;
};

/// `path`: a folder of .json scenes, or a CSV whose header names fields of a scene ("wounds.0.width_mm",
/// "head", "days"; also "name" and "scene", a scene file to start from). Files are relative to the CSV's
/// folder; an empty cell does not change the field. `base`: the scene that rows without "scene" start from.
/// Throws base::InputError that names file, line, column and remedy.
std::vector<Variation> read_variations(const std::filesystem::path& path, const scene::Scene& base);

/// Checks that files exist, the tissue is valid and places are known. Throws base::InputError.
void check_files(const Variation& variation);

/// Indices of the variations in share `share` (1..`shares`) of `count`; each belongs to exactly one share.
std::vector<std::size_t> share_of(std::size_t count, std::size_t share, std::size_t shares);

struct RandomVariations
{
    std::size_t count = 100;
    std::uint64_t seed = 1;
    std::vector<std::string> heads;  // to choose from; empty: the base scene's head
    std::vector<std::string> photos; // to choose from; empty: synthetic wounds
};
/// A CSV of random variations of wound, place, width, roll, depth, healing rate, day, skin, light, camera and
/// exposure. The same seed gives the same CSV on every machine.
std::string random_variations(const RandomVariations& options);

} // namespace batch_command
