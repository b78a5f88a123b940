// Files being encoded in the background while the next picture is drawn.
#pragma once
#include <cstddef>
#include <deque>
#include <future>
#include <utility>

namespace base {

/// An error of any of them surfaces in finish() or push().
class Writers
{
  public:
    /// `bytes` is what the work holds on to: beyond 256 MiB in all, or four files, push() waits for the
    /// oldest, so that large pictures do not pile up.
    template <typename Work>
    void push(std::size_t bytes, Work work)
    {
        while (!running_.empty() && (running_.size() >= 4 || held_ + bytes > std::size_t{256} << 20))
            pop();
        running_.emplace_back(bytes, std::async(std::launch::async, std::move(work)));
        held_ += bytes;
    }
    void finish()
    {
        while (!running_.empty())
            pop();
    }

  private:
    void pop()
    {
        auto [bytes, first] = std::move(running_.front());
        running_.pop_front();
        held_ -= bytes;
        first.get();
    }
    std::deque<std::pair<std::size_t, std::future<void>>> running_;
    std::size_t held_ = 0;
};

} // namespace base
