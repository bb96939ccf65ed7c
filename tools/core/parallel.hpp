// Work spread over threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <thread>
#include <type_traits>
#include <vector>

#include "core/diagnostic.hpp"

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

/// What `work`, a function that gives a Result, gives for each index below `count`, by `jobs` threads; or the
/// errors of the first that fails.
template <class Work, class Value = typename std::invoke_result_t<Work, std::size_t>::value_type>
Result<std::vector<Value>> parallel_results(int jobs, std::size_t count, const Work& work) {
    std::vector<Result<Value>> results(count);
    parallel_for(jobs, count, [&](std::size_t i) { results[i] = work(i); });
    std::vector<Value> values;
    for (Result<Value>& result : results) {
        GOBO_TRY(Value value, std::move(result));
        values.push_back(std::move(value));
    }
    return values;
}

}  // namespace gobo
