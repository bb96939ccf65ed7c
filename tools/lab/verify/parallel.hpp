// Work spread over threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace gobo::verify {

/// Calls `work(i)` for each index below `count`, once, by `jobs` threads. Which thread does what is not
/// determined: `work` must not care.
template <class Work>
void for_each_index(std::size_t count, int jobs, const Work& work) {
    std::atomic<std::size_t> next = 0;
    const auto run = [&] {
        for (std::size_t i = next++; i < count; i = next++) work(i);
    };
    std::vector<std::jthread> threads;
    for (int i = 1; i < jobs; ++i) threads.emplace_back(run);
    run();
}

}  // namespace gobo::verify
