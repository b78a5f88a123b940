// A page of all kinds of default wound over the days: a row for each kind, a close-up for each day.
#pragma once
#include <filesystem>

#include "base/progress.hpp"
#include "stage/renderer.hpp"

namespace capture_command {

/// The kinds on the scene's head, in the place and with the seed, width, lights, tissue and shading of the
/// scene's first wound, each with the course that is usual for it. A close-up is as wide as the scene's
/// picture is, but at most base::sheet_cell_width. Writes gallery.png and gallery.json to `out`. Throws
/// base::InputError.
void draw_gallery(stage::Renderer& renderer, stage::Stage& stage, const std::filesystem::path& out,
                  base::Progress& progress);

} // namespace capture_command
