#include <cstring>
#include <fstream>
#include <opencv2/imgproc.hpp>
#include <tiny_gltf.h>

#include "base/file.hpp"
#include "base/image_codec.hpp"
#include "base/input_error.hpp"
#include "head/model.hpp"

namespace head {
namespace {

// JPEG of a large opaque colour picture takes a sixth of the space and a quarter of the reading time of PNG.
constexpr std::size_t lossless_limit = 1u << 20; // px
constexpr int jpeg_quality = 95;

/// Builds a glTF document with one buffer.
class Writer
{
  public:
    explicit Writer(const Model& model) : model_(model) { gltf_.buffers.emplace_back(); }
    tinygltf::Model document();

  private:
    int add_view(const void* bytes, std::size_t size, int target);
    int add_accessor(const void* values, std::size_t count, std::size_t element_size, int component_type,
                     int type, int target);
    template <typename T>
    int add_attribute(T Vertex::*member, int type);
    int add_texture(const cv::Mat& picture_in_opencv_order, bool may_be_jpeg = false);
    void add_material(const Material& material);

    const Model& model_;
    tinygltf::Model gltf_;
};

int Writer::add_view(const void* bytes, std::size_t size, int target)
{
    auto& data = gltf_.buffers[0].data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = size;
    view.target = target;
    const auto* first = static_cast<const unsigned char*>(bytes);
    data.insert(data.end(), first, first + size);
    data.resize((data.size() + 3) / 4 * 4); // accessors must start at multiples of four bytes
    gltf_.bufferViews.push_back(view);
    return static_cast<int>(gltf_.bufferViews.size() - 1);
}

int Writer::add_accessor(const void* values, std::size_t count, std::size_t element_size, int component_type,
                         int type, int target)
{
    tinygltf::Accessor accessor;
    accessor.bufferView = add_view(values, count * element_size, target);
    accessor.componentType = component_type;
    accessor.count = count;
    accessor.type = type;
    gltf_.accessors.push_back(accessor);
    return static_cast<int>(gltf_.accessors.size() - 1);
}

template <typename T>
int Writer::add_attribute(T Vertex::*member, int type)
{
    std::vector<T> values;
    values.reserve(model_.vertices.size());
    for (const Vertex& vertex : model_.vertices)
        values.push_back(vertex.*member);
    return add_accessor(values.data(), values.size(), sizeof(T), TINYGLTF_COMPONENT_TYPE_FLOAT, type,
                        TINYGLTF_TARGET_ARRAY_BUFFER);
}

int Writer::add_texture(const cv::Mat& picture, bool may_be_jpeg)
{
    if (picture.empty())
        return -1;
    const bool jpeg = may_be_jpeg && picture.total() > lossless_limit;
    const auto bytes = jpeg ? base::encode_jpeg(picture, jpeg_quality) : base::encode_png(picture);
    tinygltf::Image image;
    image.bufferView = add_view(bytes.data(), bytes.size(), 0);
    image.mimeType = jpeg ? "image/jpeg" : "image/png";
    gltf_.images.push_back(image);
    tinygltf::Texture texture;
    texture.source = static_cast<int>(gltf_.images.size() - 1);
    gltf_.textures.push_back(texture);
    return static_cast<int>(gltf_.textures.size() - 1);
}

void Writer::add_material(const Material& material)
{
    tinygltf::Material out;
    out.name = material.name;
    cv::Mat picture;
    if (!material.base_color.empty()) {
        const bool opaque = material.alpha == AlphaMode::Opaque; // the alpha channel is then unused
        cv::cvtColor(material.base_color, picture, opaque ? cv::COLOR_RGBA2BGR : cv::COLOR_RGBA2BGRA);
        out.pbrMetallicRoughness.baseColorTexture.index = add_texture(picture, opaque);
    }
    if (!material.normal.empty()) {
        cv::cvtColor(material.normal, picture, cv::COLOR_RGB2BGR);
        out.normalTexture.index = add_texture(picture);
        out.normalTexture.scale = material.normal_scale;
    }
    out.occlusionTexture.index = add_texture(material.occlusion);
    const glm::vec4 factor = material.base_color_factor;
    out.pbrMetallicRoughness.baseColorFactor = {factor.r, factor.g, factor.b, factor.a};
    out.pbrMetallicRoughness.metallicFactor = 0;
    out.pbrMetallicRoughness.roughnessFactor = material.roughness;
    out.alphaMode = material.alpha == AlphaMode::Mask    ? "MASK"
                    : material.alpha == AlphaMode::Blend ? "BLEND"
                                                         : "OPAQUE";
    out.alphaCutoff = material.alpha_cutoff;
    out.doubleSided = material.double_sided;
    gltf_.materials.push_back(out);
}

tinygltf::Model Writer::document()
{
    const std::map<std::string, int> attributes = {
        {"POSITION", add_attribute(&Vertex::position, TINYGLTF_TYPE_VEC3)},
        {"NORMAL", add_attribute(&Vertex::normal, TINYGLTF_TYPE_VEC3)},
        {"TANGENT", add_attribute(&Vertex::tangent, TINYGLTF_TYPE_VEC4)},
        {"TEXCOORD_0", add_attribute(&Vertex::uv, TINYGLTF_TYPE_VEC2)},
    };
    auto& positions =
        gltf_.accessors[attributes.at("POSITION")]; // the standard requires min and max of positions
    positions.minValues = {model_.min.x, model_.min.y, model_.min.z};
    positions.maxValues = {model_.max.x, model_.max.y, model_.max.z};

    tinygltf::Mesh mesh;
    mesh.name = "head";
    for (const Primitive& primitive : model_.primitives) {
        tinygltf::Primitive out;
        out.attributes = attributes;
        out.indices = add_accessor(model_.indices.data() + primitive.first_index, primitive.index_count,
                                   sizeof(std::uint32_t), TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                   TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
        out.material = static_cast<int>(primitive.material);
        out.mode = TINYGLTF_MODE_TRIANGLES;
        mesh.primitives.push_back(out);
    }
    gltf_.meshes.push_back(mesh);
    for (const Material& material : model_.materials)
        add_material(material);
    tinygltf::Node node;
    node.mesh = 0;
    gltf_.nodes.push_back(node);
    gltf_.scenes.emplace_back().nodes = {0};
    gltf_.defaultScene = 0;
    gltf_.asset.version = "2.0";
    gltf_.asset.generator = "cicatrix";
    return std::move(gltf_);
}

} // namespace

void save_model(const std::filesystem::path& path, const Model& model)
{
    tinygltf::Model document = Writer(model).document();
    base::write_atomically(path, [&](const std::filesystem::path& temporary) {
        std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
        const bool written = tinygltf::TinyGLTF().WriteGltfSceneToStream(&document, stream, false, true);
        stream.close();
        if (!written || !stream)
            throw base::InputError(path.string(), "cannot be written",
                                   "choose a writable folder with free space");
    });
}

} // namespace head
