// Loads the slow parts of a scene in worker threads and caches them by a hash of their inputs: heads read
// from files, and wounds prepared from photographs and fitted to the skin. Needs no graphics device.
#pragma once
#include <chrono>
#include <cstdint>
#include <exception>
#include <future>
#include <list>
#include <memory>
#include <string>
#include <vector>

#include "head/bvh.hpp"
#include "head/model.hpp"
#include "head/placement.hpp"
#include "scene/scene.hpp"
#include "wound/prepare.hpp"

namespace scene {

/// A head read from its file; the default head for an empty path.
struct LoadedHead
{
    std::shared_ptr<const head::Model> model;
    std::shared_ptr<const head::Bvh> bvh; // of the model's solid triangles
    head::FaceFrame face;
    std::uint32_t skin = 0; // index of the skin's material
    std::vector<std::string> notes;
    std::string key; // base::file_version()
};
/// Throws base::InputError.
std::shared_ptr<const LoadedHead> load_head(const std::filesystem::path& file);

/// The wound's photograph with its mask, if it has one; a default wound is generated. Throws
/// base::InputError.
wound::Photograph read_photograph(const Wound& wound);

/// One wound of a photograph, fitted to the skin at its anchor.
struct FittedWound
{
    wound::PreparedWound prepared; // matched to the skin
    head::Anchor anchor;
    wound::TissueThickness thickness; // of the skin's layers at the anchor
    cv::Rect region;                  // wound::drawn_region
};

/// The wounds of one photograph, one per component of its mask or per wound found.
struct FittedPhotograph
{
    struct Part // as in wound::WoundPart
    {
        cv::Point2d offset_mm;
        double width_mm;
    };
    Wound wound; // the scene's wound for which this was made
    std::vector<Part> layout;
    std::vector<FittedWound> wounds; // one per part
};

/// Anchors of a photograph's wounds for the place, width and roll of `wound`: the first at its place, the
/// others beside it. Throws base::InputError naming `name` if one is not on the head.
std::vector<head::Anchor> anchors_of(const Wound& wound, const FittedPhotograph& photograph,
                                     const LoadedHead& head, const std::string& name);

/// Throws base::InputError naming the photograph (`name`) if the scene has more than MAX_WOUNDS wounds: `all`
/// so far, of which `components` belong to this photograph.
void check_count(std::size_t all, std::size_t components, const std::string& name);

/// A wound whose photograph is to be prepared and fitted.
struct WantedWound
{
    const Wound& wound;
    std::string name; // for error messages
    /// The scene, or this photograph, has more wounds than one place can show (shared::WOUNDS_HERE): their
    /// maps are no larger than wound::shared_patch_size().
    bool of_many = false;
};
/// The `index`-th of a scene's wounds.
WantedWound wanted(const std::vector<Wound>& wounds, std::size_t index);

/// Use from one thread at a time; it owns its worker threads. The destructor waits for them.
class WoundLoader
{
  public:
    /// The head (`current` if that is from this file), or null while a worker reads it. Throws the reading's
    /// base::InputError once; the next call tries again.
    std::shared_ptr<const LoadedHead> head(const std::filesystem::path& file,
                                           const std::shared_ptr<const LoadedHead>& current);
    /// Adds a head that was read elsewhere.
    void put(std::shared_ptr<const LoadedHead> head) { head_ = std::move(head); }
    /// The wound's photograph fitted to the head, or null if it is not ready. `begin`: start work on it if
    /// the number of jobs allows; call again after collect() has returned true. Throws the work's exception
    /// once.
    std::shared_ptr<const FittedPhotograph> fitted(const WantedWound& wanted,
                                                   std::shared_ptr<const LoadedHead> head, bool begin = true);
    /// Starts preparing the wound's photograph, which needs no head, if the number of jobs allows.
    void begin(const WantedWound& wanted);

    /// The cached fit of the same photograph that is nearest in place and size; null if there is none.
    std::shared_ptr<const FittedPhotograph> similar(const Wound& wound, const head::FaceFrame& face) const;

    /// Takes finished results from the workers; returns whether there were any, including failures.
    bool collect();
    /// Waits until a worker has finished; returns at once if none is running.
    void wait() const;
    bool busy() const { return !jobs_.empty() || head_job_.valid(); }
    /// How often collect() has returned true, so that every user of a shared loader notices it.
    std::uint64_t news() const { return news_; }

    struct Prepared; // the part of the preparation that needs no head

  private:
    using SharedPrepared = std::shared_future<std::shared_ptr<const Prepared>>;
    using Key = std::uint64_t; // hash_fields()
    struct Job
    {
        Key key, photograph;
        std::future<std::shared_ptr<const FittedPhotograph>> result;
    };
    struct Entry
    {
        Key key, photograph;
        std::shared_ptr<const FittedPhotograph> fitted; // null: failed
        std::exception_ptr failed;                      // thrown by the next fitted()
    };
    SharedPrepared prepared(const WantedWound& wanted);

    std::list<std::pair<Key, SharedPrepared>> prepared_; // most recently used first
    std::list<Entry> fitted_;                            // most recently used first
    std::vector<Job> jobs_;
    std::shared_ptr<const LoadedHead> head_;
    std::future<std::shared_ptr<const LoadedHead>> head_job_;
    std::string head_job_key_;
    std::exception_ptr head_failed_;
    std::uint64_t news_ = 0;
};

} // namespace scene
