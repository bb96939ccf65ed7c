// Work spread over threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace gobo {

/// Calls `work(i)` for each index below `count`, once, by `jobs` threads of which the caller's is one. Which
/// thread does what is not determined: `work` must not care. Where the system has no memory left, what `work`
/// throws is thrown here; where it gives no more threads, those that there are do the work.
template <class Work>
void parallel_for(int jobs, std::size_t count, const Work& work) {
    std::atomic<std::size_t> next = 0;
    std::atomic<bool> has_failed = false;
    std::exception_ptr failure;
    const auto run = [&] {
        try {
            for (std::size_t i = next++; i < count; i = next++) work(i);
        } catch (...) {
            if (!has_failed.exchange(true)) failure = std::current_exception();
            next = count;
        }
    };
    std::vector<std::jthread> threads;
    try {
        for (std::size_t i = 1; i < count && static_cast<int>(i) < jobs; ++i) threads.emplace_back(run);
    } catch (const std::system_error&) {
    }
    run();
    threads.clear();
    if (failure) std::rethrow_exception(failure);
}

}  // namespace gobo
