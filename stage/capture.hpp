// `cicatrix capture`: pictures of a wound healing, day by day, and what each cost. The command is thin;
// capture() does the work, and can be called any number of times on one device.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "scene/shots.hpp"
#include "stage/renderer.hpp"

namespace stage {

struct CaptureOptions
{
    std::filesystem::path out = "out"; // made when it does not exist
    std::string title = "default scene";
    std::string mode = "corrected"; // or "published": what healing.png and capture.json say
    std::vector<std::string> views; // names; empty: those of the scene, else its camera
    std::uint32_t tile = 2048;      // pictures with a longer side are drawn in tiles; even
    bool transparent = false;       // PNG with straight alpha; EXR premultiplied
    bool exr = false;               // linear light beside each picture
    std::size_t orbit = 0;          // so many pictures around the head instead of one per day
    double orbit_deg = 360;         // how far around

    /// H.264, each view's in a file of its own; empty: no film. The day moves evenly from the scene's first
    /// to its last; with an orbit the camera goes around meanwhile.
    std::filesystem::path video;
    double fps = 30, duration_s = 8;

    bool sheet = true; // healing.png
    bool cost = true;  // measure what the shading terms cost, at the end

    /// Called after each picture; may draw more with the same renderer, write files of its own and add fields
    /// to the picture's entry in capture.json.
    std::function<void(const Stage& stage, const scene::Shot& shot, nlohmann::json& entry)> after_picture;
};

/// Throws base::InputError for options that do not go together or need what is not there, before any
/// work.
void check_capture(const CaptureOptions& options, const scene::Scene& scene);

/// Draws what the stage's scene and the options ask for into options.out; capture.json, written last, is also
/// returned. `lines` receives what a person reads at the end. Throws base::InputError.
nlohmann::json capture(Renderer& renderer, const Stage& stage, const CaptureOptions& options,
                       base::Progress& progress, std::vector<std::string>& lines);

} // namespace stage
