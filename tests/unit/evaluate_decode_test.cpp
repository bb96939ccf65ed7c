// Modules that cannot be decoded: each is a diagnostic, none a crash.
#include <random>

#include <gtest/gtest.h>

#include "evaluate_support.hpp"

namespace gobo::evaluate {
namespace {

struct Case {
    const char* name;
    const char* source;
    const char* expected;
};

const Case kCases[] = {
    {"unknown_instruction",
     "#version 450\n#extension GL_ARB_sparse_texture2 : require\nlayout(binding = 0) uniform sampler2D i;\n"
     "layout(location = 0) out vec4 r;\nvoid main() {\n  sparseTextureARB(i, vec2(0), r);\n}\n",
     "test.glsl:6: error: the evaluator does not know OpImageSparseSampleImplicitLod\n"},
    {"unknown_type",
     "#version 450\nlayout(location = 0) out vec4 r;\nvoid main() {\n  double d = 2.0lf;\n  r = "
     "vec4(d);\n}\n",
     "test.glsl:5: error: 64-bit floating-point numbers are evaluated by gobo eval alone: searches compute "
     "in 32 bits\n"},
    {"unknown_type_that_is_not_used",
     "#version 450\nuniform dvec2 d;\nlayout(location = 0) out vec4 r;\nvoid main() {\n  r = vec4(1);\n}\n",
     "gobo: error: 'd': 64-bit floating-point numbers are evaluated by gobo eval alone: searches compute in "
     "32 bits\n"},
    {"element_beyond_a_run_time_array",
     "#version 450\nlayout(std430, binding = 0) buffer B { float b[]; };\nlayout(location = 0) out vec4 "
     "r;\nvoid main() {\n  r = vec4(b[5000]);\n}\n",
     "test.glsl:5: error: 'B.b' has no size, and is evaluated with 16 elements\n"},
};

class Refused : public ::testing::TestWithParam<Case> {};

TEST_P(Refused, WithItsPlace) {
    const Result<Program> program = decode(compile(ShaderStage::fragment, GetParam().source));
    ASSERT_FALSE(program);
    EXPECT_EQ(to_text(program.error().front()), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(Sources, Refused, ::testing::ValuesIn(kCases),
                         [](const auto& one) { return std::string(one.param.name); });

std::string error_of(const std::vector<std::uint32_t>& words) {
    const Result<Program> program = decode(words);
    return program ? "" : to_text(program.error().front());
}

TEST(Refused, WhatIsNoModule) {
    EXPECT_EQ(error_of({}), "gobo: error: malformed SPIR-V module at word 0: it is shorter than a header\n");
    EXPECT_EQ(
        error_of({0x03022307, 0x00000100, 0, 10, 0}),
        "gobo: error: malformed SPIR-V module at word 0: it does not begin with SPIR-V's magic number\n");
    EXPECT_EQ(error_of({0x07230203, 0x00010000, 0, 10, 0}),
              "gobo: error: the SPIR-V module has no vertex or fragment stage\n");
    EXPECT_EQ(error_of({0x07230203, 0x00010000, 0, 0xffffffff, 0}),
              "gobo: error: malformed SPIR-V module at word 0: it claims 4294967295 ids in 5 words\n");
    EXPECT_EQ(error_of({0x07230203, 0x00010000, 0, 10, 0, 0x00040011}),
              "gobo: error: malformed SPIR-V module at word 5: an instruction runs past the end\n");
}

/// A shader with something of everything: loops, calls, blocks, textures, dynamic indices.
const char* const kRich = R"(#version 450
struct Light { vec4 position; vec3 color; float power; };
layout(std140, binding = 1) uniform Lights { int n; Light lights[4]; };
layout(binding = 0) uniform sampler2D tex;
layout(location = 0) in vec3 normal;
layout(location = 0) out vec4 color;
float fall(float d, inout int seen) { if (d > 4.0) return 0.0; ++seen; return 1.0 / (1.0 + d * d); }
void main() {
    vec3 sum = vec3(0.0);
    int seen = 0;
    for (int i = 0; i < n; ++i) {
        vec3 s = lights[i].position.xyz - normal;
        switch (i) { case 1: continue; case 2: sum += 0.5; default: sum *= 0.75; }
        sum += lights[i].color * fall(length(s), seen) * (seen > 2 && s.x > 0.0 ? 2.0 : 1.0);
    }
    if (sum.x < 0.0) discard;
    color = vec4(sum, 1.0) * texture(tex, normal.xy) + transpose(mat4(2.0))[seen & 3];
})";

TEST(Hostile, EveryTruncationIsRefused) {
    const std::vector<std::uint32_t> words = compile(ShaderStage::fragment, kRich);
    ASSERT_TRUE(decode(words));
    for (std::size_t length = 0; length < words.size(); ++length)
        EXPECT_FALSE(decode(std::span(words).first(length))) << length;
}

TEST(Hostile, ChangedWordsNeverCrash) {
    const std::vector<std::uint32_t> words = compile(ShaderStage::fragment, kRich);
    std::mt19937 random(20240607);
    const auto below = [&](std::size_t limit) { return random() % limit; };
    int decoded = 0;
    for (int round = 0; round < 20000; ++round) {
        std::vector<std::uint32_t> changed = words;
        for (std::size_t changes = 1 + below(3); changes > 0; --changes) {
            std::uint32_t& word = changed[5 + below(words.size() - 5)];
            switch (below(4)) {
                case 0:
                    word = static_cast<std::uint32_t>(random());
                    break;
                case 1:
                    word = static_cast<std::uint32_t>(below(words[3]));
                    break;
                case 2:
                    word ^= 1U << below(32);
                    break;
                default:
                    word = changed[5 + below(words.size() - 5)];
                    break;
            }
        }
        const Result<Program> program = decode(changed);
        if (!program) continue;
        ++decoded;
        Invocations invocations;
        for (const ImagePort& image : program->images)
            invocations.images[image.name] = [](const ImageRequest&) { return std::array<double, 4>{}; };
        Options options;
        options.iteration_limit = 100;
        // Whether it ends in values or in an error: it ends.
        (void)run<float>(*program, invocations, options);
    }
    // Some changes are harmless (a decoration, a constant); most are not.
    EXPECT_GT(decoded, 500);
    EXPECT_LT(decoded, 18000);
}

TEST(Bindings, UnknownNamesAndWrongCountsAreErrors) {
    const Program program = fragment_of("r = a;");
    Invocations invocations;
    invocations.values = {{"aa", {1, 2, 3, 4}}};
    Result<Outputs> outputs = run<float>(program, invocations);
    ASSERT_FALSE(outputs);
    EXPECT_EQ(outputs.error().front().message, "the stage has no input or uniform 'aa'");
    EXPECT_EQ(outputs.error().front().help, "did you mean 'a'?");
    invocations.values = {{"a", {1, 2, 3}}};
    invocations.count = 2;
    outputs = run<float>(program, invocations);
    ASSERT_FALSE(outputs);
    EXPECT_EQ(outputs.error().front().message,
              "'a' is a vec4: it takes 4 numbers, or 8 for 2 invocations, not 3");
    invocations.values.clear();
    invocations.blocks["Lights"] = {};
    outputs = run<float>(program, invocations);
    ASSERT_FALSE(outputs);
    EXPECT_EQ(outputs.error().front().message, "the stage has no uniform block 'Lights'");
}

}  // namespace
}  // namespace gobo::evaluate
