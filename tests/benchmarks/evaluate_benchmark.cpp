// How many scalar fp32 operations the evaluator executes in a second on one core. The goal is 1,000 million
// for straight-line shading code.
#include <random>

#include <benchmark/benchmark.h>

#include "../unit/evaluate_support.hpp"

namespace gobo::evaluate {
namespace {

// Four point lights, unrolled: diffuse and specular (Blinn's half vector, the power by squaring),
// attenuation, linear fog.
constexpr const char* kShading = R"(#version 450
struct Light { vec4 position; vec3 color; float falloff; };
layout(std140, binding = 1) uniform Lights { Light lights[4]; };
layout(std140, binding = 2) uniform Fog { vec3 fogColor; float near; float far; };
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 albedo;
layout(location = 0) out vec4 color;
vec3 shade(Light light, vec3 n, vec3 v) {
    vec3 s = light.position.xyz - position;
    float squared = dot(s, s);
    s *= inversesqrt(squared);
    vec3 h = normalize(s + v);
    float diffuse = max(dot(n, s), 0.0);
    float specular = max(dot(n, h), 0.0);
    specular *= specular; specular *= specular; specular *= specular; specular *= specular; specular *= specular;
    float attenuation = 1.0 / (1.0 + light.falloff * squared);
    return (albedo * diffuse + vec3(0.25) * specular) * light.color * attenuation;
}
void main() {
    vec3 n = normalize(normal);
    vec3 v = normalize(-position);
    vec3 sum = albedo * 0.1;
    sum += shade(lights[0], n, v);
    sum += shade(lights[1], n, v);
    sum += shade(lights[2], n, v);
    sum += shade(lights[3], n, v);
    float fog = clamp((far - length(position)) / (far - near), 0.0, 1.0);
    color = vec4(mix(fogColor, sum, fog), 1.0);
})";

Invocations points(std::size_t count) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> between(-1.0, 1.0);
    Invocations invocations;
    invocations.count = count;
    for (const char* name : {"position", "normal", "albedo"})
        for (std::size_t i = 0; i < 3 * count; ++i) invocations.values[name].push_back(between(random));
    for (int light = 0; light < 4; ++light) {
        const std::string name = "Lights.lights[" + std::to_string(light) + "]";
        invocations.values[name + ".position"] = {between(random), between(random), between(random), 1};
        invocations.values[name + ".color"] = {1, 0.75, 0.5};
        invocations.values[name + ".falloff"] = {0.25};
    }
    invocations.values["Fog.near"] = {0.5};
    invocations.values["Fog.far"] = {2};
    return invocations;
}

/// Arithmetic of one invocation: no loads, stores, moves or branches.
std::uint64_t arithmetic(const Program& program) {
    Options options;
    options.count = true;
    const Outputs outputs = run<float>(program, points(1), options).value();
    std::uint64_t sum = 0;
    for (std::size_t kind = 0; kind < kKinds; ++kind) {
        const auto is = [&](Kind one) { return kind == static_cast<std::size_t>(one); };
        if (!is(Kind::load) && !is(Kind::store) && !is(Kind::move) && !is(Kind::branch) && !is(Kind::call))
            sum += outputs.counts[0][kind];
    }
    return sum;
}

void report(benchmark::State& state, const Program& program, std::size_t count) {
    const double operations =
        static_cast<double>(arithmetic(program) * count) * static_cast<double>(state.iterations());
    state.counters["operations/s"] = benchmark::Counter(operations, benchmark::Counter::kIsRate);
    state.counters["operations/invocation"] = static_cast<double>(arithmetic(program));
}

template <class T>
void straight_line(benchmark::State& state) {
    const Program program = program_of(ShaderStage::fragment, kShading);
    const Invocations invocations = points(4096);
    for (auto _ : state) {
        Outputs outputs = run<T>(program, invocations).value();
        benchmark::DoNotOptimize(outputs);
    }
    report(state, program, invocations.count);
}

void decoding(benchmark::State& state) {
    const std::vector<std::uint32_t> words = compile(ShaderStage::fragment, kShading);
    for (auto _ : state) {
        Result<Program> program = decode(words);
        benchmark::DoNotOptimize(program);
    }
}

BENCHMARK(straight_line<float>)->Unit(benchmark::kMillisecond);
BENCHMARK(straight_line<double>)->Unit(benchmark::kMillisecond);
BENCHMARK(decoding)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace gobo::evaluate

BENCHMARK_MAIN();
