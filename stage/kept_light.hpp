// What it costs a picture that light is kept on the skin (FrameRequest::light_scale) instead of computed in
// every pixel.
#pragma once
#include <opencv2/core.hpp>

#include "engine/gpu/executor.hpp"
#include "stage/stage.hpp"

namespace stage {

/// CIEDE2000 between the two, over the pixels that the head covers in both.
struct KeptLightError
{
    bool kept =
        false; // false: the head, the shading or the camera does not allow it; then the pictures are equal
    std::size_t pixels = 0;
    double mean = 0, p95 = 0, p999 = 0, max = 0;
    cv::Mat1f de; // of the picture's size; 0 where no head is
};

/// Draws the frame both ways. `request.tile` is made transparent. Throws base::InputError when the device
/// fails.
KeptLightError measure_kept_light(gpu::Executor& executor, const Stage& stage, FrameRequest request);

} // namespace stage
