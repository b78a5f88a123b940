// Undo and redo: a scene is a value, so the history is the values it has had.
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
    /// The scene after an edit; nothing when it is equal to now(). Edits of the same kind ("move wound 1") in
    /// a row are one step, until settle(): a whole drag is undone at once. What was undone is dropped.
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
    /// The drag is over (the button was released): the next edit is a step of its own.
    void settle() { kind_.clear(); }

    bool can_undo() const { return at_ > 0; }
    bool can_redo() const { return at_ + 1 < values_.size(); }
    /// Return the scene to show; the present one when there is no step to take.
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
    static constexpr std::size_t most = 500; // a few kilobytes each
    std::vector<scene::Scene> values_;
    std::size_t at_ = 0;
    std::string kind_; // of the edit that goes on; empty: none does
};

} // namespace demo_command
