#include "scene/loader.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <ranges>
#include <thread>
#include <utility>

#include "base/file.hpp"
#include "base/image_io.hpp"
#include "base/input_error.hpp"
#include "head/albedo_under.hpp"
#include "head/curvature.hpp"
#include "head/default_head.hpp"
#include "head/materials.hpp"
#include "head/occlusion.hpp"
#include "scene/field_table.hpp"
#include "shaders/shared/frame.h"
#include "wound/drawn_region.hpp"
#include "wound/skin_match.hpp"
#include "wound/synthetic/synthetic.hpp"

namespace scene {

struct WoundLoader::Prepared
{
    std::vector<wound::WoundPart> parts;
    std::vector<wound::PreparedWound> prepared; // one per part, with depths for `tissue`
    wound::TissueThickness tissue;
};

namespace {

constexpr std::size_t most_prepared = 8, most_unused = 32; // some 6 MB each
constexpr std::ptrdiff_t most_jobs = 8, most_jobs_of_a_photograph = 2;

std::uint64_t key_of(const Wound& wound, Affects affects)
{
    base::Hash hash;
    hash_fields(hash, wound, affects);
    return hash.value();
}

std::uint64_t prepared_key(const WantedWound& wanted)
{
    return base::Hash().add(key_of(wanted.wound, Affects::Preparation)).add(wanted.of_many).value();
}

std::uint64_t fitted_key(const WantedWound& wanted, const LoadedHead& head)
{
    base::Hash hash;
    hash_fields(hash, wanted.wound, Affects::Fit);
    return hash.add(head.key).add(wanted.of_many).value();
}

std::filesystem::path head_file(const std::filesystem::path& file)
{
    return file.empty() ? head::default_head_path() : file;
}

/// The layers' thickness for the wound's depth.
wound::TissueThickness scaled_tissue(const Wound& wound, const head::FacePoint& face)
{
    const wound::TissueThickness tissue = tissue_at(face);
    return {tissue.epidermis * wound.depth_factor, tissue.dermis * wound.depth_factor,
            tissue.subcutis * wound.depth_factor};
}

std::shared_ptr<const WoundLoader::Prepared> make_prepared(const Wound& wound, const std::string& name,
                                                           bool of_many)
{
    auto made = std::make_shared<WoundLoader::Prepared>();
    made->tissue = scaled_tissue(wound, head::known_face_point(wound.place).value_or(head::FacePoint{}));
    wound::Preparation preparation;
    preparation.where = wound.mask.empty() ? name : wound.mask.string();
    preparation.width_mm = wound.width_mm;
    preparation.hints = wound.segmentation;
    preparation.depth.tissue = made->tissue;
    made->parts = wound::separate(read_photograph(wound), preparation);
    check_count(made->parts.size(), made->parts.size(), name);
    preparation.where = name;
    std::vector<std::future<wound::PreparedWound>> prepared;
    for (const wound::WoundPart& part : made->parts) {
        preparation.width_mm = part.width_mm;
        if (of_many || made->parts.size() > shared::WOUNDS_HERE)
            preparation.patch_size = wound::shared_patch_size(part.width_mm);
        prepared.push_back(
            std::async(std::launch::async, wound::prepare, std::cref(part.photograph), preparation));
    }
    for (std::future<wound::PreparedWound>& part : prepared)
        made->prepared.push_back(part.get());
    return made;
}

FittedWound fit_part(const Wound& wound, const WoundLoader::Prepared& photograph, std::size_t part,
                     const head::Anchor& anchor, const LoadedHead& head)
{
    FittedWound fitted{photograph.prepared[part], anchor, tissue_at(anchor.face), {}};
    wound::Patch& patch = fitted.prepared.patch;
    if (const wound::TissueThickness tissue = scaled_tissue(wound, anchor.face); tissue != photograph.tissue)
    {
        wound::DepthOptions options;
        options.tissue = tissue;
        patch.depth_mm = wound::depth_of(patch, options);
    }
    patch = wound::match_to_skin(patch, head::albedo_under(*head.model, head.skin, anchor, patch.color.cols));
    fitted.region = wound::drawn_region(fitted.prepared, wound.healing);
    return fitted;
}

std::shared_ptr<const FittedPhotograph> make_fitted(const Wound& wound,
                                                    const WoundLoader::Prepared& photograph,
                                                    const LoadedHead& head, const std::string& name)
{
    auto fit = std::make_shared<FittedPhotograph>();
    fit->wound = wound;
    for (const wound::WoundPart& part : photograph.parts)
        fit->layout.push_back({part.offset_mm, part.width_mm});
    const std::vector<head::Anchor> anchors = anchors_of(wound, *fit, head, name);
    std::vector<std::future<FittedWound>> others;
    for (std::size_t i = 1; i < anchors.size(); ++i)
        others.push_back(std::async(std::launch::async, fit_part, std::cref(wound), std::cref(photograph), i,
                                    std::cref(anchors[i]), std::cref(head)));
    fit->wounds.push_back(fit_part(wound, photograph, 0, anchors[0], head));
    for (std::future<FittedWound>& other : others)
        fit->wounds.push_back(other.get());
    return fit;
}

/// Whether the future is ready and holds an exception.
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

template <typename Future>
bool ready(const Future& future)
{
    return future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

} // namespace

wound::Photograph read_photograph(const Wound& wound)
{
    if (wound.photo.empty()) {
        wound::SyntheticWound synthetic;
        synthetic.kind = wound.kind;
        synthetic.seed = wound.seed;
        return wound::synthesize(synthetic);
    }
    wound::Photograph photograph{base::read_rgb(wound.photo), {}, {}};
    if (!wound.mask.empty())
        photograph.mask = base::read_mask(wound.mask);
    return photograph;
}

WantedWound wanted(const std::vector<Wound>& wounds, std::size_t index)
{
    return {wounds[index], name_of(wounds[index], index), wounds.size() > shared::WOUNDS_HERE};
}

void check_count(std::size_t all, std::size_t components, const std::string& name)
{
    if (all > std::size_t(shared::MAX_WOUNDS))
        throw base::InputError(
            name,
            fmt::format("with its {} wounds (components of the mask, or found) the scene has more than {}",
                        components, shared::MAX_WOUNDS),
            "remove wounds from the scene or components from the mask; without a mask, give a rectangle or "
            "a seed");
}

std::vector<head::Anchor> anchors_of(const Wound& wound, const FittedPhotograph& photograph,
                                     const LoadedHead& head, const std::string& name)
{
    const double scale = wound.width_mm / photograph.wound.width_mm; // not 1 if fitted for another width
    std::vector<head::Anchor> anchors{head::anchor_wound(*head.model, *head.bvh, head.face, wound.place,
                                                         wound.width_mm / wound::wound_share, wound.roll_deg,
                                                         name + ": at")};
    for (std::size_t i = 1; i < photograph.layout.size(); ++i) {
        const FittedPhotograph::Part& part = photograph.layout[i];
        anchors.push_back(head::anchor_beside(
            *head.model, *head.bvh, head.face, anchors.front(),
            1e-3 * scale * glm::dvec2(part.offset_mm.x, part.offset_mm.y),
            scale * part.width_mm / wound::wound_share,
            fmt::format("{}: component {} of the mask or of the wounds found", name, i + 1)));
    }
    return anchors;
}

std::shared_ptr<const LoadedHead> load_head(const std::filesystem::path& chosen)
{
    const std::filesystem::path file = head_file(chosen);
    if (chosen.empty() && !std::filesystem::exists(file))
        throw base::InputError(file.string(), "the default head has not been made yet",
                               "make it once with cicatrix-fetch-head (from a checkout: ./run setup), or "
                               "give your own head with --head FILE.glb");
    auto head = std::make_shared<LoadedHead>();
    head->key = base::file_version(file);
    auto model = std::make_shared<head::Model>(head::load_model(file));
    head::normalise_size(*model);
    head::order_for_drawing(*model);
    head::compute_curvature(*model);
    for (const std::string& note : model->notes)
        head->notes.push_back(fmt::format("{}: {}", file.string(), note));
    head->face = head::find_face(*model);
    head->skin = head::skin_material(*model);
    head->bvh = std::make_shared<const head::Bvh>(*model);
    const std::string problem = head::bake_occlusion(*model, *head->bvh, base::cache_folder() / "occlusion");
    if (!head::has_occlusion_map(*model))
        head->notes.push_back(fmt::format("{}: no occlusion map: computed from the shape", file.string()));
    if (!problem.empty())
        head->notes.push_back(problem);
    head->model = std::move(model);
    return head;
}

std::shared_ptr<const LoadedHead> WoundLoader::head(const std::filesystem::path& file,
                                                    const std::shared_ptr<const LoadedHead>& current)
{
    const std::string key = base::file_version(head_file(file));
    if (current && current->key == key)
        return current;
    if (head_ && head_->key == key)
        return head_;
    if (head_failed_ && head_job_key_ == key)
        std::rethrow_exception(std::exchange(head_failed_, nullptr));
    if (!head_job_.valid()) {
        head_failed_ = nullptr; // drop the failure of another head
        head_job_key_ = key;
        head_job_ = std::async(std::launch::async, load_head, file);
    }
    return nullptr;
}

WoundLoader::SharedPrepared WoundLoader::prepared(const WantedWound& wanted)
{
    const Key key = prepared_key(wanted);
    const auto found = std::ranges::find(prepared_, key, &std::pair<Key, SharedPrepared>::first);
    if (found != prepared_.end())
        prepared_.splice(prepared_.begin(), prepared_, found);
    else
        prepared_.emplace_front(
            key, std::async(std::launch::async, make_prepared, wanted.wound, wanted.name, wanted.of_many));
    const SharedPrepared made = prepared_.front().second;
    // The least recently used; to drop one that is not ready would wait for it.
    const auto oldest = std::ranges::find_if(prepared_ | std::views::reverse,
                                             [](const auto& one) { return ready(one.second); });
    if (prepared_.size() > most_prepared && oldest != prepared_.rend())
        prepared_.erase(std::next(oldest).base());
    return made;
}

void WoundLoader::begin(const WantedWound& wanted)
{
    if (std::ranges::count_if(prepared_, [](const auto& one) { return !ready(one.second); }) < most_jobs)
        prepared(wanted);
}

std::shared_ptr<const FittedPhotograph>
WoundLoader::fitted(const WantedWound& wanted, std::shared_ptr<const LoadedHead> head, bool begin)
{
    const Wound& wound = wanted.wound;
    const Key key = fitted_key(wanted, *head);
    if (const auto found = std::ranges::find(fitted_, key, &Entry::key); found != fitted_.end()) {
        if (found->failed) {
            const std::exception_ptr failed = found->failed;
            fitted_.erase(found);
            std::rethrow_exception(failed);
        }
        fitted_.splice(fitted_.begin(), fitted_, found);
        return found->fitted;
    }
    const Key photograph = key_of(wound, Affects::Photograph);
    const bool room = begin && std::ssize(jobs_) < most_jobs &&
                      std::ranges::count(jobs_, photograph, &Job::photograph) < most_jobs_of_a_photograph;
    if (room && std::ranges::find(jobs_, key, &Job::key) == jobs_.end())
        jobs_.push_back({key, photograph,
                         std::async(std::launch::async,
                                    [=, made = prepared(wanted), wound = Wound(wound), name = wanted.name] {
                                        return make_fitted(wound, *made.get(), *head, name);
                                    })});
    return nullptr;
}

std::shared_ptr<const FittedPhotograph> WoundLoader::similar(const Wound& wound,
                                                             const head::FaceFrame& face) const
{
    const auto face_point = [&](const head::Place& place) {
        if (const auto* point = std::get_if<glm::dvec3>(&place))
            return glm::dvec2(point->x - face.nose_tip.x, point->y - face.nose_tip.y) / face.unit_m;
        const head::FacePoint at = head::known_face_point(place).value_or(head::FacePoint{});
        return glm::dvec2(at.x, at.y);
    };
    const Key photograph = key_of(wound, Affects::Photograph);
    std::shared_ptr<const FittedPhotograph> best;
    double least = 0;
    for (const Entry& entry : fitted_) {
        if (!entry.fitted || entry.photograph != photograph)
            continue;
        const double apart = glm::distance(face_point(entry.fitted->wound.place), face_point(wound.place)) +
                             std::abs(std::log(entry.fitted->wound.width_mm / wound.width_mm));
        if (!best || apart < least) {
            best = entry.fitted;
            least = apart;
        }
    }
    return best;
}

bool WoundLoader::collect()
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
            entry.fitted = job->result.get();
        } catch (...) {
            entry.failed = std::current_exception();
            std::erase_if(prepared_, [](const auto& prepared) { return failed(prepared.second); });
        }
        fitted_.push_front(std::move(entry));
        job = jobs_.erase(job);
    }
    // Those of a scene are kept, however many it has.
    std::size_t unused = 0;
    std::erase_if(
        fitted_, [&](const Entry& entry) { return entry.fitted.use_count() <= 1 && ++unused > most_unused; });
    news_ += any;
    return any;
}

void WoundLoader::wait() const
{
    const auto any_ready = [&] {
        return (head_job_.valid() && ready(head_job_)) ||
               std::ranges::any_of(jobs_, [](const Job& job) { return ready(job.result); });
    };
    while (busy() && !any_ready())
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

} // namespace scene
