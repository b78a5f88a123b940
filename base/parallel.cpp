#include "base/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace base {

void in_parallel(std::size_t count, unsigned threads, const std::function<void(std::size_t)>& work)
{
    if (count == 0)
        return;
    std::atomic<std::size_t> next{0};
    std::exception_ptr failed;
    std::mutex mutex;
    const auto run = [&] {
        try {
            for (std::size_t i; (i = next++) < count;)
                work(i);
        } catch (...) {
            next = count;
            const std::lock_guard lock(mutex);
            if (!failed)
                failed = std::current_exception();
        }
    };
    const std::size_t cores = threads ? threads : std::max(1u, std::thread::hardware_concurrency());
    {
        std::vector<std::jthread> others(std::min(cores, count) - 1);
        for (std::jthread& other : others)
            other = std::jthread(run);
        run();
    }
    if (failed)
        std::rethrow_exception(failed);
}

} // namespace base
