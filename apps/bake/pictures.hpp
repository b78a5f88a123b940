// The labelled pictures of `cicatrix bake`. Input colours are linear Rec. 709; the pictures are 8-bit sRGB.
#pragma once
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/color.hpp"
#include "shaders/shared/reflectance_lut.h"

namespace bake_command {

/// Draws the tables side by side, each below its name, with depth (mm) along x and day along y.
cv::Mat3b draw_tables(const std::string& title, const std::vector<std::pair<std::string, cv::Mat3f>>& tables,
                      const shared::LutAxes& axes);

struct ColorRow
{
    std::string name, detail;                       // one line each
    std::vector<std::optional<base::Color>> colors; // one per day; nullopt is drawn as "closed"
};
/// Draws rows of swatches, one column per day, with a gap where the step between days changes.
cv::Mat3b draw_strip(const std::string& title, const std::vector<double>& days,
                     const std::vector<ColorRow>& rows);

} // namespace bake_command
