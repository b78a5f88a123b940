#include "stage/stage.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "base/input_error.hpp"
#include "passes/screen_diffusion.hpp"
#include "passes/split.hpp"
#include "wound/optics/tissue_choice.hpp"
#include "wound/reflectance_table.hpp"

namespace stage {
namespace {

/// Number of cached days: enough for a report's alternating cases and for two stages side by side.
constexpr std::size_t most_known_days = 4;

/// Whether both scenes have the same wounds on every day.
bool same_wounds(const scene::LoadedScene& a, const scene::LoadedScene& b)
{
    return std::ranges::equal(a.wounds, b.wounds, [](const auto& one, const auto& other) {
        return one.photograph == other.photograph && one.part == other.part && one.healing == other.healing;
    });
}

passes::WoundReach reach_of(const scene::PlacedWound& wound)
{
    passes::WoundReach reach{wound.anchor};
    if (const cv::Rect& region = wound.region; !region.empty()) {
        const cv::Size size = wound.prepared().patch.color.size();
        reach.low = {2. * region.x / size.width - 1, 2. * region.y / size.height - 1};
        reach.high = {2. * region.br().x / size.width - 1, 2. * region.br().y / size.height - 1};
    }
    return reach;
}

} // namespace

Stage::Preparation Stage::prepare(const scene::Scene& scene)
{
    Preparation preparation{scene, std::make_shared<scene::WoundLoader>(), nullptr};
    preparation.head = begin_loading(*preparation.loader, scene);
    return preparation;
}

Stage::Stage(const gpu::Device& device, const Preparation& preparation)
    : device_(&device), loader_(preparation.loader), seen_news_(preparation.loader->news())
{
    set_.loaded.head = preparation.head; // make() uploads it while workers still fit the wounds to it
    accept(make(preparation.scene));
    wait_until_complete();
}

void Stage::update(const scene::Scene& scene, bool dragging)
{
    const bool before = std::exchange(dragging_, dragging);
    try {
        accept(make(scene));
    } catch (...) {
        dragging_ = before;
        throw;
    }
}

void Stage::accept(Set set)
{
    if (!same_wounds(set.loaded, set_.loaded))
        known_days_.clear();
    if (set.loaded.scene.tissue != set_.loaded.scene.tissue)
        tissue_spread_.reset();
    set_ = std::move(set);
    if (set_.loaded.complete)
        whole_ = set_;
}

bool Stage::poll()
{
    loader_->collect();
    if (seen_news_ == loader_->news())
        return false;
    seen_news_ = loader_->news();
    if (set_.loaded.complete)
        return false; // the news concern another stage
    try {
        accept(make(set_.loaded.scene));
    } catch (const base::InputError&) {
        if (whole_.bare) // null until the first scene is complete
            accept(whole_);
        throw;
    }
    return true;
}

void Stage::wait_until_complete()
{
    if (dragging_)
        update(scene::Scene(scene()));
    while (pending()) {
        loader_->wait();
        poll();
    }
}

void Stage::prefetch(const scene::Scene& scene) const
{
    try {
        const auto head = loader_->head(scene.head, set_.loaded.head);
        for (std::size_t i = 0; i < scene.wounds.size(); ++i)
            if (head)
                loader_->fitted(wanted(scene.wounds, i), head);
            else
                loader_->begin(wanted(scene.wounds, i));
    } catch (const base::InputError&) {
        return; // update() tries again and reports the error
    }
}

Stage::Set Stage::make(const scene::Scene& scene) const
{
    Set set;
    set.loaded = assemble(scene, *loader_, set_.loaded, dragging_);
    const head::Model& model = *set.loaded.head->model;
    set.bare = set_.bare && set.loaded.head == set_.loaded.head
                   ? set_.bare
                   : std::make_shared<const passes::Head>(passes::upload_head(*device_, model));
    for (const scene::PlacedWound& wound : set.loaded.wounds)
        set.reaches.push_back(reach_of(wound));
    set.wounded = set.bare == set_.bare && set_.wounded && set.reaches == set_.reaches
                      ? set_.wounded
                      : std::make_shared<const passes::Head>(
                            passes::with_wounds(*device_, *set.bare, model, set.reaches));
    for (const scene::PlacedWound& wound : set.loaded.wounds)
        set.wounds.push_back({maps_of(wound), lut_of(set, wound)});
    if (set.wounded->crowded > 0)
        set.loaded.notes.push_back(fmt::format(
            "scene: /wounds: more than {0} wounds reach the same skin; there the {0} nearest ones are drawn",
            shared::WOUNDS_HERE));
    if (scene.shading.on_atlas() && passes::kept_materials(model).empty())
        set.loaded.notes.push_back(
            fmt::format("scene: /head: it has no skin that is opaque and seen from one side: light does not "
                        "spread over it "
                        "(shading.transport is drawn as {})",
                        scene.shading.transport == optics::Transport::Diffused ? "preintegrated" : "burley"));
    return set;
}

passes::WoundMaps Stage::maps_of(const scene::PlacedWound& wound) const
{
    std::erase_if(*uploaded_, [](const UploadedMaps& maps) { return maps.photograph.expired(); });
    auto known = std::ranges::find_if(
        *uploaded_, [&](const UploadedMaps& maps) { return maps.photograph.lock() == wound.photograph; });
    if (known == uploaded_->end()) {
        UploadedMaps made{wound.photograph, {}};
        for (const scene::FittedWound& fitted : wound.photograph->wounds)
            made.maps.push_back(passes::upload_wound(*device_, fitted.prepared.patch));
        known = uploaded_->insert(uploaded_->end(), std::move(made));
    }
    passes::WoundMaps maps = known->maps[wound.part];
    if (!wound.region.empty())
        maps.region = wound.region; // by default the whole patch
    return maps;
}

/// Reuses the table of another wound or of the previous set if tissue, model and healing are the same.
Stage::SharedTissue Stage::lut_of(const Set& set, const scene::PlacedWound& wound) const
{
    for (std::size_t i = 0; i < set.wounds.size(); ++i)
        if (set.loaded.same_tissue(set.loaded.wounds[i], wound))
            return set.wounds[i].tissue;
    const scene::Scene &now = set.loaded.scene, &before = set_.loaded.scene;
    if (!set_.wounds.empty() && now.tissue == before.tissue &&
        now.reflectance_model == before.reflectance_model && scene::last_day(now) == scene::last_day(before))
        for (std::size_t i = 0; i < set_.wounds.size(); ++i)
            if (set.loaded.same_tissue(set_.loaded.wounds[i], wound))
                return set_.wounds[i].tissue;
    return make_lut(set, wound);
}

Stage::SharedTissue Stage::make_lut(const Set& set, const scene::PlacedWound& wound) const
{
    const scene::Scene& scene = set.loaded.scene;
    const wound::LutRows rows =
        wound::lut_rows(set.loaded.tissue_at(wound), wound.healing, wound::lut_size, scene::last_day(scene));
    passes::LutTissue tissue = passes::lut_tissue(rows.days, scene::last_day(scene));
    if (scene.reflectance_model > optics::ReflectanceModel::Calibrated) // not implemented by the shader
        tissue.table = std::make_shared<gpu::Texture>(passes::upload_reflectance_table(
            *device_,
            wound::kept_table(rows, wound::lut_size, scene.reflectance_model, wound::picture_table_options),
            "reflectance table"));
    return std::make_shared<const passes::LutTissue>(std::move(tissue));
}

void Stage::set_tissue(const optics::HealingTissue& tissue)
{
    set_.loaded.tissue = tissue;
    tissue_spread_.reset();
    const std::vector<scene::PlacedWound>& placed = set_.loaded.wounds;
    for (std::size_t i = 0; i < placed.size(); ++i) {
        std::size_t first = 0;
        while (!set_.loaded.same_tissue(placed[first], placed[i]))
            ++first;
        set_.wounds[i].tissue = first < i ? set_.wounds[first].tissue : make_lut(set_, placed[i]);
    }
}

const passes::Skin* Stage::skin() const
{
    const head::Model& model = *set_.loaded.head->model;
    if (spread_.bare != set_.bare) {
        spread_ = {set_.bare, nullptr, head::unwrap(model, passes::kept_materials(model)), {}, nullptr};
        spread_.surface = head::surface_of(model, spread_.base.atlas.materials, true);
    }
    if (spread_.wounded != set_.wounded) {
        const head::Atlas atlas = head::with_wounds(model, spread_.base, set_.loaded.anchors());
        spread_.skin = passes::upload_skin(*device_, model, atlas, spread_.surface, set_.reaches);
        spread_.wounded = set_.wounded;
    }
    return spread_.skin.get();
}

std::optional<double> Stage::light_scale(const head::Camera& camera, std::uint32_t height) const
{
    const passes::Skin* spread = skin();
    return spread ? passes::atlas_scale(*spread, passes::pixel_m(set_.wounded->boxes, camera, height))
                  : std::nullopt;
}

std::uint32_t Stage::apron(const head::Camera& camera, std::uint32_t height) const
{
    const optics::Shading& shading = set_.loaded.scene.shading;
    if (!shading.in_picture())
        return 0;
    return passes::screen_diffusion(camera, std::array{height, height}, *set_.wounded, tissue_spread(shading),
                                    shading.transport)
        .reach;
}

optics::TissueSpread Stage::tissue_spread(const optics::Shading& shading) const
{
    if (!shading.spreads())
        return {};
    if (!tissue_spread_)
        tissue_spread_ = optics::tissue_spread(optics::layers_of(set_.loaded.tissue));
    return *tissue_spread_;
}

Stage::KnownDay Stage::known_day(double day) const
{
    const auto known = std::ranges::find(known_days_, day, &KnownDay::day);
    KnownDay found{day, nullptr, nullptr};
    if (known != known_days_.end()) {
        found = *known;
        known_days_.erase(known);
    } else {
        std::vector<wound::WoundDay> wounds = set_.loaded.wounds_on(day);
        std::vector<passes::PackedWarps> warps;
        for (const wound::WoundDay& today : wounds)
            warps.push_back(passes::pack_warps(today));
        found.wounds = std::make_shared<const std::vector<wound::WoundDay>>(std::move(wounds));
        found.warps = std::make_shared<const std::vector<passes::PackedWarps>>(std::move(warps));
    }
    known_days_.push_front(found);
    if (known_days_.size() > most_known_days)
        known_days_.pop_back();
    return found;
}

shared::View Stage::view(const head::Camera& camera, const passes::ViewportTile& tile) const
{
    return passes::make_view(camera, *set_.wounded, tile);
}

Frame Stage::declare(graph::Graph& graph, const FrameRequest& request) const
{
    const scene::Scene& scene = set_.loaded.scene;
    const optics::Shading shading = request.shading.value_or(scene.shading);
    const KnownDay today = known_day(request.day);
    Frame frame{{}, today.wounds};
    std::vector<passes::FrameWound> wounds;
    for (std::size_t i = 0; i < set_.wounds.size(); ++i) {
        const DeviceWound& wound = set_.wounds[i];
        wounds.push_back(
            {set_.loaded.wounds[i].anchor, wound.maps, *wound.tissue, (*today.wounds)[i], (*today.warps)[i]});
        graph.keep(wound.maps.color);
        graph.keep(wound.maps.shape);
    }
    graph.keep(set_.wounded);
    const bool received =
        shading.on_atlas() && (request.lights_rest || shading.transport != optics::Transport::Diffused);
    const passes::Skin* spread = request.light_scale || received ? skin() : nullptr;
    if (spread)
        graph.keep(spread_.skin);
    const optics::TissueSpread tissue = tissue_spread(shading);
    const head::Camera camera = request.camera.value_or(set_.loaded.camera());
    std::optional<double> diffusion_scale;
    if (spread && received) {
        // The scene's camera decides for all that are not much nearer: light stands while a camera moves.
        const auto pixel_of = [&](const head::Camera& viewer) {
            return std::max(passes::pixel_m(set_.wounded->boxes, viewer, request.tile.picture[1]), 1e-6);
        };
        double pixel_m = request.light_scale ? spread->texel_m / (2 * *request.light_scale)
                                             : pixel_of(set_.loaded.camera());
        const double nearer_m = request.light_scale ? pixel_m : pixel_of(camera);
        while (nearer_m < pixel_m / 2)
            pixel_m /= 2;
        diffusion_scale = passes::diffusion_scale(*spread, tissue.scattering_length_mm, pixel_m);
    }
    frame.images = passes::add_frame(graph, {.head = *set_.wounded,
                                             .wounds = wounds,
                                             .lights = set_.loaded.lights,
                                             .camera = camera,
                                             .shading = shading,
                                             .reflectance = scene.reflectance_model,
                                             .tile = request.tile,
                                             .samples = scene.samples,
                                             .exposure_stops = float(scene.exposure_stops),
                                             .every_frame = request.every_frame,
                                             .tissue = tissue,
                                             .skin = spread,
                                             .kept_scale = request.light_scale,
                                             .diffusion_scale = diffusion_scale,
                                             .radiance = request.radiance});
    return frame;
}

graph::ImageId declare_split(graph::Graph& graph, const Stage& left, const FrameRequest& left_request,
                             const Stage& right, const FrameRequest& right_request, double divider)
{
    const graph::ImageId first = left.declare(graph, left_request).images.picture;
    graph.prefix("right ");
    const graph::ImageId second = right.declare(graph, right_request).images.picture;
    graph.prefix("");
    return passes::add_split(graph, first, second, divider);
}

} // namespace stage
