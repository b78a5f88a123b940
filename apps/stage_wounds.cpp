#include "apps/stage_wounds.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <thread>
#include <utility>

#include "apps/bake_head.hpp"
#include "engine/image_io.hpp"
#include "passes/head.hpp"
#include "passes/skin_under.hpp"
#include "shaders/shared/shading.h"
#include "wound/drawn_region.hpp"
#include "wound/input_error.hpp"
#include "wound/skin_match.hpp"
#include "wound/synthetic.hpp"

namespace app {

struct Workshop::Base
{
    std::vector<wound::WoundPart> parts;
    std::vector<wound::PreparedWound> prepared; // each part's, with the depth of `tissue`
    wound::TissueThickness tissue;
};

namespace {

constexpr std::size_t most_bases = 8, most_fits = 32; // some 6 MB each
constexpr std::size_t most_jobs = 8, most_jobs_of_a_photograph = 2;

/// A path and when the file was last written, so that a file that has changed is read again.
std::string file_key(const std::filesystem::path& file)
{
    std::error_code absent;
    const auto time = std::filesystem::last_write_time(file, absent);
    return fmt::format("{}@{}|", file.string(), absent ? 0 : time.time_since_epoch().count());
}

std::string photograph_key(const WoundScene& wound)
{
    const auto& [seed, rect] = std::pair(wound.segmentation.seed, wound.segmentation.rect);
    return file_key(wound.photo) + file_key(wound.mask) +
           (wound.photo.empty() ? fmt::format("{}|{}|", wound.kind, wound.seed) : "") +
           (seed ? fmt::format("seed {} {}|", seed->x, seed->y) : "") +
           (rect ? fmt::format("rect {} {} {} {}|", rect->x, rect->y, rect->width, rect->height) : "");
}

std::string base_key(const WoundScene& wound)
{
    return photograph_key(wound) + fmt::format("{}|", wound.width_mm);
}

std::string place_key(const passes::Place& place)
{
    if (const auto* name = std::get_if<std::string>(&place))
        return *name;
    if (const auto* face = std::get_if<passes::FacePoint>(&place))
        return fmt::format("{} {}", face->x, face->y);
    const glm::dvec3& point = std::get<glm::dvec3>(place);
    return fmt::format("{} {} {}", point.x, point.y, point.z);
}

std::string fit_key(const WoundScene& wound, const LoadedHead& head)
{
    const wound::Healing& healing = wound.healing;
    return base_key(wound) + place_key(wound.place) +
           fmt::format("|{}|{}|{} {} {} {}|{} {}|", wound.roll_deg, wound.depth_factor, healing.curve.delta,
                       healing.curve.gamma, healing.curve.theta, healing.curve.asymptote, int(healing.model),
                       healing.residual_border) +
           head.key;
}

std::filesystem::path head_file(const std::filesystem::path& file)
{
    return file.empty() ? default_head_path() : file;
}

/// From face coordinates (unit: nose to crown) to those of the tissue map: ears at x = +-1, hairline and chin
/// at y = +-1.
cv::Point2d tissue_coordinates(const passes::FacePoint& face)
{
    return {face.x / 0.55, face.y / (face.y > 0 ? 0.65 : 0.58)};
}

wound::TissueThickness tissue_at(const WoundScene& scene, const passes::FacePoint& face)
{
    const wound::TissueThickness tissue = wound::tissue_thickness(tissue_coordinates(face));
    return {tissue.epidermis * scene.depth_factor, tissue.dermis * scene.depth_factor,
            tissue.subcutis * scene.depth_factor};
}

wound::Photograph read_photograph(const WoundScene& scene)
{
    if (scene.photo.empty()) {
        wound::SyntheticWound synthetic;
        synthetic.shape = scene.kind == "laceration" ? wound::WoundShape::laceration
                          : scene.kind == "avulsion" ? wound::WoundShape::avulsion
                                                     : wound::WoundShape::abrasion;
        synthetic.seed = scene.seed;
        return wound::synthesize(synthetic);
    }
    wound::Photograph photograph{engine::read_rgb(scene.photo), {}, {}};
    if (!scene.mask.empty())
        photograph.mask = engine::read_mask(scene.mask);
    return photograph;
}

std::shared_ptr<const Workshop::Base> make_base(const WoundScene& scene, const std::string& name)
{
    auto base = std::make_shared<Workshop::Base>();
    base->tissue = tissue_at(scene, passes::known_face_point(scene.place).value_or(passes::FacePoint{}));
    wound::Preparation preparation;
    preparation.where = scene.mask.empty() ? name : scene.mask.string();
    preparation.width_mm = scene.width_mm;
    preparation.hints = scene.segmentation;
    preparation.depth.tissue = base->tissue;
    base->parts = wound::separate(read_photograph(scene), preparation);
    check_count(base->parts.size(), base->parts.size(), name);
    preparation.where = name;
    std::vector<std::future<wound::PreparedWound>> prepared;
    for (const wound::WoundPart& part : base->parts) {
        preparation.width_mm = part.width_mm;
        prepared.push_back(
            std::async(std::launch::async, wound::prepare, std::cref(part.photograph), preparation));
    }
    for (std::future<wound::PreparedWound>& part : prepared)
        base->prepared.push_back(part.get());
    return base;
}

FittedWound fit_part(const WoundScene& scene, const Workshop::Base& base, std::size_t part,
                     const passes::Anchor& anchor, const LoadedHead& head)
{
    FittedWound fitted{base.prepared[part], anchor, {}};
    wound::Patch& patch = fitted.prepared.patch;
    if (const wound::TissueThickness tissue = tissue_at(scene, anchor.face); tissue != base.tissue) {
        wound::DepthOptions options;
        options.tissue = tissue;
        patch.depth_mm = wound::depth_map(patch.color, patch.mask, patch.width_mm, options);
    }
    patch = wound::match_to_skin(patch, passes::skin_under(*head.model, head.skin, anchor, patch.color.cols));
    fitted.region = wound::drawn_region(fitted.prepared, scene.healing);
    return fitted;
}

std::shared_ptr<Fit> make_fit(const WoundScene& scene, const Workshop::Base& base, const LoadedHead& head,
                              const std::string& name)
{
    auto fit = std::make_shared<Fit>();
    fit->scene = scene;
    for (const wound::WoundPart& part : base.parts)
        fit->layout.push_back({part.offset_mm, part.width_mm});
    const std::vector<passes::Anchor> anchors = anchors_of(scene, *fit, head, name);
    std::vector<std::future<FittedWound>> others;
    for (std::size_t i = 1; i < anchors.size(); ++i)
        others.push_back(std::async(std::launch::async, fit_part, std::cref(scene), std::cref(base), i,
                                    std::cref(anchors[i]), std::cref(head)));
    fit->wounds.push_back(fit_part(scene, base, 0, anchors[0], head));
    for (std::future<FittedWound>& other : others)
        fit->wounds.push_back(other.get());
    return fit;
}

/// Whether it is done, and done badly.
template <typename T>
bool failed(const std::shared_future<T>& future)
{
    if (future.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return false;
    try {
        future.get();
        return false;
    } catch (...) {
        return true;
    }
}

template <typename T>
bool ready(const std::future<T>& future)
{
    return future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

} // namespace

std::string name_of(const WoundScene& wound, std::size_t index)
{
    return wound.photo.empty() ? fmt::format("wound {}", index + 1) : wound.photo.string();
}

void check_count(std::size_t all, std::size_t components, const std::string& name)
{
    if (all > std::size_t(shared::MAX_WOUNDS))
        throw cicatrix::InputError(
            name,
            fmt::format("{} components of its mask, or wounds found in it, make more than {} in the scene",
                        components, shared::MAX_WOUNDS),
            "leave wounds out of the scene, or components out of the mask; without a mask, give a "
            "rectangle or a seed");
}

std::vector<passes::Anchor> anchors_of(const WoundScene& scene, const Fit& fit, const LoadedHead& head,
                                       const std::string& name)
{
    const double scale = scene.width_mm / fit.scene.width_mm; // of a fit for another width
    std::vector<passes::Anchor> anchors{passes::anchor_wound(*head.model, head.face, scene.place,
                                                             scene.width_mm / wound::kWoundShare,
                                                             scene.roll_deg, name + ": at")};
    for (std::size_t i = 1; i < fit.layout.size(); ++i) {
        const Fit::Part& part = fit.layout[i];
        anchors.push_back(passes::anchor_beside(
            *head.model, head.face, anchors.front(),
            1e-3 * scale * glm::dvec2(part.offset_mm.x, part.offset_mm.y),
            scale * part.width_mm / wound::kWoundShare,
            fmt::format("{}: component {} of the mask, or of what was found without one", name, i + 1)));
    }
    return anchors;
}

std::shared_ptr<const LoadedHead> load_head(const std::filesystem::path& chosen)
{
    const std::filesystem::path file = head_file(chosen);
    if (chosen.empty() && !std::filesystem::exists(file))
        throw cicatrix::InputError(
            file.string(), "the default head has not been made yet",
            "make it once with cicatrix-fetch-head (from a checkout: ./run setup), or give one of your own "
            "with --head FILE.glb");
    auto head = std::make_shared<LoadedHead>();
    head->key = file_key(file);
    auto model = std::make_shared<engine::Model>(engine::load_model(file));
    engine::normalise_size(*model);
    for (const std::string& note : model->notes)
        head->notes.push_back(fmt::format("{}: {}", file.string(), note));
    head->face = passes::find_face(*model);
    head->skin = passes::skin_material(*model);
    head->model = std::move(model);
    return head;
}

std::shared_ptr<const LoadedHead> Workshop::head(const std::filesystem::path& file,
                                                 const std::shared_ptr<const LoadedHead>& current)
{
    const std::string key = file_key(head_file(file));
    if (current && current->key == key)
        return current;
    if (head_ && head_->key == key)
        return head_;
    if (head_failed_ && head_job_key_ == key)
        std::rethrow_exception(std::exchange(head_failed_, nullptr));
    if (!head_job_.valid()) {
        head_failed_ = nullptr; // another's
        head_job_key_ = key;
        head_job_ = std::async(std::launch::async, load_head, file);
    }
    return nullptr;
}

Workshop::SharedBase Workshop::base(const WoundScene& wound, const std::string& name)
{
    const std::string key = base_key(wound);
    const auto found = std::ranges::find(bases_, key, &std::pair<std::string, SharedBase>::first);
    if (found != bases_.end())
        bases_.splice(bases_.begin(), bases_, found);
    else
        bases_.emplace_front(key, std::async(std::launch::async, make_base, wound, name));
    if (bases_.size() > most_bases)
        bases_.pop_back();
    return bases_.front().second;
}

std::shared_ptr<Fit> Workshop::fit(const WoundScene& wound, std::shared_ptr<const LoadedHead> head,
                                   const std::string& name, bool begin)
{
    const std::string key = fit_key(wound, *head);
    if (const auto found = std::ranges::find(fits_, key, &Entry::key); found != fits_.end()) {
        if (found->failed) {
            const std::exception_ptr failed = found->failed;
            fits_.erase(found);
            std::rethrow_exception(failed);
        }
        fits_.splice(fits_.begin(), fits_, found);
        return found->fit;
    }
    const std::string photograph = photograph_key(wound);
    const bool room =
        begin && jobs_.size() < most_jobs &&
        std::size_t(std::ranges::count(jobs_, photograph, &Job::photograph)) < most_jobs_of_a_photograph;
    if (room && std::ranges::find(jobs_, key, &Job::key) == jobs_.end())
        jobs_.push_back({key, photograph, std::async(std::launch::async, [=, made = base(wound, name)] {
                             return make_fit(wound, *made.get(), *head, name);
                         })});
    return nullptr;
}

std::shared_ptr<Fit> Workshop::similar(const WoundScene& wound, const passes::FaceFrame& face) const
{
    const auto face_point = [&](const passes::Place& place) {
        if (const auto* point = std::get_if<glm::dvec3>(&place))
            return glm::dvec2(point->x - face.nose_tip.x, point->y - face.nose_tip.y) / face.unit_m;
        const passes::FacePoint at = passes::known_face_point(place).value_or(passes::FacePoint{});
        return glm::dvec2(at.x, at.y);
    };
    const std::string photograph = photograph_key(wound);
    std::shared_ptr<Fit> best;
    double least = 0;
    for (const Entry& entry : fits_) {
        if (!entry.fit || entry.photograph != photograph)
            continue;
        const double apart = glm::distance(face_point(entry.fit->scene.place), face_point(wound.place)) +
                             std::abs(std::log(entry.fit->scene.width_mm / wound.width_mm));
        if (!best || apart < least) {
            best = entry.fit;
            least = apart;
        }
    }
    return best;
}

bool Workshop::collect()
{
    bool any = false;
    if (head_job_.valid() && ready(head_job_)) {
        any = true;
        try {
            head_ = head_job_.get();
        } catch (...) {
            head_failed_ = std::current_exception();
        }
    }
    for (auto job = jobs_.begin(); job != jobs_.end();) {
        if (!ready(job->result)) {
            ++job;
            continue;
        }
        any = true;
        Entry entry{job->key, job->photograph, nullptr, nullptr};
        try {
            entry.fit = job->result.get();
        } catch (...) {
            entry.failed = std::current_exception();
            std::erase_if(bases_, [](const auto& base) { return failed(base.second); });
        }
        fits_.push_front(std::move(entry));
        job = jobs_.erase(job);
    }
    while (fits_.size() > most_fits)
        fits_.pop_back();
    news_ += any;
    return any;
}

void Workshop::wait() const
{
    const auto any_ready = [&] {
        return (head_job_.valid() && ready(head_job_)) ||
               std::ranges::any_of(jobs_, [](const Job& job) { return ready(job.result); });
    };
    while (busy() && !any_ready())
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

} // namespace app
