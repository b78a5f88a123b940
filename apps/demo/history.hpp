// Undo and redo: keeps the earlier values of the scene.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "scene/scene.hpp"

namespace demo_command {

class History
{
  public:
    explicit History(scene::Scene first) { values_.push_back(std::move(first)); }

    const scene::Scene& now() const { return values_[at_]; }
    /// Adds the edited scene and drops undone steps; ignores a scene equal to now(). Consecutive edits of one
    /// nonempty kind ("move wound 1") are one step until settle(), so a whole drag is undone at once.
    void edit(scene::Scene scene, const std::string& kind)
    {
        if (scene == now())
            return;
        values_.resize(at_ + 1);
        if (kind_.empty() || kind != kind_) {
            values_.push_back(std::move(scene));
            ++at_;
        } else
            values_.back() = std::move(scene);
        kind_ = kind;
        if (values_.size() > most) {
            values_.erase(values_.begin());
            --at_;
        }
    }
    /// Ends a drag: the next edit becomes a new step.
    void settle() { kind_.clear(); }

    bool can_undo() const { return at_ > 0; }
    bool can_redo() const { return at_ + 1 < values_.size(); }
    /// undo(), redo(): return the scene to show, which is the present one when there is no step.
    const scene::Scene& undo()
    {
        settle();
        at_ -= can_undo();
        return now();
    }
    const scene::Scene& redo()
    {
        settle();
        at_ += can_redo();
        return now();
    }

  private:
    static constexpr std::size_t most = 500; // scenes of a few kilobytes each
    std::vector<scene::Scene> values_;
    std::size_t at_ = 0;
    std::string kind_; // kind of the edit in progress; empty: none
};

} // namespace demo_command
