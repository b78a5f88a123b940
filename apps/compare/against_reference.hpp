// `cicatrix compare SCENE.json --reference`: how far a scene's pictures are from its path-traced truth, for
// each region of the picture apart.
#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "scene/command_line.hpp"
#include "stage/truth_error.hpp"

namespace CLI {
class App;
}

namespace compare_command {

struct ReferenceOptions
{
    bool wanted = false;  // --reference
    bool systems = false; // --systems
    reference::Until until;
    reference::Levels levels;
};

struct CompareOptions : scene::SceneOptions
{
    std::string other; // file of the second scene
    std::filesystem::path out = "out/compare";
    std::vector<std::string> views;
    int rounds = 9; // of the cost measurement, for each scene
    ReferenceOptions reference;
    std::filesystem::path document; // of --systems; empty: rivals.md in `out`
};

void add_reference_options(CLI::App& command, CompareOptions& options);

/// Writes the pages and numbers into options.out. Throws base::InputError.
void compare_with_reference(const CompareOptions& options);

} // namespace compare_command
