// Memory that a stage shares with others, as one invocation sees it: storage blocks, counters, images that
// are read and written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "evaluate_support.hpp"

namespace gobo::evaluate {
namespace {

using Values = std::map<std::string, std::vector<double>, std::less<>>;

constexpr const char* kMemory = R"(
layout(location = 3) flat in int i;
struct Node { vec4 color; float depth; uint next; };
layout(std430, binding = 0) buffer Lists { uint total; int least; Node nodes[]; } lists;
layout(std430, binding = 1) buffer Sums { mat2 m; float few[3]; };
layout(binding = 0, offset = 0) uniform atomic_uint used;
layout(binding = 0, rgba32f) uniform image2D colors;
layout(binding = 1, r32ui) uniform uimage2DArray heads;
)";

struct Case {
    const char* name;
    const char* body;           ///< with a = (10, 20, 30, 40), i = 1, lists.total = 7, lists.least = -3
    std::vector<double> color;  ///< r
    Values left;                ///< what storage holds then
};

const Case kCases[] = {
    {"read_and_written",
     "lists.total += 2u; r = vec4(lists.total, lists.least, 0.0, 0.0);",
     {9, -3, 0, 0},
     {{"Lists.total", {9}}, {"Lists.least", {-3}}}},
    {"an_element_by_an_index",
     "lists.nodes[i].color = a; lists.nodes[i + 1].depth = a.y; r = lists.nodes[1].color;",
     {10, 20, 30, 40},
     {{"Lists.nodes[1].color", {10, 20, 30, 40}},
      {"Lists.nodes[2].depth", {20}},
      {"Lists.nodes[0].depth", {0}}}},
    {"a_value_read_before_a_write_stays",
     "uint before = lists.total; lists.total = 1u; r = vec4(before, lists.total, 0.0, 0.0);",
     {7, 1, 0, 0},
     {{"Lists.total", {1}}}},
    {"the_length_of_an_array_without_a_size", "r = vec4(lists.nodes.length());", {16, 16, 16, 16}, {}},
    {"an_index_beyond_the_elements_evaluated_is_the_last",
     "lists.nodes[i + 99].depth = 5.0; r = vec4(0.0);",
     {0, 0, 0, 0},
     {{"Lists.nodes[15].depth", {5}}}},
    {"columns_and_elements",
     "m[i] = a.xy; m[0][i] = a.z; few[i] = a.w; r = vec4(m[0], m[1]);",
     {0, 30, 10, 20},
     {{"Sums.m", {0, 30, 10, 20}}, {"Sums.few[1]", {40}}}},
    {"sums",
     "r = vec4(atomicAdd(lists.total, 5u), atomicAdd(lists.least, -4), lists.total, lists.least);",
     {7, -3, 12, -7},
     {}},
    {"extremes",
     "uint u = atomicMax(lists.total, 9u); int s = atomicMin(lists.least, 2); r = vec4(u, s, lists.total, "
     "atomicMax(lists.least, 2));",
     {7, -3, 9, -3},
     {{"Lists.least", {2}}}},
    {"bits",
     "atomicAnd(lists.total, 6u); atomicOr(lists.total, 8u); r = vec4(atomicXor(lists.total, 3u));",
     {14, 14, 14, 14},
     {{"Lists.total", {13}}}},
    {"exchanged",
     "r = vec4(atomicExchange(lists.total, 4u), atomicCompSwap(lists.total, 3u, 8u), "
     "atomicCompSwap(lists.total, 4u, 6u), lists.total);",
     {7, 4, 4, 6},
     {}},
    {"of_an_element",
     "atomicAdd(lists.nodes[i].next, 2u); r = vec4(atomicAdd(lists.nodes[i].next, 3u));",
     {2, 2, 2, 2},
     {{"Lists.nodes[1].next", {5}}}},
    {"in_one_branch_only",
     "if (i > 5) lists.total = 0u; else atomicAdd(lists.total, 1u); memoryBarrier(); r = vec4(lists.total);",
     {8, 8, 8, 8},
     {{"Lists.total", {8}}}},
    {"written_before_a_discard",  // GLSL 4.60, 6.4: it stays; llvmpipe 22.3.6 takes it back
     "lists.total = 1u; r = a; if (i > 0) discard; lists.total = 2u;",
     {10, 20, 30, 40},
     {{"Lists.total", {1}}}},
    {"a_counter",
     "uint n = atomicCounterIncrement(used); atomicCounterIncrement(used); r = vec4(n, "
     "atomicCounterDecrement(used), atomicCounter(used), 0.0);",
     {0, 1, 1, 0},
     {{"used", {1}}}},
    {"an_image_is_what_it_was_where_nothing_is_written",
     "imageStore(colors, ivec2(2, 3), a); r = imageLoad(colors, ivec2(1, 3)) + imageLoad(colors, ivec2(2, "
     "3));",
     {11, 23, 30, 41},
     {}},
    {"below_the_first_texel_there_is_nothing", "r = imageLoad(colors, ivec2(i - 2, 3));", {0, 0, 0, 0}, {}},
    {"an_image_of_whole_numbers",
     "uint n = imageAtomicExchange(heads, ivec3(4, 5, i), 9u); r = vec4(n, imageAtomicAdd(heads, ivec3(4, 5, "
     "i), "
     "1u), imageLoad(heads, ivec3(4, 5, 1)).x, imageLoad(heads, ivec3(4, 5, 0)).x);",
     {4, 9, 10, 4},
     {}},
};

constexpr std::size_t kCount = 130;  // several batches: each invocation begins with the same

class Storage : public ::testing::TestWithParam<Case> {};

TEST_P(Storage, IsWhatThisInvocationMakesOfIt) {
    const Program program = fragment_of(GetParam().body, kMemory);
    Invocations invocations;
    invocations.count = kCount;
    invocations.values = {{"a", {10, 20, 30, 40}}, {"i", {1}}};
    for (const auto& [name, number] : {std::pair("Lists.total", 7.0), {"Lists.least", -3.0}})
        if (find_port(program.uniforms, name) != nullptr) invocations.values[name] = {number};
    for (const ImagePort& image : program.images)
        invocations.images[image.name] = [](const ImageRequest& request) {
            return std::array{request.coordinates[0], request.coordinates[1], 0.0, 1.0};
        };
    const Result<Outputs> in_float = run<float>(program, invocations);
    const Result<Outputs> in_double = run<double>(program, invocations);
    for (const auto* const outputs : {&in_float, &in_double}) {
        ASSERT_TRUE(*outputs) << to_text(outputs->error().front());
        for (std::size_t at = 0; at < invocations.count; ++at) {
            for (std::size_t c = 0; c < 4; ++c)
                EXPECT_EQ((*outputs)->values.at("r")[c * kCount + at], GetParam().color[c]) << c;
            for (const auto& [name, numbers] : GetParam().left)
                for (std::size_t c = 0; c < numbers.size(); ++c)
                    EXPECT_EQ((*outputs)->values.at(name)[c * kCount + at], numbers[c]) << name;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Bodies, Storage, ::testing::ValuesIn(kCases),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(Storage, TexelsAreToldInTheOrderOfTheirWrites) {
    const Program program = fragment_of(
        "imageStore(colors, ivec2(2, 3), a); if (i > 0) imageStore(colors, ivec2(2, 3), -a); r = a;",
        kMemory);
    Invocations invocations;
    invocations.count = 2;
    invocations.values = {{"a", {10, 20, 30, 40}}, {"i", {0, 1}}};
    const Result<Outputs> outputs = run<float>(program, invocations);
    ASSERT_TRUE(outputs) << to_text(outputs.error().front());
    std::vector<std::pair<std::size_t, double>> writes;
    for (const WrittenTexel& one : outputs->written) {
        EXPECT_EQ(program.images[one.place.image].name, "colors");
        EXPECT_EQ(one.place.coordinates, (std::array{2, 3, 0, 0}));
        writes.emplace_back(one.place.invocation, one.texel[0]);
    }
    EXPECT_THAT(writes,
                ::testing::ElementsAre(std::pair(0U, 10.0), std::pair(1U, 10.0), std::pair(1U, -10.0)));
}

TEST(Storage, AnArrayWithoutASizeIsAsLongAsAskedFor) {
    const auto words = compile(ShaderStage::fragment, R"(#version 450
layout(std430, binding = 0) buffer Data { vec4 data[]; };
layout(location = 0) flat in int i;
layout(location = 0) out vec4 r;
void main() { r = data[i] + vec4(data[20].x, data.length(), 0, 0); }
)");
    // The largest constant index counts too.
    for (const auto& [asked, given] : {std::pair(16U, 21.0), {30U, 30.0}}) {
        const Result<Program> program = decode(words, {.unstated_length = asked});
        ASSERT_TRUE(program) << to_text(program.error().front());
        EXPECT_THAT(
            output_of<float>(*program,
                             {{"i", {18}}, {"Data.data[18]", {1, 2, 3, 4}}, {"Data.data[20]", {5, 0, 0, 0}}}),
            ::testing::ElementsAre(6, 2 + given, 3, 4));
    }
}

}  // namespace
}  // namespace gobo::evaluate
