// A batch as a table: every row of a CSV is a base scene with some of its fields changed, or every file of a
// folder is a scene. All is read and checked before anything is drawn.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace batch_command {

struct Variation
{
    std::string name;  // of its folder: letters, digits, - _ .
    std::string where; // "variations.csv: row 3", for messages
    scene::Scene scene;
};

/// `path`: a CSV whose header names fields of a scene ("wounds.0.width_mm", "head", "days"; also "name" and
/// "scene", a scene file to start from), files relative to its folder, an empty cell leaving the field alone;
/// or a folder of .json scenes. `base`: what rows without a "scene" start from. Throws base::InputError
/// naming file, row, column and cure.
std::vector<Variation> read_variations(const std::filesystem::path& path, const scene::Scene& base);

/// What can be told without drawing: that files exist, tissues are valid and places known. Throws
/// base::InputError.
void check_files(const Variation& variation);

/// Which of `count` variations belong to share `share` (from 1) of `shares`: every one to exactly one share.
std::vector<std::size_t> share_of(std::size_t count, std::size_t share, std::size_t shares);

struct RandomVariations
{
    std::size_t count = 100;
    std::uint64_t seed = 1;
    std::vector<std::string> heads,
        photos; // to choose from; empty: the base scene's head, wounds by the program
};
/// A CSV of variations drawn at random, the same for the same seed on every machine: wound, place, width,
/// roll, depth, pace of healing, day, skin, light, camera, exposure.
std::string random_variations(const RandomVariations& options);

} // namespace batch_command
