#include "lab/sanitize/stages.hpp"

#include <atomic>
#include <thread>

namespace gobo::sanitize {

void for_each_index(std::size_t count, int jobs, const std::function<void(std::size_t)>& work) {
    std::atomic<std::size_t> next = 0;
    const auto run = [&] {
        for (std::size_t i = next++; i < count; i = next++) work(i);
    };
    std::vector<std::jthread> threads;
    for (int i = 1; i < jobs; ++i) threads.emplace_back(run);
    run();
}

std::vector<std::size_t> permutations_of(const Composition& composition, std::size_t stage) {
    std::vector<std::size_t> permutations;
    for (std::size_t i = 0; i < composition.permutations.size(); ++i) {
        const Permutation& permutation = composition.permutations[i];
        if (permutation.vertex == static_cast<int>(stage) || permutation.fragment == static_cast<int>(stage))
            permutations.push_back(i);
    }
    return permutations;
}

}  // namespace gobo::sanitize
