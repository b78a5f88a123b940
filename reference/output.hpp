// The files of a path-traced picture: reference.exr, reference.png, reference.json.
#pragma once
#include <filesystem>

#include "reference/truth.hpp"

namespace reference {

/// Into a folder that is made when it does not exist; reference.json is written last. Throws
/// base::InputError. reference.exr: R G B A (premultiplied), and layers diffuse, specular, diffuse_error and
/// specular_error, the standard errors; all linear, not exposed. reference.png: as the rasteriser encodes it.
void write_truth(const std::filesystem::path& folder, const scene::LoadedScene& scene, const Request& request,
                 const Truth& truth);

} // namespace reference
