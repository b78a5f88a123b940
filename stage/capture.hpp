// Implements `cicatrix capture`: pictures of a healing wound, day by day, and the cost of each. capture() can
// be called any number of times on one device.
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
    std::filesystem::path out = "out"; // created when missing
    std::string title = "default scene";
    std::string mode = "corrected"; // or "published"; written in healing.png and capture.json
    std::vector<std::string> views; // names; empty: all views of the scene or, without views, its camera
    std::uint32_t tile = 2048;      // pictures with a longer side are drawn in tiles; even
    bool transparent = false;       // PNG with straight alpha, EXR with premultiplied alpha
    bool exr = false;               // also write each picture's linear light
    std::size_t orbit = 0;          // number of pictures around the head; 0: one picture per day
    double orbit_deg = 360;         // angle of the orbit

    /// H.264, one file per view; empty: no film. The day advances evenly from the scene's first to its last;
    /// with an orbit the camera moves around the head at the same time.
    std::filesystem::path video;
    double fps = 30, duration_s = 8;

    bool sheet = true; // healing.png
    bool cost = true;  // measure the cost of the shading terms at the end

    /// Called after each picture; may draw with the same renderer, write other files and add fields to the
    /// picture's entry in capture.json.
    std::function<void(const Stage& stage, const scene::Shot& shot, nlohmann::json& entry)> after_picture;
};

/// Call it before any work: throws base::InputError for options that contradict each other or that this
/// machine or scene does not support.
void check_capture(const CaptureOptions& options, const scene::Scene& scene);

/// Draws the pictures of the stage's scene into options.out. Writes capture.json last and returns it. Appends
/// a summary for the user to `lines`. Throws base::InputError.
nlohmann::json capture(Renderer& renderer, const Stage& stage, const CaptureOptions& options,
                       base::Progress& progress, std::vector<std::string>& lines);

} // namespace stage
