// A device with all it takes to draw, and how one picture is drawn with it: whole or by tiles. Pictures,
// frames of films and labels all come from here, so they agree.
#pragma once
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "apps/stage.hpp"
#include "engine/device.hpp"
#include "engine/executor.hpp"
#include "engine/shader_library.hpp"

namespace app {

/// Made once, for any number of scenes; stages made on its device must be gone before it.
struct Renderer
{
    explicit Renderer(const engine::DeviceOptions& options) : device(options), executor(device, shaders) {}

    engine::Device device;
    engine::ShaderLibrary shaders;
    engine::Executor executor;
};

/// Throws std::runtime_error when the validation layers have said anything.
void fail_on_validation(const engine::Device& device);

/// What one picture shows.
struct Shot
{
    double day = 0;
    std::string view; // the camera's name
    passes::Camera camera;
    std::string name;    // of its files, without extension: "day_005"
    double turn_deg = 0; // by which the view's camera has gone about the head
};

struct DrawOptions
{
    std::array<std::uint32_t, 2> size{1280, 720};
    bool transparent = false;  // the picture is RGBA with straight alpha, the radiance premultiplied RGBA
    bool radiance = false;     // wanted
    bool areas = true;         // bed_texels are wanted
    std::uint32_t tile = 2048; // pictures with a longer side are drawn in tiles; even
};

struct Drawing
{
    cv::Mat picture;  // 8-bit sRGB: RGB, or RGBA when transparent
    cv::Mat radiance; // CV_32FC3, or CV_32FC4 when transparent: linear, not exposed; empty unless wanted.
                      // Encoding radiance * 2^exposure_stops gives the picture
    std::vector<double> bed_texels; // per wound: the open bed's area in the warped mask
    nlohmann::json passes;          // per pass: name, state, reason, gpu_ms, cpu_ms; times over all tiles
    double frame_ms = 0;            // over all tiles
};

/// The tiles of a picture, whole pictures being one of them.
std::vector<passes::Canvas> canvases(const DrawOptions& options);

/// Puts a tile's image where it belongs in the whole, which is made with the first; what reaches beyond is
/// dropped.
void place(cv::Mat& whole, const cv::Mat& image, const passes::Canvas& tile);

/// Throws cicatrix::InputError when the device fails.
Drawing draw(Renderer& renderer, const Stage& stage, const Shot& shot, const DrawOptions& options);

} // namespace app
