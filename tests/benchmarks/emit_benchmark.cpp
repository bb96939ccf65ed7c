// How long it takes to write the header and the manifest of many permutations.
#include <cstdlib>

#include <benchmark/benchmark.h>

#include "core/file_system.hpp"
#include "emit/emit.hpp"
#include "sample_family.hpp"

namespace gobo {
namespace {

void header(benchmark::State& state) {
    const DiskFileSystem files;
    const auto templates = read_header_templates(files, GOBO_SOURCE_DIR "/templates/header");
    if (!templates) std::abort();
    const sample::Built built = sample::large(static_cast<std::size_t>(state.range(0)));
    for ([[maybe_unused]] auto step : state) benchmark::DoNotOptimize(emit_header(built.input(), *templates));
}

void manifest(benchmark::State& state) {
    const sample::Built built = sample::large(static_cast<std::size_t>(state.range(0)));
    for ([[maybe_unused]] auto step : state) benchmark::DoNotOptimize(emit_manifest(built.input()));
}

BENCHMARK(header)->Arg(1024)->Arg(10000)->Unit(benchmark::kMillisecond);
BENCHMARK(manifest)->Arg(1024)->Arg(10000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gobo

BENCHMARK_MAIN();
