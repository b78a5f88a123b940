// The pictures of `cicatrix bake`: labelled, small, drawn with OpenCV. Colours are linear Rec. 709 until they
// are written.
#pragma once
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/color.hpp"
#include "shaders/shared/reflectance_lut.h"

namespace bake_command {

/// Tables side by side under their names, with depth (mm) and day along the axes.
cv::Mat3b draw_tables(const std::string& title, const std::vector<std::pair<std::string, cv::Mat3f>>& tables,
                      const shared::LutAxes& axes);

struct ColorRow
{
    std::string name, detail;                       // a line each
    std::vector<std::optional<base::Color>> colors; // one for each day; without one, "closed"
};
/// Rows of swatches under the days they belong to, with a gap where the step of the days changes.
cv::Mat3b draw_strip(const std::string& title, const std::vector<double>& days,
                     const std::vector<ColorRow>& rows);

} // namespace bake_command
