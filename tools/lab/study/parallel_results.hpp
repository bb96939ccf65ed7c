// Results of work spread over threads.
#pragma once

#include <type_traits>
#include <vector>

#include "core/diagnostic.hpp"
#include "core/parallel.hpp"

namespace gobo::study {

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

}  // namespace gobo::study
