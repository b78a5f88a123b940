// A device with its shaders and executor, and draw(), which draws one picture, whole or in tiles. Pictures
// and film frames use draw(), labels the same tiles, so they agree.
#pragma once
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "engine/gpu/device.hpp"
#include "engine/gpu/executor.hpp"
#include "engine/graph/shader_library.hpp"
#include "scene/command_line.hpp"
#include "scene/shots.hpp"
#include "stage/stage.hpp"

namespace stage {

/// The options of the device that `options` names.
gpu::DeviceOptions device_options(const scene::SceneOptions& options);

/// Create it once for any number of scenes. It must outlive the stages that use its device.
struct Renderer
{
    explicit Renderer(const gpu::DeviceOptions& options) : device(options), executor(device, shaders) {}

    gpu::Device device;
    graph::ShaderLibrary shaders;
    gpu::Executor executor;
};

/// Throws std::runtime_error when the validation layers have reported a message.
void fail_on_validation(const gpu::Device& device);

struct DrawOptions
{
    std::array<std::uint32_t, 2> size{1280, 720};
    bool transparent = false;  // the picture is RGBA with straight alpha, the radiance premultiplied RGBA
    bool radiance = false;     // fill Drawing::radiance
    bool areas = true;         // fill Drawing::bed_texels
    std::uint32_t tile = 2048; // pictures with a longer side are drawn in tiles; even
    std::uint32_t apron = 0;   // ViewportTile::apron; even
    std::optional<double> light_scale; // FrameRequest::light_scale
};

struct Drawing
{
    cv::Mat picture;  // 8-bit sRGB: RGB, or RGBA when transparent
    cv::Mat radiance; // CV_32FC3, or CV_32FC4 when transparent: linear, not exposed; empty unless requested.
    // Encoding radiance * 2^exposure_stops gives the picture
    std::shared_ptr<const std::vector<wound::WoundDay>>
        wounds;                     // on the shot's day, in the order of Stage::loaded().wounds
    std::vector<double> bed_texels; // per wound: the open bed's area in the warped mask
    nlohmann::json passes;          // per pass: name, state, reason, gpu_ms, cpu_ms; summed over the tiles
    double frame_ms = 0;            // summed over the tiles
};

/// The tiles of a picture; one tile if it is drawn whole.
std::vector<passes::ViewportTile> tiles_of(const DrawOptions& options);

/// Throws base::InputError when the device fails.
Drawing draw(Renderer& renderer, const Stage& stage, const scene::Shot& shot, const DrawOptions& options);

} // namespace stage
