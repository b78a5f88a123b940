#include "tools/head/bake_head.hpp"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <map>
#include <opencv2/imgproc.hpp>

#include "base/file.hpp"
#include "base/image_codec.hpp"
#include "base/image_io.hpp"
#include "head/model.hpp"
#include "head/occlusion.hpp"
#include "head/raw_mesh.hpp"
#include "tools/head/bake_atlas.hpp"
#include "tools/head/bake_bust.hpp"
#include "tools/head/bake_skin.hpp"
#include "tools/head/bake_texture.hpp"
#include "tools/head/makehuman.hpp"

namespace head_tool {
namespace {

/// The face: a man of about forty, slightly asymmetric.
constexpr MorphWeight face_morphs[] = {
    {"caucasian-male-young", 0.75},
    {"caucasian-male-old", 0.25},
    {"universal-male-young-averagemuscle-averageweight", 0.7},
    {"head-oval", 0.25},
    {"nose-scale-vert-decr", 0.3},
    {"nose-hump-morehump", 0.25},
    {"nose-trans-horiz-in", 0.12},
    {"mouth-scale-horiz-decr", 0.25},
    {"mouth-upperlip-height-max", 0.35},
    {"mouth-lowerlip-height-max", 0.1},
    {"mouth-laugh-lines-in", 0.25},
    {"l-eye-height2-min", 0.25},
    {"l-eye-bag-out", 0.3},
    {"r-eye-bag-out", 0.4},
    {"r-eye-corner1-up", 0.15},
    {"l-cheek-volume-inflate", 0.15},
    {"r-cheek-bones-out", 0.15},
    {"r-ear-trans-vert-up", 0.2},
    {"l-ear-wing-in", 0.3},
    {"r-ear-wing-in", 0.2},
};

enum Part : std::uint32_t
{
    Skin,
    Mouth,
    Eye,
    Eyebrow,
    Eyelash,
    PartCount
};

/// Collects parts into one mesh, in metres relative to `origin`.
class Assembly
{
  public:
    explicit Assembly(glm::dvec3 origin) : origin_(origin) {}

    void begin(Part part)
    {
        mesh_.primitives.push_back({static_cast<std::uint32_t>(mesh_.indices.size()), 0, part});
    }
    void add(const CutMesh& mesh, const std::vector<CutMesh::Triangle>& triangles, const Placement& placement)
    {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> numbers;
        for (const CutMesh::Triangle& triangle : triangles)
            for (const auto& [vertex, uv] : triangle) {
                const auto [found, is_new] =
                    numbers.try_emplace({vertex, uv}, static_cast<std::uint32_t>(mesh_.vertices.size()));
                if (is_new) {
                    head::Vertex added{};
                    added.position = glm::vec3(0.1 * (mesh.positions[vertex] - origin_)); // dm -> m
                    added.uv = glm::vec2(placement(mesh.uvs[uv]));
                    mesh_.vertices.push_back(added);
                    mesh_.known.push_back(head::RawMesh::Uv);
                }
                mesh_.indices.push_back(found->second);
            }
        head::Primitive& primitive = mesh_.primitives.back();
        primitive.index_count = static_cast<std::uint32_t>(mesh_.indices.size()) - primitive.first_index;
    }
    head::RawMesh take() { return std::move(mesh_); }

  private:
    glm::dvec3 origin_; // dm
    head::RawMesh mesh_;
};

/// Centre of the eyes' bounding box, with x = 0; dm.
glm::dvec3 between(const CutMesh& eyes)
{
    glm::dvec3 low(1e9), high(-1e9);
    for (const CutMesh::Triangle& triangle : eyes.head)
        for (const CutMesh::Corner& corner : triangle) {
            low = glm::min(low, eyes.positions[corner.vertex]);
            high = glm::max(high, eyes.positions[corner.vertex]);
        }
    return {0, 0.5 * (low.y + high.y), 0.5 * (low.z + high.z)};
}

head::RawMesh assemble(const MakeHuman& figure, const CutMesh& bust, const SkinAtlas& atlas)
{
    CutMesh eyes = as_triangles(figure.fitted("eyes/HighPolyEyes/HighPolyEyes.json"));
    // Drops the cornea, a separate shell with texture coordinates in a transparent corner of the picture.
    std::erase_if(eyes.head, [&](const CutMesh::Triangle& t) {
        return eyes.uvs[t[0].uv].x > 0.87 && eyes.uvs[t[0].uv].y < 0.13;
    });
    const CutMesh brows = as_triangles(figure.fitted("eyebrows/eyebrow001/eyebrow001.json"));
    const CutMesh lashes = as_triangles(figure.fitted("eyelashes/Eyelashes01/Eyelashes01.json"));

    Assembly assembly(between(eyes));
    assembly.begin(Skin);
    assembly.add(bust, bust.head, atlas.head);
    assembly.add(bust, bust.torso, atlas.bust);
    assembly.begin(Mouth);
    assembly.add(bust, bust.inner, as_painted);
    assembly.begin(Eye);
    assembly.add(eyes, eyes.head, as_painted);
    assembly.begin(Eyebrow);
    assembly.add(brows, brows.head, as_painted);
    assembly.begin(Eyelash);
    assembly.add(lashes, lashes.head, as_painted);
    head::RawMesh mesh = assembly.take();
    head::drop_degenerate(mesh);
    head::complete_normals(mesh);
    head::complete_tangents(mesh);
    return mesh;
}

std::span<const std::uint32_t> indices_of(const head::RawMesh& mesh, const head::Primitive& primitive)
{
    return std::span(mesh.indices).subspan(primitive.first_index, primitive.index_count);
}

/// Ambient occlusion by vertex, 0..1, as grey. Brows and lashes are too thin to occlude.
std::vector<glm::vec3> occlusion_of(const head::RawMesh& mesh)
{
    constexpr int rays = 128;
    std::vector<glm::vec3> positions, normals;
    for (const head::Vertex& vertex : mesh.vertices) {
        positions.push_back(vertex.position);
        normals.push_back(vertex.normal);
    }
    std::vector<std::uint32_t> solid;
    for (const head::Primitive& primitive : mesh.primitives)
        if (primitive.material <= Eye) {
            const auto indices = indices_of(mesh, primitive);
            solid.insert(solid.end(), indices.begin(), indices.end());
        }
    const auto open = head::ambient_occlusion(head::Bvh(positions, solid), positions, normals, rays,
                                              head::occlusion_reach);
    return {open.begin(), open.end()};
}

/// A primitive's vertex values as a picture in its texture space, with gaps filled.
cv::Mat3f texture_of(const head::RawMesh& mesh, const head::Primitive& primitive,
                     std::span<const glm::vec3> values, int size)
{
    std::vector<glm::vec2> uvs;
    for (const head::Vertex& vertex : mesh.vertices)
        uvs.push_back(vertex.uv);
    cv::Mat1b covered;
    cv::Mat3f texture = rasterise(uvs, indices_of(mesh, primitive), values, cv::Size(size, size), covered);
    fill_uncovered(texture, covered);
    return texture;
}

SkinPlaces places_on(const head::RawMesh& mesh, int size)
{
    std::vector<glm::vec3> millimetres;
    for (const head::Vertex& vertex : mesh.vertices)
        millimetres.push_back(1000.0f * vertex.position);
    SkinPlaces places;
    places.position = texture_of(mesh, mesh.primitives[Skin], millimetres, size);
    places.nose_tip =
        *std::max_element(millimetres.begin(), millimetres.end(), [](auto a, auto b) { return a.z < b.z; });
    places.mouth = places.nose_tip + glm::vec3(0, -33, -14);
    return places;
}

/// The last PNG in a file that may contain several (a Blender scene with packed pictures), or the file itself
/// as a picture.
cv::Mat3b read_skin(const std::filesystem::path& file)
{
    constexpr std::size_t max_file = 256u << 20;
    const auto bytes = base::read_file(file, max_file);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::size_t png = text.rfind("\x89PNG\r\n\x1a\n");
    const auto picture = std::span(bytes).subspan(png == std::string_view::npos ? 0 : png);
    cv::Mat3b rgb;
    cv::cvtColor(base::decode_picture(picture, base::Channels::Opaque, file.string()), rgb, cv::COLOR_BGR2RGB);
    return rgb;
}

cv::Mat4b read_rgba(const std::filesystem::path& file)
{
    constexpr std::size_t max_file = 16u << 20;
    const cv::Mat picture =
        base::decode_picture(base::read_file(file, max_file), base::Channels::AsStored, file.string());
    cv::Mat4b rgba;
    cv::cvtColor(picture, rgba, picture.channels() == 4 ? cv::COLOR_BGRA2RGBA : cv::COLOR_BGR2RGBA);
    return rgba;
}

/// Materials in the order of Part, without the skin's pictures and without occlusion.
std::vector<head::Material> materials_from(const MakeHuman& figure)
{
    std::vector<head::Material> materials(PartCount);
    materials[Skin].name = "skin";
    materials[Skin].roughness = 0.5f;
    materials[Mouth].name = "mouth";
    materials[Mouth].base_color_factor = {0.30f, 0.07f, 0.06f, 1}; // linear; barely visible
    materials[Mouth].roughness = 0.3f;
    materials[Eye].name = "eye";
    // A mix: the painted dark brown is too red, the light brown too yellow.
    const cv::Mat4b dark = read_rgba(figure.picture("proxies/eyes/HighPolyEyes/textures/brown_eye.png"));
    const cv::Mat4b light =
        read_rgba(figure.picture("proxies/eyes/HighPolyEyes/textures/brownlight_eye.png"));
    cv::addWeighted(dark, 0.6, light, 0.4, 0, materials[Eye].base_color);
    materials[Eye].base_color_factor = {0.66f, 0.58f, 0.50f, 1}; // darkens the painted whites
    materials[Eye].roughness = 0.1f;
    materials[Eyebrow].name = "eyebrow";
    materials[Eyebrow].base_color =
        read_rgba(figure.picture("proxies/eyebrows/eyebrow001/textures/eyebrow001.png"));
    materials[Eyelash].name = "eyelash";
    materials[Eyelash].base_color =
        read_rgba(figure.picture("proxies/eyelashes/Eyelashes01/textures/eyelashes01.png"));
    for (Part hair : {Eyebrow, Eyelash}) {
        materials[hair].alpha = head::AlphaMode::Blend;
        materials[hair].double_sided = true;
    }
    return materials;
}

} // namespace

void bake_head(const HeadSources& sources, const std::filesystem::path& output_glb,
               const std::function<void(std::string_view)>& progress)
{
    constexpr int skin_size = 2048, skin_occlusion_size = 1024, part_occlusion_size = 256; // px
    progress("shaping the head");
    MakeHuman figure(sources.makehuman);
    figure.morph(face_morphs);
    const CutMesh bust = cut_bust(figure.body());
    const SkinAtlas atlas = lay_out_skin(bust, skin_size);
    head::RawMesh mesh = assemble(figure, bust, atlas);
    head::Model model;
    model.materials = materials_from(figure);

    progress("computing ambient occlusion");
    const std::vector<glm::vec3> open = occlusion_of(mesh);
    for (const head::Primitive& primitive : mesh.primitives) {
        if (primitive.material > Eye)
            continue;
        cv::Mat1f gray;
        cv::extractChannel(texture_of(mesh, primitive, open,
                                      primitive.material == Skin ? skin_occlusion_size : part_occlusion_size),
                           gray, 0);
        gray.convertTo(model.materials[primitive.material].occlusion, CV_8U, 255);
    }

    progress("painting the skin");
    const auto own_skin =
        figure.picture("skins/young_caucasian_male/textures/young_lightskinned_male_diffuse.png");
    const cv::Mat3b painted = paint_skin(atlas, read_skin(sources.skin.empty() ? own_skin : sources.skin));
    SkinPictures skin = detail_skin(painted, places_on(mesh, skin_size));
    model.materials[Skin].base_color = std::move(skin.color);
    model.materials[Skin].normal = std::move(skin.normal);

    model.vertices = std::move(mesh.vertices);
    model.indices = std::move(mesh.indices);
    model.primitives = std::move(mesh.primitives);
    head::update_bounds(model);
    head::save_model(output_glb, model);
}

} // namespace head_tool
