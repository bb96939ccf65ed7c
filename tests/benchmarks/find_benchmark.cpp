// How long a generated header takes to find one of 10,000 permutations: canonicalising, packing, searching.
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include "large.hpp"

namespace {

constexpr std::size_t key_count = 4096;

/// Keys that were built, in an order that no branch predictor learns.
std::vector<large::Key> built_keys() {
    std::mt19937 random(1);
    std::vector<large::Key> keys;
    while (keys.size() < key_count) {
        keys.push_back(large::permutations[random() % large::permutations.size()].key());
    }
    return keys;
}

/// Any values within range: most of these keys are not canonical, or not built.
std::vector<large::Key> any_keys() {
    std::mt19937 random(2);
    std::vector<large::Key> keys;
    while (keys.size() < key_count) {
        large::Key key;
        key.directional = static_cast<int>(random() % 9);
        key.point = static_cast<int>(random() % 9);
        key.fog = static_cast<large::Fog>(random() % 4);
        key.fog_distance = static_cast<large::FogDistance>(random() % 2);
        key.shading = static_cast<large::Shading>(random() % 3);
        key.specular = static_cast<large::Specular>(random() % 3);
        key.diffuse = static_cast<large::Diffuse>(random() % 2);
        keys.push_back(key);
    }
    return keys;
}

void find(benchmark::State& state, const std::vector<large::Key>& keys) {
    std::size_t next = 0;
    for ([[maybe_unused]] auto step : state) {
        benchmark::DoNotOptimize(large::find(keys[next]));
        next = (next + 1) % key_count;
    }
}

void find_built(benchmark::State& state) {
    find(state, built_keys());
}

void find_any(benchmark::State& state) {
    find(state, any_keys());
}

BENCHMARK(find_built);
BENCHMARK(find_any);

}  // namespace

BENCHMARK_MAIN();
