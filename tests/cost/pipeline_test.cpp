// SPIR-V as Vulkan takes it, made of what gobo compiles.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <spirv-tools/libspirv.hpp>

#include "cost_support.hpp"
#include "spirv/module.hpp"

namespace gobo::cost {
namespace {

std::string text_of(const std::vector<Descriptor>& descriptors) {
    constexpr const char* kNames[] = {"uniform_buffer", "storage_buffer", "texture",
                                      "texel_buffer",   "image",          "image_buffer",
                                      "bare_texture",   "sampler",        "input_attachment"};
    std::string text;
    for (const Descriptor& descriptor : descriptors)
        text += fmt::format("{} {}\n", kNames[static_cast<int>(descriptor.kind)], descriptor.count);
    return text;
}

const std::vector<Sources> kPipelines = {
    {"NothingBound", kVertex, "#version 450\nout vec4 color;\nvoid main() { color = vec4(1); }\n", ""},
    {"BlockAndSamplerOfOneBinding", kVertex,
     "#version 450\nout vec4 color;\nlayout(binding = 0) uniform sampler2D albedo;\n"
     "layout(std140, binding = 0) uniform Tint { vec4 tint; };\n"
     "void main() { color = tint * texture(albedo, vec2(0.5)); }\n",
     "texture 1\nuniform_buffer 1\n"},
    {"BlockOfBothStages",
     "#version 450\nin vec4 position;\nlayout(std140, binding = 3) uniform Scene { mat4 view; };\n"
     "void main() { gl_Position = view * position; }\n",
     "#version 450\nout vec4 color;\nlayout(std140, binding = 3) uniform Scene { mat4 view; };\n"
     "void main() { color = view[0]; }\n",
     "uniform_buffer 1\n"},
    {"ArraysBuffersImages", kVertex,
     "#version 450\nout vec4 color;\nlayout(binding = 1) uniform sampler2DShadow maps[3];\n"
     "layout(binding = 5) uniform samplerBuffer texels;\nlayout(binding = 0, rgba8) uniform image2D "
     "picture;\n"
     "layout(std430, binding = 0) buffer Counts { uint counts[]; };\n"
     "void main() { color = vec4(texture(maps[1], vec3(0.5))) + texelFetch(texels, 1) + imageLoad(picture, "
     "ivec2(0));\n"
     "  counts[0] = 1u; }\n",
     "storage_buffer 1\ntexture 3\nimage 1\ntexel_buffer 1\n"},
    {"VaryingsByName",
     "#version 450\nin vec4 position;\nout vec3 alpha;\nout mat3 beta;\nout vec2 gamma;\n"
     "void main() { gl_Position = position; alpha = vec3(1); beta = mat3(1); gamma = "
     "vec2(float(gl_VertexID)); }\n",
     "#version 450\nin vec2 gamma;\nin mat3 beta;\nout vec4 color;\n"
     "void main() { color = vec4(gamma, beta[1].x, gl_FragCoord.x); }\n",
     ""},
    {"UniformsOutsideBlocks",
     "#version 450\nin vec4 position;\nlayout(location = 0) uniform mat4 view;\nvoid main() { gl_Position = "
     "view * position; }\n",
     "#version 450\nout vec4 color;\nlayout(location = 1) uniform vec4 tint;\nvoid main() { color = tint; "
     "}\n",
     "uniform_buffer 1\nuniform_buffer 1\n"},
    {"UniformsOfEveryType", kVertex,
     "#version 450\nout vec4 color;\nstruct Light { vec3 position; float weights[2]; mat3 turn; };\n"
     "uniform Light lights[4];\nuniform int count;\nuniform bool lit;\nuniform bvec3 masks;\n"
     "uniform bool flags[3];\nuniform mat2x3 bend;\nuniform float levels[5];\n"
     "layout(binding = 2) uniform sampler2D albedo;\n"
     "void main() {\n  Light last = lights[count];\n"
     "  color = vec4(last.turn * last.position, lights[1].weights[count] + levels[count]);\n"
     "  if (lit && masks.y && flags[count]) color += texture(albedo, bend[1].xy);\n}\n",
     "texture 1\nuniform_buffer 1\n"},
    {"BesideABlock", kVertex,
     "#version 450\nout vec4 color;\nlayout(std140, binding = 1) uniform Tint { vec4 tint; float parts[3]; "
     "};\nuniform float parts_outside[3];\nvoid main() { color = tint * parts[1] * parts_outside[2]; }\n",
     "uniform_buffer 1\nuniform_buffer 1\n"},
    {"SamplersWithinAStruct", kVertex,
     "#version 450\nout vec4 color;\nstruct Material { sampler2D albedo; vec4 tint; };\n"
     "layout(location = 0) uniform Material material;\n"
     "void main() { color = material.tint * texture(material.albedo, vec2(0.5)); }\n",
     "gobo: error: Vulkan has no samplers within structs, and here is one such: material [material]\n"
     "  help: samplers of a struct become variables of their own\n"},
    {"AtomicCounters", kVertex,
     "#version 450\nout vec4 color;\nlayout(binding = 0) uniform atomic_uint hits;\n"
     "void main() { color = vec4(float(atomicCounterIncrement(hits))); }\n",
     "gobo: error: Vulkan has no atomic counters, and here is one: hits [hits]\n"
     "  help: count in a storage block, with atomicAdd()\n"},
    {"InputsOfDoubles",
     "#version 450\nin dvec3 position;\nvoid main() { gl_Position = vec4(position, 1); }\n",
     "#version 450\nout vec4 color;\nvoid main() { color = vec4(1); }\n",
     "gobo: error: vertex input position is a dvec3: only components of 32 bits can be asked about "
     "[position]\n"
     "  help: declare it with floats for the estimate\n"},
    {"BooleansReadAsAWhole", kVertex,
     "#version 450\nout vec4 color;\nstruct Switch { bool on; float by; };\n"
     "layout(location = 0) uniform Switch switches[2];\nlayout(location = 8) uniform int at;\n"
     "void main() { Switch one = switches[at]; color = one.on ? vec4(one.by) : vec4(0); }\n",
     "gobo: error: a uniform outside blocks holds booleans and is read as a whole, which this driver cannot "
     "be "
     "asked about\n  help: make its booleans ints\n"},
    {"OfACompute", "", "", "storage_buffer 1\nuniform_buffer 1\nimage 1\n",
     "#version 450\nlayout(local_size_x = 8, local_size_y = 4) in;\nuniform float gain;\n"
     "layout(binding = 0, rgba8) uniform image2D picture;\nlayout(std430, binding = 0) buffer Sums { vec4 "
     "sums[]; "
     "};\nshared vec4 row[8];\n"
     "void main() {\n  row[gl_LocalInvocationID.x] = gain * imageLoad(picture, "
     "ivec2(gl_GlobalInvocationID));\n"
     "  barrier();\n  sums[gl_WorkGroupID.x] = row[0] + row[7];\n}\n"},
};

class Pipelines : public testing::TestWithParam<Sources> {};

TEST_P(Pipelines, AreWhatVulkanTakes) {
    const auto pipeline = pipeline_of(GetParam());
    if (!pipeline) {
        EXPECT_EQ(to_text(pipeline.error().front()), GetParam().descriptors);
        return;
    }
    EXPECT_EQ(text_of(pipeline->descriptors), GetParam().descriptors);
    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_0);
    std::string said;
    tools.SetMessageConsumer([&](auto, auto, auto, const char* message) { said += message; });
    for (const PipelineStage& stage : pipeline->stages) EXPECT_TRUE(tools.Validate(stage.words)) << said;
}

INSTANTIATE_TEST_SUITE_P(Cost, Pipelines, testing::ValuesIn(kPipelines),
                         [](const auto& sources) { return sources.param.name; });

struct LoopRow {
    std::string name;
    std::string statements;  ///< of main()
    bool varies;
};

class Loops : public testing::TestWithParam<LoopRow> {};

TEST_P(Loops, VaryWhereTheirTurnsAreNotWritten) {
    const Pipeline pipeline =
        pipeline_of(
            {"", "#version 450\nvoid main() { gl_Position = vec4(1); }\n",
             "#version 450\nlayout(location = 0) out vec4 color;\nlayout(constant_id = 3) const int N = 4;\n"
             "layout(std140, binding = 0) uniform S { int count; vec4 tint; };\n"
             "float doubled(float x) { for (int i = 0; i < count; ++i) x += x; return x; }\n"
             "void main() {\n  color = tint;\n  " +
                 GetParam().statements + "\n}\n",
             ""},
            Dialect::vulkan)
            .value();
    EXPECT_FALSE(pipeline.stages[0].loop_varies);
    EXPECT_EQ(pipeline.stages[1].loop_varies, GetParam().varies);
}

INSTANTIATE_TEST_SUITE_P(
    Cost, Loops,
    testing::Values(
        LoopRow{"None", "color += color;", false},
        LoopRow{"ToAConstant", "for (int i = 0; i < 5; ++i) color += color;", false},
        LoopRow{"ToASpecialisedConstant", "for (int i = 0; i < N; ++i) color += color;", false},
        LoopRow{"ToTwiceASpecialisedConstant", "for (int i = 0; i < 2 * N; ++i) color += color;", false},
        LoopRow{"ToAUniformAndASpecialisedConstant", "for (int i = 0; i < count * N; ++i) color += color;",
                true},
        LoopRow{"WithinAnother",
                "for (int i = 0; i < 5; ++i) for (int k = 8; k > 0; k >>= 1) color += color;", false},
        LoopRow{"WithAChoice", "for (int i = 0; i < 5; ++i) if (color.x > 1.0) color += color;", false},
        LoopRow{"ToAUniform", "for (int i = 0; i < count; ++i) color += color;", true},
        LoopRow{"FromAUniform", "for (int i = count; i > 0; i >>= 1) color += color;", true},
        LoopRow{"ByAUniform", "for (int i = 0; i < 8; i += count) color += color;", true},
        LoopRow{"ThatMayBreak", "for (int i = 0; i < 5; ++i) { if (color.x > 1.0) break; color += color; }",
                true},
        LoopRow{"ThatMayReturn", "for (int i = 0; i < 5; ++i) { if (color.x > 1.0) return; color += color; }",
                true},
        LoopRow{"WithABoundAndMore", "for (int i = 0; i < 31 && color.x < 9.0; ++i) color += color;", true},
        LoopRow{"InAFunction", "color.x = doubled(color.y);", true}),
    [](const auto& row) { return row.param.name; });

/// "gamma 4" of each input or output of a module that has a location.
std::map<std::string, std::uint32_t> locations_of(const Words& words, spv::StorageClass storage) {
    const auto module = spirv::read_module(words).value();
    std::map<std::string, std::uint32_t> locations;
    for (const auto& variable : module.variables)
        if (const auto location = module.decoration(variable.id, spv::DecorationLocation);
            location && variable.storage == storage)
            locations[module.name(variable.id)] = *location;
    return locations;
}

TEST(PipelineOf, JoinsVaryingsOfOneName) {
    for (const Sources& sources : kPipelines) {
        if (sources.name != "VaryingsByName") continue;
        const Pipeline pipeline = pipeline_of(sources).value();
        const auto outputs = locations_of(pipeline.stages[0].words, spv::StorageClassOutput);
        const auto inputs = locations_of(pipeline.stages[1].words, spv::StorageClassInput);
        EXPECT_EQ(outputs, (std::map<std::string, std::uint32_t>{{"alpha", 0}, {"beta", 1}, {"gamma", 4}}));
        EXPECT_EQ(inputs, (std::map<std::string, std::uint32_t>{{"beta", 1}, {"gamma", 4}}));
    }
}

TEST(VulkanPipeline, GathersItsResourcesInOneSet) {
    const auto pipeline = pipeline_of(
        {"",
         "#version 450\nlayout(location = 0) in vec4 position;\nvoid main() { gl_Position = position; }\n",
         "#version 450\nlayout(set = 3, binding = 5) uniform sampler2D maps[4];\n"
         "layout(set = 1, binding = 5) uniform texture2D plain;\n"
         "layout(set = 1, binding = 6) uniform sampler filtering;\n"
         "layout(input_attachment_index = 0, set = 0, binding = 0) uniform subpassInput drawn;\n"
         "layout(location = 0) out vec4 color;\n"
         "void main() {\n    color = subpassLoad(drawn) + texture(maps[3], vec2(0.5));\n"
         "    color += texture(sampler2D(plain, filtering), vec2(0.5));\n}\n",
         ""},
        Dialect::vulkan);
    ASSERT_TRUE(pipeline) << to_text(pipeline.error().front());
    EXPECT_EQ(text_of(pipeline->descriptors), "input_attachment 1\nsampler 1\ntexture 4\nbare_texture 1\n");
}

}  // namespace
}  // namespace gobo::cost
