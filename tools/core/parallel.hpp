// Work spread over threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace gobo {

/// Calls `work(i)` for each index below `count`, once, by `jobs` threads of which the caller's is one. Which
/// thread does what is not determined: `work` must not care, nor throw.
template <class Work>
void parallel_for(int jobs, std::size_t count, const Work& work) {
    std::atomic<std::size_t> next = 0;
    const auto run = [&] {
        for (std::size_t i = next++; i < count; i = next++) work(i);
    };
    std::vector<std::jthread> threads;
    for (std::size_t i = 1; i < count && static_cast<int>(i) < jobs; ++i) threads.emplace_back(run);
    run();
}

}  // namespace gobo
