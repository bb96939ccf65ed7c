// What gobo cost is made of: SPIR-V for Vulkan, drivers in processes of their own, figures, baselines. Where
// Mesa's driver is installed, its figures of lit.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spirv-tools/libspirv.hpp>

#include "../shipped_pieces.hpp"
#include "compose/compose.hpp"
#include "core/text.hpp"
#include "family/key.hpp"
#include "family/read_family.hpp"
#include "lab/cost/baseline.hpp"
#include "lab/cost/compile_on_chips.hpp"
#include "lab/cost/nvidia_assembly.hpp"
#include "spirv/module.hpp"
#include "validate/validate.hpp"

namespace gobo::cost {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// --- Pipelines
// -------------------------------------------------------------------------------------------------------

struct Sources {
    std::string name;
    std::string vertex;
    std::string fragment;
    std::string descriptors;  ///< their kinds and counts, or the error
};

/// The two stages of a permutation as gobo compiles them.
Result<Pipeline> pipeline_of(const Family& family, const Composition& composition) {
    const Validated validated = validate(family, composition, {.keep_spirv = true});
    EXPECT_EQ(exit_status(validated.diagnostics), 0) << to_text(validated.diagnostics.front());
    const Permutation& permutation = composition.permutations.front();
    const SpirvModule& vertex = validated.stage(permutation.stages[StageKind::vertex]).spirv;
    const SpirvModule& fragment = validated.stage(permutation.stages[StageKind::fragment]).spirv;
    if (composition.dialect != Dialect::vulkan) return cost::pipeline_of(vertex, fragment);
    Result<Pipeline> pipeline = pipeline_of_vulkan(vertex, fragment);
    for (const SpecializedCount& count : permutation.specialized)
        pipeline.value().constants.emplace_back(count.id, count.value);
    return pipeline;
}

Result<Pipeline> pipeline_of(const Sources& sources, Dialect dialect = Dialect::own) {
    const MemoryFileSystem files({{"a.vert", sources.vertex}, {"a.frag", sources.fragment}});
    SearchPath search;
    const Family family = family_of_files({"a.vert", "a.frag"}, files, search).value();
    return pipeline_of(family, compose(family, {Key{}}, search, dialect).value());
}

std::string text_of(const std::vector<Descriptor>& descriptors) {
    constexpr const char* kNames[] = {"uniform_buffer", "storage_buffer", "texture",
                                      "texel_buffer",   "image",          "image_buffer",
                                      "bare_texture",   "sampler",        "input_attachment"};
    std::string text;
    for (const Descriptor& descriptor : descriptors)
        text += fmt::format("{} {}\n", kNames[static_cast<int>(descriptor.kind)], descriptor.count);
    return text;
}

const std::string kVertex = "#version 450\nin vec4 position;\nvoid main() { gl_Position = position; }\n";

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
    EXPECT_TRUE(tools.Validate(pipeline->vertex)) << said;
    EXPECT_TRUE(tools.Validate(pipeline->fragment)) << said;
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
    EXPECT_EQ(pipeline.fragment_loop_varies, GetParam().varies);
    EXPECT_FALSE(pipeline.vertex_loop_varies);
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
        const auto outputs = locations_of(pipeline.vertex, spv::StorageClassOutput);
        const auto inputs = locations_of(pipeline.fragment, spv::StorageClassInput);
        EXPECT_EQ(outputs, (std::map<std::string, std::uint32_t>{{"alpha", 0}, {"beta", 1}, {"gamma", 4}}));
        EXPECT_EQ(inputs, (std::map<std::string, std::uint32_t>{{"beta", 1}, {"gamma", 4}}));
    }
}

// --- Drivers
// ---------------------------------------------------------------------------------------------------------

Pipeline pipeline_named(const std::string& name) {
    return pipeline_of({"", kVertex,
                        fmt::format("#version 450\nout vec4 {0};\nvoid main() {{ {0} = vec4(1); }}\n", name),
                        ""})
        .value();
}

std::string text_of(const CompiledPipeline& pipeline) {
    return pipeline ? fmt::format(
                          "{} cycles",
                          cost_of(pipeline->front(), chips_named({"navi21"}).value().front(), false).cycles)
                    : pipeline.error();
}

std::vector<Chip> chips_of(const std::vector<std::string>& names) {
    return chips_named(names).value();
}

std::vector<Result<ChipAnswers>> compile(const std::vector<Chip>& chips,
                                         const std::vector<Pipeline>& pipelines, CompileOptions options) {
    options.program = GOBO_LAB;
    return compile_on_chips(DiskFileSystem(), chips, pipelines, options);
}

TEST(FakeDriver, CostsNobodyElseTheirFigures) {
    const std::vector<Pipeline> pipelines = {pipeline_named("fine"),      pipeline_named("abort_here"),
                                             pipeline_named("also_fine"), pipeline_named("hang_here"),
                                             pipeline_named("exit_here"), pipeline_named("refuse_here"),
                                             pipeline_named("fine_again")};
    const auto answers = compile(chips_of({"navi21", "vega10"}), pipelines,
                                 {.driver = GOBO_FAKE_DRIVER, .jobs = 3, .time_limit = 4});
    ASSERT_EQ(answers.size(), 2U);
    for (const auto& answer : answers) {
        ASSERT_TRUE(answer);
        EXPECT_EQ(answer->driver, "fake 1.0");
        std::vector<std::string> texts;
        for (const CompiledPipeline& pipeline : answer->pipelines) texts.push_back(text_of(pipeline));
        EXPECT_THAT(texts, ElementsAre("42 cycles", "was ended by signal 6 (Aborted)", "42 cycles",
                                       "gave no answer within 4 s", "ended with status 0",
                                       "answered vkCreateShaderModule with -2", "42 cycles"));
    }
}

struct BadDriver {
    std::string name;
    std::string chip;
    std::string driver;
    std::string message;
    std::string help = "mesa-vulkan-drivers";
};

class BadDrivers : public testing::TestWithParam<BadDriver> {};

TEST_P(BadDrivers, AreErrorsThatSayWhatToInstall) {
    const auto answers =
        compile(chips_of({GetParam().chip}), {pipeline_named("fine")}, {.driver = GetParam().driver});
    ASSERT_FALSE(answers.front());
    EXPECT_THAT(answers.front().error().front().message, HasSubstr(GetParam().message));
    EXPECT_THAT(answers.front().error().front().help, HasSubstr(GetParam().help));
    EXPECT_EQ(exit_status(answers.front().error()), 3);
}

INSTANTIATE_TEST_SUITE_P(
    Cost, BadDrivers,
    testing::Values(BadDriver{"KnowsNoSuchChip", "tahiti", GOBO_FAKE_DRIVER,
                              "tahiti: the driver was ended by signal 6 (Aborted): fake: unknown chip"},
                    BadDriver{"HasNoDevice", "pitcairn", GOBO_FAKE_DRIVER, "has no device"},
                    BadDriver{"TellsNothing", "bonaire", GOBO_FAKE_DRIVER,
                              "fake 1.0 tells nothing of compiled shaders", "libvulkan_radeon.so"},
                    BadDriver{"IsNotThere", "navi21", "libno_such_driver.so",
                              "navi21: cannot load the Vulkan driver: libno_such"},
                    BadDriver{"IsNoDriver", "navi21", "libm.so.6", "libm.so.6 is no Vulkan driver"}),
    [](const auto& bad) { return bad.param.name; });

using Files = std::map<std::string, std::string, std::less<>>;

struct Place {
    std::string name;
    std::string where;
    Maker maker;
    DriverPlace place;
};

class Places : public testing::TestWithParam<Place> {};

TEST_P(Places, AreFound) {
    const MemoryFileSystem disk(Files{{"debian13/usr/lib/x86_64-linux-gnu/libvulkan_radeon.so", ""},
                                      {"debian13/usr/lib/x86_64-linux-gnu/libvulkan_nouveau.so", ""},
                                      {"debian13/usr/lib/x86_64-linux-gnu/libnouveau_noop_drm_shim.so", ""},
                                      {"debian13/usr/lib/x86_64-linux-gnu/ld-linux-x86-64.so.2", ""},
                                      {"backports/usr/lib/x86_64-linux-gnu/libvulkan_radeon.so", ""}});
    const auto place = find_driver(disk, GetParam().where, GetParam().maker);
    ASSERT_TRUE(place);
    EXPECT_EQ(*place, GetParam().place);
}

const std::string kUnpacked = "debian13/usr/lib/x86_64-linux-gnu";

INSTANTIATE_TEST_SUITE_P(
    Cost, Places,
    testing::Values(Place{"Installed", "", Maker::amd, {"libvulkan_radeon.so"}},
                    Place{"InstalledWithoutAGpu",
                          "",
                          Maker::nvidia,
                          {"libvulkan_nouveau.so", "", "", "libnouveau_noop_drm_shim.so"}},
                    Place{"ALibrary", "./lib/libvulkan_radeon.so", Maker::amd, {"./lib/libvulkan_radeon.so"}},
                    Place{
                        "PackagesWithALibc",
                        "debian13",
                        Maker::amd,
                        {kUnpacked + "/libvulkan_radeon.so", kUnpacked, kUnpacked + "/ld-linux-x86-64.so.2"}},
                    Place{"PackagesOfBoth",
                          "debian13",
                          Maker::nvidia,
                          {kUnpacked + "/libvulkan_nouveau.so", kUnpacked,
                           kUnpacked + "/ld-linux-x86-64.so.2", kUnpacked + "/libnouveau_noop_drm_shim.so"}},
                    Place{"PackagesWithoutALibc",
                          "backports",
                          Maker::amd,
                          {"backports/usr/lib/x86_64-linux-gnu/libvulkan_radeon.so",
                           "backports/usr/lib/x86_64-linux-gnu"}}),
    [](const auto& place) { return place.param.name; });

TEST(Places, OfNoDriverAreErrors) {
    const MemoryFileSystem disk(Files{{"backports/usr/lib/x86_64-linux-gnu/libvulkan_radeon.so", ""}});
    EXPECT_EQ(to_text(find_driver(disk, "backports", Maker::nvidia).error().front()),
              "gobo: error: backports holds no libvulkan_nouveau.so, such as "
              "backports/usr/lib/x86_64-linux-gnu/libvulkan_nouveau.so\n"
              "  help: fetch Mesa's drivers into a folder with tools/fetch_mesa.sh (installed: "
              "share/gobo/tools)\n");
}

TEST(Chips, AreNamedInAnyCaseAndOnce) {
    const auto chips = chips_of({"NAVI21", "navi21", "Vega10"});
    ASSERT_EQ(chips.size(), 2U);
    EXPECT_EQ(chips[0].name, "navi21");
    EXPECT_EQ(to_text(chips_named({"navi-21"}).error().front()),
              "gobo: error: unknown GPU 'navi-21'\n  help: did you mean 'navi21'?\n");
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

// --- Figures
// ---------------------------------------------------------------------------------------------------------

TEST(Assembly, IsCountedByKind) {
    const ByKind kinds = count_kinds(
        "BB0:\n"
        "\tv_interp_p1_f32_e32 v2, v0, attr1.x                         ; c8080400\n"
        "\tv_mul_f32_e32 v0, v0, v1                                    ; 0a000300\n"
        "\tv_rsq_f32_e32 v9, v9                                        ; 7e124909\n"
        "\tv_mov_b32_e32 v5, 0                                         ; 7e0a0280\n"
        "\ts_andn2_b64 exec, s[8:9], exec                              ; 89fe7e08\n"
        "\ts_buffer_load_dwordx4 s[12:15], s[4:7], 0x40                ; c02a0302 00000040\n"
        "\timage_sample v[0:3], v3, s[8:15], s[0:3] dmask:0xf          ; f0800f00 00020003\n"
        "\ts_cbranch_execz BB4                                         ; bf880009\n"
        "BB4:\n"
        "\texp mrt0 v0, v0, v1, v1 done compr vm                       ; c4001c0f 80800100\n"
        "\ts_waitcnt lgkmcnt(0)                                        ; bf8cc07f\n"
        "\ts_endpgm                                                    ; bf810000\n");
    //                        arithmetic, transcendental, interpolation, move, scalar, memory, texture,
    //                        branch, output, wait
    EXPECT_EQ(kinds, (ByKind{1, 1, 1, 1, 1, 1, 1, 2, 1, 1}));
}

TEST(Assembly, HasALoopWhereItBranchesBack) {
    EXPECT_FALSE(branches_back("BB0:\n\ts_cbranch_scc0 BB2\nBB1:\n\ts_branch BB2\nBB2:\n\ts_endpgm\n"));
    EXPECT_TRUE(branches_back(
        "BB0:\n\ts_nop 0\nBB1:\n\ts_cbranch_scc1 BB3\nBB2:\n\ts_branch BB1 ; bf82ffe9\nBB3:\n"));
    EXPECT_TRUE(branches_back("BB0:\nBB1:\n\ts_cbranch_scc1 BB1\n"));
}

/// As NVK prints: two blocks of which the second is a loop.
const char* const kNvidia =
    "==== NAK assembly\n"
    "block.u 0 L1 [] -> {\n"
    "      r0      = ipa.pass a[0x7c] rZ                // delay=6 wr:0\n"
    "      r0      = mufu.rcp r0                        // delay=1 wt=000001 wr:0\n"
    "      r1..3   = ldc.b64 c[0x1][+0x100]             // delay=6 wr:1\n"
    "      ur3     = ldc.b32 c[0x1][+0x104]             // delay=12 wr:0\n"
    "      ur1     = iadd3 ur3 0x1 rZ                   // delay=2\n"
    "} -> [1]\n"
    "block 1 L2 [0, 1] -> {\n"
    "      r1      = ffma.ftz r1 r0 r2                  // delay=4\n"
    "      r2      = fmnmx.ftz r1 rZ pF                 // delay=4\n"
    "      r3      = mov 0x10                           // delay=1\n"
    "      r3      = tex.b32 r1 r2                      // delay=1\n"
    "@!p0            bra L2                             // delay=1\n"
    "} -> [1, 2]\n"
    "block.u 2 L3 [1] -> {\n"
    "                exit                               // delay=1\n"
    "} -> []\n\n";

TEST(NvidiaAssembly, IsCountedByKind) {
    const NvidiaCode code = read_nvidia_assembly(kNvidia, "Ampere");
    //                        arithmetic, transcendental, interpolation, move, scalar, memory, texture,
    //                        branch, output, wait
    EXPECT_EQ(code.kinds, (ByKind{2, 1, 1, 1, 1, 2, 1, 2, 0, 0}));
    EXPECT_EQ(code.latency, 39U);
    EXPECT_EQ(code.uniform_registers, 4U);
    EXPECT_TRUE(code.has_loop);
    // Eleven are issued; two of the slow units take 32 / 4 cycles each.
    EXPECT_EQ(code.cycles, 16U);
    EXPECT_EQ(read_nvidia_assembly(kNvidia, "Pascal").cycles, 11U) << "whose slow units take 32 / 8";
}

TEST(NvidiaAssembly, HasNoLoopWhereBlocksFollowEachOther) {
    EXPECT_FALSE(
        read_nvidia_assembly("block 0 L1 [] -> {\n} -> [1, 2]\nblock 1 L2 [0] -> {\n} -> [2]\n", "Ampere")
            .has_loop);
}

TEST(NvidiaAssembly, KeepsAsManyWarpsAsItsRegistersAllow) {
    EXPECT_EQ(nvidia_occupancy(16, "Ampere"), 12U);
    EXPECT_EQ(nvidia_occupancy(46, "Ampere"), 10U);
    EXPECT_EQ(nvidia_occupancy(255, "Ampere"), 2U);
    EXPECT_EQ(nvidia_occupancy(40, "Turing"), 8U);
}

/// One key on one chip, one stage.
std::vector<ChipCost> costs(std::uint64_t instructions, std::uint64_t registers, std::uint64_t cycles,
                            bool has_loop, const std::string& driver = "radv Mesa 1") {
    StageCost stage;
    stage.stage = "fragment";
    stage.instructions = instructions;
    stage.vector_registers = registers;
    stage.cycles = cycles;
    stage.has_loop = has_loop;
    stage.kinds[0] = instructions;
    return {{chips_of({"navi21"}).front(), driver, {{"fog=linear", {stage}}}}};
}

struct Growth {
    std::string name;
    std::vector<ChipCost> now;
    std::string text;  ///< the messages
};

class Baselines : public testing::TestWithParam<Growth> {};

TEST_P(Baselines, SayWhatHasGrown) {
    const CsvTable baseline = to_table(costs(100, 24, 500, false));
    const auto comparison = compare_with_baseline(GetParam().now, baseline, "costs.csv", 2);
    std::string text;
    for (const Diagnostic& diagnostic : comparison ? comparison->diagnostics : comparison.error())
        text += to_text(diagnostic);
    EXPECT_EQ(text, GetParam().text);
}

std::vector<ChipCost> renamed(std::vector<ChipCost> all, const std::string& key) {
    all.front().keys.front().key = key;
    return all;
}

std::vector<ChipCost> with_another_key(std::vector<ChipCost> all) {
    all.front().keys.push_back({"fog=exponential", all.front().keys.front().stages});
    return all;
}

INSTANTIATE_TEST_SUITE_P(
    Cost, Baselines,
    testing::Values(
        Growth{"Nothing", costs(100, 24, 500, false), ""},
        Growth{"WithinTheTolerance", costs(102, 24, 510, false), ""},
        Growth{"Less", costs(50, 16, 200, false), ""},
        Growth{"Instructions", costs(103, 24, 500, false),
               "gobo: error: the fragment stage has grown on navi21: instructions 100 -> 103 (+3.0 %) "
               "[fog=linear]\n"
               "  help: arithmetic +3 instructions; if that is meant, write it anew with --update\n"},
        Growth{"RegistersAndCycles", costs(100, 32, 600, false),
               "gobo: error: the fragment stage has grown on navi21: VGPRs 24 -> 32 (+33.3 %), cycles 500 -> "
               "600 "
               "(+20.0 %) [fog=linear]\n  help: if that is meant, write it anew with --update\n"},
        Growth{"CyclesOfALoop", costs(100, 24, 5000, true), ""},
        Growth{"AnotherDriver", costs(100, 24, 500, false, "radv Mesa 2"),
               "costs.csv: error: its figures of navi21 are from radv Mesa 1, and here is radv Mesa 2: two "
               "versions' "
               "estimates cannot be compared\n  help: write it anew with --update\n"},
        Growth{"OnlyAnotherKey", renamed(costs(100, 24, 500, false), "point=1"),
               "costs.csv: error: it holds nothing of what was measured, such as the fragment stage of "
               "'point=1' on "
               "navi21\n  help: write it anew with --update\n"},
        Growth{"AKeyMore", with_another_key(costs(100, 24, 500, false)),
               "costs.csv: error: it lacks the fragment stage of 'fog=exponential' on navi21\n"
               "  help: write it anew with --update\n"}),
    [](const auto& growth) { return growth.param.name; });

TEST(Baseline, TellsOfWhatIsNoLongerMeasured) {
    const CsvTable baseline = to_table(with_another_key(costs(100, 24, 500, false)));
    const auto now = costs(100, 24, 500, false);
    const auto comparison = compare_with_baseline(now, baseline, "costs.csv", 2);
    ASSERT_TRUE(comparison);
    ASSERT_EQ(comparison->diagnostics.size(), 1U);
    EXPECT_EQ(to_text(comparison->diagnostics.front()),
              "costs.csv: note: it also holds what was not measured now: the fragment stage of "
              "'fog=exponential' on navi21\n");
    EXPECT_EQ(rows_lost(baseline, to_table(now)), 1U);
    EXPECT_EQ(rows_lost(to_table(now), baseline), 0U);
    EXPECT_EQ(rows_lost(read_csv("no,table\n1,2\n"), baseline), 0U);
}

TEST(Baseline, LeavesOutCyclesThatWereGuessed) {
    const CsvTable guessed = to_table(costs(100, 24, 300, true));
    const auto comparison = compare_with_baseline(costs(100, 24, 500, false), guessed, "costs.csv", 2);
    ASSERT_TRUE(comparison);
    EXPECT_EQ(comparison->grown, 0U);
}

TEST(Baseline, IsReadAsItIsWritten) {
    EXPECT_EQ(to_text(compare_with_baseline({}, read_csv("gpu,key\n"), "costs.csv", 0).error().front()),
              "costs.csv:1: error: there is no column 'stage'\n  help: write it anew with --update\n");
    CsvTable wrong = to_table(costs(1, 2, 3, false));
    for (const char* cell : {"many", "nan", "inf", "67.5", "-1", "1e3", ""}) {
        wrong.rows[0][*wrong.column("cycles")] = cell;
        const auto comparison = compare_with_baseline({}, wrong, "costs.csv", 0);
        ASSERT_FALSE(comparison) << cell;
        EXPECT_EQ(to_text(comparison.error().front()),
                  fmt::format("costs.csv:2: error: '{}' is no whole number of cycles\n"
                              "  help: write it anew with --update\n",
                              cell));
    }
}

TEST(Cycles, StandSideBySide) {
    std::vector<ChipCost> all = with_another_key(costs(100, 24, 500, false));
    all.push_back({chips_of({"gfx1201"}).front(), "radv Mesa 2", costs(80, 24, 50, true).front().keys});
    EXPECT_EQ(cycles_text(all),
              "navi21 (RDNA2), radv Mesa 1\n"
              "gfx1201 (RDNA4), radv Mesa 2\n"
              "navi21  gfx1201  stage     key\n"
              "   500      *50  fragment  fog=linear\n"
              "   500           fragment  fog=exponential\n"
              "* with a loop, of which the compiler guesses how often it runs\n");
}

TEST(Differences, AreToldByFigureAndKind) {
    std::vector<ChipCost> all = costs(100, 24, 500, false);
    all.front().keys.push_back(renamed(costs(90, 24, 400, false), "fog=none").front().keys.front());
    EXPECT_EQ(difference_text(all, "fog=linear", "fog=none"),
              "navi21, fragment stage\n"
              "  instructions    100 ->    90    -10  -10.0 %\n"
              "  cycles          500 ->   400   -100  -20.0 %\n"
              "  instructions by kind: arithmetic -10\n");
}

// --- Mesa's driver
// ---------------------------------------------------------------------------------------------------

/// Figures of lit on two chips by Mesa's own driver, where it is there.
class Mesa : public testing::Test {
  protected:
    static std::vector<Pipeline> pipelines_of(const std::vector<std::string>& texts,
                                              Dialect dialect = Dialect::own) {
        const DiskFileSystem disk;
        const Family family =
            read_family(disk.read(GOBO_SOURCE_DIR "/templates/lit.toml").value(), "templates/lit.toml")
                .value();
        SearchPath search = shipped_pieces();
        search.add(disk, GOBO_SOURCE_DIR "/templates", "templates/", false);
        std::vector<Pipeline> pipelines;
        for (const std::string& text : texts) {
            const Key key = canonical(family, parse_key(family, text).value(), "450");
            const Composition composition = compose(family, {key}, search, dialect).value();
            pipelines.push_back(pipeline_of(family, composition).value());
        }
        return pipelines;
    }

    /// By chip and pipeline the stages.
    static std::vector<std::vector<std::vector<StageCost>>> costs_of(const std::vector<Pipeline>& pipelines,
                                                                     int jobs) {
        std::vector<std::vector<std::vector<StageCost>>> all;
        const auto chips = chips_of({"navi21", "polaris10"});
        const auto answers = compile(chips, pipelines, {.jobs = jobs});
        for (std::size_t i = 0; i < chips.size(); ++i) {
            auto& chip = all.emplace_back();
            for (const CompiledPipeline& pipeline : answers[i].value().pipelines) {
                auto& stages = chip.emplace_back();
                for (const CompiledStage& stage : pipeline.value())
                    stages.push_back(cost_of(stage, chips[i], false));
            }
        }
        return all;
    }

    void SetUp() override {
        const auto answers = compile(chips_of({"navi21"}), {}, {});
        // Mesa's driver for AMD's chips is optional: tools/setup.sh installs it, other systems may lack it.
        if (!answers.front()) GTEST_SKIP() << "SKIPPED: " << to_text(answers.front().error().front());
    }
};

TEST_F(Mesa, CountsWhatItPrints) {
    for (const auto& chip : costs_of(pipelines_of({"point=2 specular=blinn"}), 1))
        for (const StageCost& stage : chip.front()) {
            std::uint64_t sum = 0;
            for (const std::uint64_t count : stage.kinds) sum += count;
            EXPECT_EQ(sum, stage.instructions) << stage.assembly;
            EXPECT_GT(stage.cycles, 0U);
            EXPECT_GT(stage.vector_registers, 0U);
            EXPECT_GT(stage.occupancy, 0U);
            EXPECT_GT(stage.code_bytes, 0U);
        }
}

TEST_F(Mesa, ChargesMoreForMore) {
    const std::vector<std::string> keys = {"default", "point=1", "point=2", "point=2 specular=blinn",
                                           "point=2 specular=blinn fog=exponential"};
    for (const auto& chip : costs_of(pipelines_of(keys), 2))
        for (std::size_t i = 1; i < chip.size(); ++i) {
            EXPECT_GT(chip[i][1].cycles, chip[i - 1][1].cycles) << keys[i];
            EXPECT_GT(chip[i][1].instructions, chip[i - 1][1].instructions) << keys[i];
        }
}

TEST_F(Mesa, AnswersTheSameEachTime) {
    std::vector<std::string> keys;
    for (const char* fog : {"none", "linear", "exponential"})
        for (int point = 0; point < 6; ++point) keys.push_back(fmt::format("fog={} point={}", fog, point));
    const auto pipelines = pipelines_of(keys);
    EXPECT_EQ(costs_of(pipelines, 1), costs_of(pipelines, 2));
}

/// Other places, and counts as constants of the pipeline: it is the same work.
TEST_F(Mesa, ChargesTheSameByTheDialectVulkan) {
    const std::vector<std::string> keys = {"default", "point=1", "point=3 specular=blinn",
                                           "directional=1 directional_shadows=1 fog=linear"};
    EXPECT_EQ(costs_of(pipelines_of(keys), 2), costs_of(pipelines_of(keys, Dialect::vulkan), 2));
}

/// Uniforms outside blocks cost what the same uniforms cost in a block that the source declares.
TEST_F(Mesa, TakesPlainUniformsAsABlock) {
    const std::string use =
        "\nout vec4 color;\nvoid main() {\n  color = tint * levels[2] + turn[1].xyzz;\n"
        "  for (int i = 0; i < count; ++i) color *= color;\n}\n";
    const std::string members = "vec4 tint; float levels[3]; mat3 turn; int count;";
    std::string loose;
    for (const std::string& member : split(members, ';')) loose += "uniform " + member + "; ";
    const auto stages = costs_of(
        {pipeline_of({"", kVertex, "#version 450\n" + loose + use, ""}).value(),
         pipeline_of(
             {"", kVertex, "#version 450\nlayout(std140) uniform Settings { " + members + " };" + use, ""})
             .value()},
        1);
    for (const auto& chip : stages) EXPECT_EQ(chip[0], chip[1]);
}

TEST_F(Mesa, SaysThatItDoesNotKnowAChip) {
    const auto answers = compile({Chip{"navi99", "", ""}}, {}, {});
    EXPECT_THAT(answers.front().error().front().message,
                HasSubstr("navi99: the driver was ended by signal 6"));
}

}  // namespace
}  // namespace gobo::cost
