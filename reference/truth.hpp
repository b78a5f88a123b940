// The truth of a scene: its path-traced picture, as good as was asked for, kept by content so that it is
// traced once.
//
//   const Truth truth = find_truth(load(scene), request, {.noise_de = .5}, progress, notes);
//   truth.picture.radiance() ...
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "head/camera.hpp"
#include "reference/levels.hpp"
#include "reference/picture.hpp"
#include "scene/loaded_scene.hpp"

namespace reference {

/// Which picture.
struct Request
{
    head::Camera camera;
    std::array<std::uint32_t, 2> size{1280, 720};
    double day = 0;
    Levels levels;
    std::uint64_t seed = 1;
};

/// Noise to which a picture is traced when nothing is said, CIEDE2000.
inline constexpr double usual_noise_de = .5;

/// How good it has to be: whatever is reached first ends the work. None of them: usual_noise_de.
struct Until
{
    std::optional<std::uint32_t> samples; // per pixel; whole passes are made
    std::optional<double> noise_de;       // Picture::noise_de()
    std::optional<double> seconds;        // of this run
};

struct Truth
{
    Picture picture;
    double noise_de = 0;    // at the scene's exposure
    double cpu_seconds = 0; // of all threads, in all runs
    bool interrupted = false;
    std::optional<ReducedTissue> skin; // with subsurface scattering
};

/// Throws base::InputError, naming the part of the scene, for what cannot be traced.
void check_request(const scene::LoadedScene& scene, const Request& request);

struct TruthOptions
{
    unsigned threads = 0;  // 0: one per core
    bool use_cache = true; // begin where an earlier run ended, and keep what this one made
};

/// Traces what the cache does not hold. After Ctrl-C it returns what is done so far, which is kept, too.
/// `notes` takes what went wrong without harm: a cache that cannot be written. Throws base::InputError.
Truth find_truth(const scene::LoadedScene& scene, const Request& request, const Until& until,
                 base::Progress& progress, std::vector<std::string>& notes, const TruthOptions& options = {});

/// Names all that the picture depends on, but for how good it is.
std::uint64_t truth_key(const scene::LoadedScene& scene, const Request& request);

} // namespace reference
