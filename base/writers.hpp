// Encodes and writes files in the background while the next picture is rendered.
#pragma once
#include <cstddef>
#include <deque>
#include <future>
#include <utility>

namespace base {

/// push() and finish() rethrow the exceptions of the background work.
class Writers
{
  public:
    /// Starts `work`, which holds `bytes` of memory. Waits for the oldest work while four files are
    /// running or the total would exceed 256 MiB, to limit memory use.
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
