// The slow part of showing a scene, done by workers and remembered by what it was made from: heads read from
// files, wounds prepared from photographs and fitted to the skin they lie on. Needs no device.
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

/// A head read from its file, the default one for an empty path.
struct LoadedHead
{
    std::shared_ptr<const head::Model> model;
    std::shared_ptr<const head::Bvh> bvh; // of its solid triangles
    head::FaceFrame face;
    std::uint32_t skin = 0; // material
    std::vector<std::string> notes;
    std::string key; // file and time of its last change
};
/// Throws base::InputError.
std::shared_ptr<const LoadedHead> load_head(const std::filesystem::path& file);

/// One wound of a photograph, fitted to the skin at its anchor.
struct FittedWound
{
    wound::PreparedWound prepared; // matched to the skin
    head::Anchor anchor;
    cv::Rect region; // wound::drawn_region
};

/// The wounds of one photograph; more than one when its mask has several components.
struct FittedPhotograph
{
    struct Part // as in wound::WoundPart
    {
        cv::Point2d offset_mm;
        double width_mm;
    };
    Wound wound; // as it was when this was made
    std::vector<Part> layout;
    std::vector<FittedWound> wounds; // one per part
};

/// Where the wounds of a photograph lie when the scene's wound is as `wound` says: the first at its place,
/// the others beside it. Throws base::InputError naming `name` when one is not on the head.
std::vector<head::Anchor> anchors_of(const Wound& wound, const FittedPhotograph& photograph,
                                     const LoadedHead& head, const std::string& name);

/// Throws base::InputError, naming the photograph, when its components bring the wounds of a scene to
/// more than there may be.
void check_count(std::size_t all, std::size_t components, const std::string& name);

/// Used by one thread at a time; its workers are its own. Destroying it waits for them.
class WoundLoader
{
  public:
    /// The head, `current` if that is it, or null while it is being read. Throws the base::InputError by
    /// which that has failed; asked for again, it is tried again.
    std::shared_ptr<const LoadedHead> head(const std::filesystem::path& file,
                                           const std::shared_ptr<const LoadedHead>& current);
    /// A head that was read elsewhere.
    void put(std::shared_ptr<const LoadedHead> head) { head_ = std::move(head); }
    /// The wound's photograph fitted to the head, or null while it is being made. With `begin`, work on one
    /// that is not ready is begun, if there is room; it must be asked for again when collect() returns true.
    std::shared_ptr<const FittedPhotograph> fitted(const Wound& wound, std::shared_ptr<const LoadedHead> head,
                                                   const std::string& name, bool begin = true);
    /// Starts preparing the wound's photograph, for which no head is needed.
    void begin(const Wound& wound, const std::string& name) { prepared(wound, name); }

    /// Of the ready ones of the same photograph the one nearest in place and size; null when there is none.
    std::shared_ptr<const FittedPhotograph> similar(const Wound& wound, const head::FaceFrame& face) const;

    /// Takes what the workers have finished; returns whether there was anything, be it a failure.
    bool collect();
    /// Waits until one of them has finished; returns at once when none works.
    void wait() const;
    bool busy() const { return !jobs_.empty() || head_job_.valid(); }
    /// How often collect() has taken something: so that every stage that shares the loader sees it.
    std::uint64_t news() const { return news_; }

    struct Prepared; // what a photograph gives without a face

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
        std::exception_ptr failed;                      // for whoever asks next
    };
    SharedPrepared prepared(const Wound& wound, const std::string& name);

    std::list<std::pair<Key, SharedPrepared>> prepared_; // the last used first
    std::list<Entry> fitted_;                            // the same
    std::vector<Job> jobs_;
    std::shared_ptr<const LoadedHead> head_;
    std::future<std::shared_ptr<const LoadedHead>> head_job_;
    std::string head_job_key_;
    std::exception_ptr head_failed_;
    std::uint64_t news_ = 0;
};

} // namespace scene
