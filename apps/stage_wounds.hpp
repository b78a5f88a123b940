// The slow part of a stage, done on workers and remembered by what it was made from: heads read from files,
// wounds prepared from photographs and fitted to the skin they lie on. Stages may share one workshop.
#pragma once
#include <chrono>
#include <cstdint>
#include <exception>
#include <future>
#include <list>
#include <memory>
#include <string>
#include <vector>

#include "apps/scene.hpp"
#include "engine/model.hpp"
#include "passes/placement.hpp"
#include "passes/wound_texture.hpp"
#include "wound/prepare.hpp"

namespace app {

/// A head read from its file, the default one for an empty path.
struct LoadedHead
{
    std::shared_ptr<const engine::Model> model;
    passes::FaceFrame face;
    std::uint32_t skin = 0; // material
    std::vector<std::string> notes;
    std::string key; // file and time of its last change
};
/// Throws cicatrix::InputError.
std::shared_ptr<const LoadedHead> load_head(const std::filesystem::path& file);

/// One wound of a photograph, fitted to the skin at its anchor.
struct FittedWound
{
    wound::PreparedWound prepared; // matched to the skin
    passes::Anchor anchor;
    cv::Rect region; // wound::drawn_region
};

/// The wounds of one photograph; more than one when its mask has several components.
struct Fit
{
    struct Part // as in wound::WoundPart
    {
        cv::Point2d offset_mm;
        double width_mm;
    };
    WoundScene scene;
    std::vector<Part> layout;
    std::vector<FittedWound> wounds;     // one per part
    std::vector<passes::WoundMaps> maps; // on the device, one per wound once it has been shown
};

/// Where the wounds of a photograph lie when the scene's wound is as `scene` says: the first at its place,
/// the others beside it. Throws cicatrix::InputError naming `name` when one is not on the head.
std::vector<passes::Anchor> anchors_of(const WoundScene& scene, const Fit& fit, const LoadedHead& head,
                                       const std::string& name);

/// Throws cicatrix::InputError, naming the photograph, when its components bring the wounds of a scene to
/// more than there may be.
void check_count(std::size_t all, std::size_t components, const std::string& name);

/// "wound 2", or the photograph's path.
std::string name_of(const WoundScene& wound, std::size_t index);

/// Used by one thread at a time; its workers are its own. Destroying it waits for them.
class Workshop
{
  public:
    /// The head, `current` if that is it, or null while it is being read. Throws the cicatrix::InputError by
    /// which that has failed; asked for again, it is tried again.
    std::shared_ptr<const LoadedHead> head(const std::filesystem::path& file,
                                           const std::shared_ptr<const LoadedHead>& current);
    /// A head that was read elsewhere.
    void put(std::shared_ptr<const LoadedHead> head) { head_ = std::move(head); }
    /// The same for a wound. Unless `begin`, null is all that comes of one that is not ready. What there is
    /// no room for now must be asked for again when collect() returns true.
    std::shared_ptr<Fit> fit(const WoundScene& wound, std::shared_ptr<const LoadedHead> head,
                             const std::string& name, bool begin = true);
    /// Starts preparing the wound's photograph, for which no head is needed.
    void begin(const WoundScene& wound, const std::string& name) { base(wound, name); }

    /// Of the ready fits of the same photograph the one nearest in place and size; null when there is none.
    std::shared_ptr<Fit> similar(const WoundScene& wound, const passes::FaceFrame& face) const;

    /// Takes what the workers have finished; returns whether there was anything, be it a failure.
    bool collect();
    /// Waits until one of them has finished; returns at once when none works.
    void wait() const;
    bool busy() const { return !jobs_.empty() || head_job_.valid(); }
    /// How often collect() has taken something: so that every stage that shares the workshop sees news.
    std::uint64_t news() const { return news_; }

    struct Base; // what a photograph gives without a face

  private:
    using SharedBase = std::shared_future<std::shared_ptr<const Base>>;
    struct Job
    {
        std::string key, photograph;
        std::future<std::shared_ptr<Fit>> result;
    };
    struct Entry
    {
        std::string key, photograph;
        std::shared_ptr<Fit> fit;  // null: failed
        std::exception_ptr failed; // for whoever asks next
    };
    SharedBase base(const WoundScene& wound, const std::string& name);

    std::list<std::pair<std::string, SharedBase>> bases_; // the last used first
    std::list<Entry> fits_;                               // the same
    std::vector<Job> jobs_;
    std::shared_ptr<const LoadedHead> head_;
    std::future<std::shared_ptr<const LoadedHead>> head_job_;
    std::string head_job_key_;
    std::exception_ptr head_failed_;
    std::uint64_t news_ = 0;
};

} // namespace app
