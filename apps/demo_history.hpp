// Undo and redo: the values a thing has had.
#pragma once
#include <deque>
#include <utility>

namespace app {

template <typename Value>
class History
{
  public:
    explicit History(Value first) : states_{std::move(first)} {}

    const Value& now() const { return states_[at_]; }
    /// What had been undone is forgotten.
    void add(Value next)
    {
        states_.erase(states_.begin() + std::ptrdiff_t(at_) + 1, states_.end());
        states_.push_back(std::move(next));
        if (states_.size() > most)
            states_.pop_front();
        at_ = states_.size() - 1;
    }
    bool can_undo() const { return at_ > 0; }
    bool can_redo() const { return at_ + 1 < states_.size(); }
    const Value& undo() { return states_[at_ -= can_undo()]; }
    const Value& redo() { return states_[at_ += can_redo()]; }

  private:
    static constexpr std::size_t most = 200;
    std::deque<Value> states_;
    std::size_t at_ = 0;
};

} // namespace app
