// `cicatrix capture`: pictures of a wound healing, day by day, and what each cost. The command is thin;
// capture() does the work, and can be called any number of times on one device.
#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "apps/progress.hpp"
#include "apps/renderer.hpp"
#include "apps/shots.hpp"

namespace app {

struct CaptureOptions
{
    std::filesystem::path out = "out"; // made when it does not exist
    std::string title = "default scene";
    std::string mode = "corrected"; // or "published": what healing.png and capture.json say
    std::vector<std::string> views; // names; empty: those of the scene, else its camera
    std::uint32_t tile = 2048;      // pictures with a longer side are drawn in tiles; even
    bool sheet = true;              // healing.png
    bool cost = true;               // measure what the shading terms cost, at the end

    /// Called after each picture; may draw more with the same renderer, write files of its own and add fields
    /// to the picture's entry in capture.json.
    std::function<void(const Stage& stage, const Shot& shot, nlohmann::json& entry)> after_picture;
};

/// Draws what the stage's scene and the options ask for into options.out; capture.json, written last, is also
/// returned. `lines` receives what a person reads at the end. Throws cicatrix::InputError.
nlohmann::json capture(Renderer& renderer, const Stage& stage, const CaptureOptions& options,
                       Progress& progress, std::vector<std::string>& lines);

void add_capture_command(CLI::App& program);

} // namespace app
