// Which pixels show what, found by rays through the pixels' centres. Errors of pictures are reported for each
// region apart, because a mean over the whole face hides a wound or the edge of a shadow.
#pragma once
#include <array>
#include <opencv2/core.hpp>
#include <string_view>

#include "reference/truth.hpp"

namespace reference {

enum class Region : std::uint8_t
{
    Skin,        // the head's skin, wounds and their surroundings left out
    Wound,       // the open bed
    Ring,        // new epithelium, then the scar
    ShadowEdges, // skin at most two pixels from the border of a cast shadow
    Thin,        // skin less than 10 mm thick along the inward normal: ears, nostrils, lips
};
inline constexpr std::array<std::string_view, 5> region_names{"skin", "wound", "ring", "shadow_edges",
                                                              "thin"};

/// Per region and pixel 255 or 0. Skin, wound and ring do not overlap; shadow edges and thin parts are parts
/// of any of them. Pixels that show background, eyes, hair or garments are in none.
using Regions = std::array<cv::Mat1b, region_names.size()>;

/// Of the request's camera, size and day. Throws base::InputError as find_truth() does.
Regions find_regions(const scene::LoadedScene& scene, const Request& request);

} // namespace reference
