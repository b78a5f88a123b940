#include "head/gltf_load.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <opencv2/imgproc.hpp>

#include "base/image_codec.hpp"
namespace head {
namespace {

/// Decodes each picture once, even if several textures use it.
class Pictures
{
  public:
    Pictures(const tinygltf::Model& gltf, const GltfReader& reader, std::vector<std::string>& notes)
        : gltf_(gltf), reader_(reader), notes_(notes)
    {
    }

    /// The picture of a texture in OpenCV's channel order; empty when missing, unsupported or not using
    /// `uv_set`, the base colour's set: a vertex stores only one set of texture coordinates.
    cv::Mat of_texture(int texture, int texture_uv_set, int uv_set, const std::string& field);

  private:
    cv::Mat decode(int image);

    const tinygltf::Model& gltf_;
    const GltfReader& reader_;
    std::vector<std::string>& notes_;
    std::map<int, cv::Mat> decoded_;
};

cv::Mat Pictures::of_texture(int texture, int texture_uv_set, int uv_set, const std::string& field)
{
    if (texture < 0)
        return {};
    if (texture_uv_set != uv_set) {
        notes_.push_back(fmt::format("{}: uses another set of texture coordinates, left out", field));
        return {};
    }
    if (static_cast<std::size_t>(texture) >= gltf_.textures.size())
        reader_.refuse(field, fmt::format("there is no texture {}", texture));
    const int image = gltf_.textures[texture].source;
    if (image < 0) { // a format of an extension, such as Basis
        notes_.push_back(fmt::format("{}: its picture has an unsupported format, left out", field));
        return {};
    }
    if (static_cast<std::size_t>(image) >= gltf_.images.size())
        reader_.refuse(fmt::format("/textures/{}/source", texture),
                       fmt::format("there is no image {}", image));
    const auto found = decoded_.find(image);
    return found != decoded_.end() ? found->second : decoded_.emplace(image, decode(image)).first->second;
}

cv::Mat Pictures::decode(int image)
{
    const tinygltf::Image& source = gltf_.images[image];
    const std::string field = fmt::format("/images/{}", image);
    const std::span<const std::uint8_t> bytes = source.bufferView >= 0
                                                    ? reader_.view(source.bufferView, field + "/bufferView")
                                                    : std::span(source.image);
    if (bytes.empty())
        reader_.refuse(field, fmt::format("picture \"{}\" is missing", source.uri),
                       "put it beside the model, or use a .glb");
    return base::decode_picture(bytes, base::Channels::AsStored, reader_.where(field));
}

/// Converts OpenCV's channel order and any number of channels to the format of a Material.
cv::Mat convert(const cv::Mat& picture, cv::ColorConversionCodes from_gray, cv::ColorConversionCodes from_bgr,
                cv::ColorConversionCodes from_bgra)
{
    cv::Mat converted;
    if (!picture.empty())
        cv::cvtColor(picture, converted,
                     picture.channels() == 1   ? from_gray
                     : picture.channels() == 3 ? from_bgr
                                               : from_bgra);
    return converted;
}

float unit(double value, float otherwise)
{
    return std::isfinite(value) ? std::clamp(static_cast<float>(value), 0.0f, 1.0f) : otherwise;
}

Material convert_material(const tinygltf::Material& source, const std::string& field, Pictures& pictures)
{
    const auto& pbr = source.pbrMetallicRoughness;
    const int uv_set = pbr.baseColorTexture.texCoord;
    const auto picture = [&](const auto& info, const char* name) {
        return pictures.of_texture(info.index, info.texCoord, uv_set, field + name);
    };
    Material material;
    material.name = source.name;
    material.base_color = convert(picture(pbr.baseColorTexture, "/pbrMetallicRoughness/baseColorTexture"),
                                  cv::COLOR_GRAY2RGBA, cv::COLOR_BGR2RGBA, cv::COLOR_BGRA2RGBA);
    material.normal = convert(picture(source.normalTexture, "/normalTexture"), cv::COLOR_GRAY2RGB,
                              cv::COLOR_BGR2RGB, cv::COLOR_BGRA2RGB);
    const cv::Mat occlusion = picture(source.occlusionTexture, "/occlusionTexture");
    if (!occlusion.empty()) {
        cv::extractChannel(occlusion, material.occlusion, occlusion.channels() == 1 ? 0 : 2); // red
        const float strength = unit(source.occlusionTexture.strength, 1.0f);
        if (strength < 1.0f)
            material.occlusion.convertTo(material.occlusion, CV_8U, strength, 255.0 * (1.0 - strength));
    }
    for (int c = 0; c < 4 && pbr.baseColorFactor.size() == 4; ++c)
        material.base_color_factor[c] = unit(pbr.baseColorFactor[c], 1.0f);
    const double scale = source.normalTexture.scale;
    material.normal_scale =
        std::isfinite(scale) ? std::clamp(static_cast<float>(scale), -16.0f, 16.0f) : 1.0f;
    material.roughness = unit(pbr.roughnessFactor, 1.0f);
    material.alpha = source.alphaMode == "MASK"    ? AlphaMode::Mask
                     : source.alphaMode == "BLEND" ? AlphaMode::Blend
                                                   : AlphaMode::Opaque;
    material.alpha_cutoff = unit(source.alphaCutoff, 0.5f);
    material.double_sided = source.doubleSided;
    return material;
}

} // namespace

std::vector<Material> gather_materials(const tinygltf::Model& gltf, const GltfReader& reader,
                                       const std::vector<std::uint32_t>& wanted,
                                       std::vector<std::string>& notes)
{
    Pictures pictures(gltf, reader, notes);
    std::vector<Material> materials;
    for (std::uint32_t m : wanted) {
        if (m < gltf.materials.size())
            materials.push_back(
                convert_material(gltf.materials[m], fmt::format("/materials/{}", m), pictures));
        else
            materials.emplace_back().name = "default";
    }
    return materials;
}

} // namespace head
