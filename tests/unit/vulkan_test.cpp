// The dialects that ship SPIR-V: where Vulkan binds what a stage declares, and counts as specialisation
// constants.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compose/compose.hpp"
#include "compose/dialect.hpp"
#include "core/text.hpp"
#include "family/key.hpp"
#include "reflect/reflect.hpp"
#include "small_families.hpp"
#include "spirv/transform.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A family whose templates are given, composed for keys and validated.
struct Built {
    Family family;
    Composition composition;
    Validated validated;
};

Built built(const std::string& body, const std::string& vertex, const std::string& fragment,
            const std::vector<std::string>& keys, Dialect dialect = Dialect::vulkan) {
    Built result;
    result.family = family_of(body);
    MemoryFileSystem files;
    files.write("tiny.vert", vertex);
    files.write("tiny.frag", fragment);
    files.write("lamp/lamp.glsl", "void addLamps() {}\n");
    SearchPath search;
    search.add(files, "", "", false);
    std::vector<Key> list;
    for (const std::string& key : keys) list.push_back(parse_key(result.family, key).value());
    auto composition = compose(result.family, list, search, dialect);
    EXPECT_TRUE(composition) << (composition ? "" : first_text(composition.error()));
    result.composition = composition.value();
    result.validated = validate(result.family, result.composition, {.keep_spirv = true});
    EXPECT_EQ(first_text(result.validated.diagnostics), "");
    return result;
}

const std::string kVertex = "void main() { gl_Position = vec4(float(gl_VertexID), 0.0, 0.0, 1.0); }\n";

std::string fragment_of(const Built& built, std::size_t permutation = 0) {
    const int stage = built.composition.permutations[permutation].stages[StageKind::fragment];
    return source_of(built.composition, built.composition.stage(stage));
}

TEST(VulkanPrologue, PlacesWhatTheStageDeclares) {
    const Built tiny = built(
        "[[descriptor_sets]]\nname = \"frame\"\nholds = [\"Fog\", \"shadows\"]\n"
        "[[descriptor_sets]]\nname = \"object\"\nholds = [\"Unused\", \"Transform\"]\n",
        kVertex,
        "BLOCK(3, Transform) { vec4 a; } transform;\nBLOCK(7, Other) { vec4 a; } other;\n"
        "SAMPLER(3, sampler2D) shadows;\nOUTPUT(0) vec4 color;\n"
        "void main() { color = transform.a + other.a + texture(shadows, vec2(0.0)); }\n",
        {"default"});
    EXPECT_THAT(fragment_of(tiny),
                testing::StartsWith(
                    "#version 450\n"
                    "#define PLACE_Other set = 0, binding = 7\n"
                    "#define PLACE_Transform set = 1, binding = 1\n"
                    "#define PLACE_OF_SAMPLER_3 set = 0, binding = 1\n"
                    "#define BLOCK(binding_, name_) layout(std140, PLACE_##name_) uniform name_\n"
                    "#define OUTPUT(location_) layout(location = location_) out\n"
                    "#define SAMPLER(binding_, type_) layout(PLACE_OF_SAMPLER_##binding_) uniform type_\n"));
    const Interface interface = interface_of(tiny.validated, tiny.composition.permutations[0]);
    ASSERT_EQ(interface.blocks.size(), 2u);
    EXPECT_EQ(interface.blocks[0].set, 0);
    EXPECT_EQ(interface.blocks[0].binding, 7);
    EXPECT_EQ(interface.blocks[1].set, 1);
    EXPECT_EQ(interface.blocks[1].binding, 1);
    ASSERT_EQ(interface.samplers.size(), 1u);
    EXPECT_EQ(interface.samplers[0].set, 0);
    EXPECT_EQ(interface.samplers[0].binding, 1);
}

TEST(VulkanPrologue, CountsVerticesByVulkansName) {
    const Built tiny =
        built("", kVertex, "OUTPUT(0) vec4 color;\nvoid main() { color = vec4(1.0); }\n", {"default"});
    const int stage = tiny.composition.permutations[0].stages[StageKind::vertex];
    EXPECT_THAT(source_of(tiny.composition, tiny.composition.stage(stage)),
                HasSubstr("float(gl_VertexIndex)"));
}

TEST(VulkanInterface, HasPushConstantsApartFromBlocks) {
    const Built tiny = built("", kVertex,
                             "layout(push_constant) uniform Tint { vec4 tint; } pushed;\n"
                             "OUTPUT(0) vec4 color;\nvoid main() { color = pushed.tint; }\n",
                             {"default"});
    const Interface interface = interface_of(tiny.validated, tiny.composition.permutations[0]);
    EXPECT_THAT(interface.blocks, IsEmpty());
    ASSERT_EQ(interface.push_constants.size(), 1u);
    EXPECT_EQ(interface.push_constants[0].name, "Tint");
    EXPECT_EQ(interface.push_constants[0].size, 16);
}

struct PushedRow {
    const char* name;
    const char* vertex;               ///< its push constants
    const char* fragment;             ///< its own
    const char* value;                ///< made of those
    std::vector<std::string> pushed;  ///< block, members with offsets, stages
};

/// To Vulkan the push constants of stages are views of one memory; glslang compares them as it links.
class PushConstantsOfStages : public testing::TestWithParam<PushedRow> {};

TEST_P(PushConstantsOfStages, AreTheirOwn) {
    const PushedRow& row = GetParam();
    const Built tiny = built(
        "", std::string(row.vertex) + "void main() { gl_Position = place; }\n",
        fmt::format("{}OUTPUT(0) vec4 color;\nvoid main() {{ color = {}; }}\n", row.fragment, row.value),
        {"default"});
    const Interface interface = interface_of(tiny.validated, tiny.composition.permutations[0]);
    std::vector<std::string> pushed;
    for (const Block& block : interface.push_constants) {
        std::string& text = pushed.emplace_back(block.name);
        for (const Member& member : block.members) text += fmt::format(" {}@{}", member.name, member.offset);
        text += " " + join(block.stages, "+");
    }
    EXPECT_EQ(pushed, row.pushed);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, PushConstantsOfStages,
    testing::Values(
        PushedRow{"alike",
                  "layout(push_constant) uniform Pushed { vec4 place; };\n",
                  "layout(push_constant) uniform Pushed { vec4 place; };\n",
                  "place",
                  {"Pushed place@0 vertex+fragment"}},
        PushedRow{"behind_each_other",
                  "layout(push_constant) uniform Pushed { vec4 place; } own;\n#define place own.place\n",
                  "layout(push_constant) uniform Pushed { layout(offset = 64) vec4 tint; } own;\n",
                  "own.tint",
                  {"Pushed place@0 vertex", "Pushed tint@64 fragment"}},
        PushedRow{"views_of_the_same_bytes",
                  "layout(push_constant) uniform Pushed { vec4 place; };\n",
                  "layout(push_constant) uniform Pushed { float shine, rest[3]; };\n",
                  "vec4(shine + rest[1])",
                  {"Pushed place@0 vertex", "Pushed shine@0 rest@4 fragment"}},
        PushedRow{"members_of_one_name",
                  "layout(push_constant) uniform Pushed { vec4 place; };\n",
                  "layout(push_constant) uniform Tints { layout(offset = 16) vec4 place; };\n",
                  "place",
                  {"Pushed place@0 vertex", "Tints place@16 fragment"}}),
    [](const auto& row) { return std::string(row.param.name); });

struct ResourceRow {
    const char* name;
    const char* vertex;    ///< declares what gives `place`
    const char* fragment;  ///< declares what gives `tint`
    std::vector<std::string> resources;
    const char* message = "";
};

/// Vulkan knows a resource by its set and binding, whatever a stage calls it.
class ResourcesOfStages : public testing::TestWithParam<ResourceRow> {};

TEST_P(ResourcesOfStages, MatchByTheirPlaces) {
    const ResourceRow& row = GetParam();
    MemoryFileSystem files;
    files.write("tiny.vert", fmt::format("{}\nvoid main() {{ gl_Position = place; }}\n", row.vertex));
    files.write("tiny.frag", fmt::format("{}\nlayout(location = 0) out vec4 color;\n"
                                         "void main() {{ color = tint; }}\n",
                                         row.fragment));
    SearchPath search;
    const Family family = family_of_files({"tiny.vert", "tiny.frag"}, files, search).value();
    const Composition composition = compose(family, {Key{}}, search, Dialect::vulkan).value();
    const Validated validated = validate(family, composition, {.spirv_val = true});
    const std::string text = first_text(validated.diagnostics);
    EXPECT_EQ(text.substr(0, text.find(" [")), row.message);
    if (text.find("error") != std::string::npos) return;
    const Interface interface = interface_of(validated, composition.permutations[0]);
    std::vector<std::string> resources;
    const auto add = [&](const auto& list) {
        for (const auto& entry : list)
            resources.push_back(
                fmt::format("{} {}.{} {}", entry.name, entry.set, entry.binding, join(entry.stages, "+")));
    };
    add(interface.blocks);
    add(interface.storage_blocks);
    add(interface.samplers);
    EXPECT_EQ(resources, row.resources);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, ResourcesOfStages,
    testing::Values(
        ResourceRow{"blocks_of_one_name",
                    "layout(set = 0, binding = 0) uniform UBO { mat4 m; } ubo;\n#define place ubo.m[0]",
                    "layout(set = 0, binding = 1) uniform UBO { vec4 t; } ubo;\n#define tint ubo.t",
                    {"UBO 0.0 vertex", "UBO 0.1 fragment"}},
        ResourceRow{"blocks_of_one_name_and_layout",
                    "layout(binding = 0) uniform UBO { vec4 t; } ubo;\n#define place ubo.t",
                    "layout(set = 1, binding = 0) uniform UBO { vec4 t; } ubo;\n#define tint ubo.t",
                    {"UBO 0.0 vertex", "UBO 1.0 fragment"}},
        ResourceRow{"one_block",
                    "layout(binding = 0) uniform UBO { vec4 t; } ubo;\n#define place ubo.t",
                    "layout(binding = 0) uniform UBO { vec4 t; } of_light;\n#define tint of_light.t",
                    {"UBO 0.0 vertex+fragment"}},
        ResourceRow{"members_of_blocks_without_instance",
                    "layout(binding = 0) uniform Camera { vec4 place; vec4 tint; };",
                    "layout(binding = 1) uniform Light { float more; vec4 tint; };",
                    {"Camera 0.0 vertex", "Light 0.1 fragment"}},
        ResourceRow{"storage_and_uniform_of_one_name",
                    "layout(binding = 0) readonly buffer Values { vec4 all[]; } v;\n#define place v.all[1]",
                    "layout(binding = 1) uniform Values { vec4 one; } v;\n#define tint v.one",
                    {"Values 0.1 fragment", "Values 0.0 vertex"}},
        ResourceRow{"samplers_of_one_name",
                    "layout(binding = 0) uniform highp sampler2D map;\n#define place textureLod(map, "
                    "vec2(0.0), 0.0)",
                    "layout(binding = 1) uniform samplerCube map;\n#define tint texture(map, vec3(1.0))",
                    {"map 0.0 vertex", "map 0.1 fragment"}},
        ResourceRow{"sampler_called_as_a_block",
                    "layout(binding = 0) uniform sampler2D map;\n#define place textureLod(map, vec2(0.0), "
                    "0.0)",
                    "layout(binding = 1) uniform map { vec4 t; } inside;\n#define tint inside.t",
                    {"map 0.1 fragment", "map 0.0 vertex"}},
        ResourceRow{"two_names_at_one_place",
                    "layout(binding = 1) uniform sampler2D heights;\n#define place textureLod(heights, "
                    "vec2(0.0), 0.0)",
                    "layout(binding = 1) uniform sampler2D displacement;\n#define tint "
                    "texture(displacement, vec2(0.0))",
                    {"displacement 0.1 fragment", "heights 0.1 vertex"}},
        ResourceRow{"two_views_of_one_buffer",
                    "layout(binding = 0) uniform UBO { mat4 m; vec4 t; } ubo;\n#define place ubo.t",
                    "layout(binding = 0) uniform Camera { mat4 m; } camera;\n#define tint camera.m[0]",
                    {"Camera 0.0 fragment", "UBO 0.0 vertex"}},
        ResourceRow{"the_beginning_of_a_block",
                    "layout(binding = 0) uniform UBO { mat4 m; vec4 t; } ubo;\n#define place ubo.t",
                    "layout(binding = 0) uniform UBO { mat4 m; } ubo;\n#define tint ubo.m[0]",
                    {"UBO 0.0 vertex", "UBO 0.0 fragment"}},
        ResourceRow{"other_members_of_one_name_and_place",
                    "layout(binding = 0) uniform UBO { mat4 m; } ubo;\n#define place ubo.m[0]",
                    "layout(binding = 0) uniform UBO { vec4 t; } ubo;\n#define tint ubo.t",
                    {"UBO 0.0 vertex", "UBO 0.0 fragment"},
                    "tiny.frag:1: warning: the uniform block 'UBO' is at set 0, binding 0, with other "
                    "members than in tiny.vert:1: both read the same buffer"},
        ResourceRow{"block_and_sampler_at_one_place",
                    "layout(binding = 0) uniform UBO { vec4 t; } ubo;\n#define place ubo.t",
                    "layout(binding = 0) uniform sampler2D map;\n#define tint texture(map, vec2(0.0))",
                    {},
                    "tiny.frag:1: error: the sampler 'map' is at set 0, binding 0, where tiny.vert:1 binds "
                    "'UBO'"},
        ResourceRow{"uniform_and_storage_block_at_one_place",
                    "layout(binding = 0) uniform UBO { vec4 t; } ubo;\n#define place ubo.t",
                    "layout(binding = 0) readonly buffer UBO { vec4 t; } ubo;\n#define tint ubo.t",
                    {},
                    "tiny.frag:1: error: the storage block 'UBO' is at set 0, binding 0, where tiny.vert:1 "
                    "binds 'UBO'"},
        ResourceRow{"shapes_at_one_place",
                    "layout(binding = 0) uniform sampler2D map;\n#define place textureLod(map, vec2(0.0), "
                    "0.0)",
                    "layout(binding = 0) uniform samplerCube sky;\n#define tint texture(sky, vec3(1.0))",
                    {},
                    "tiny.frag:1: error: the sampler 'sky' is at set 0, binding 0, as samplerCube, where "
                    "tiny.vert:1 binds 'map' as sampler2D"},
        ResourceRow{"sizes_at_one_place",
                    "layout(binding = 0) uniform UBO { vec4 t; } ubo[2];\n#define place ubo[1].t",
                    "layout(binding = 0) uniform UBO { vec4 t; } ubo[3];\n#define tint ubo[2].t",
                    {},
                    "tiny.frag:1: error: the uniform block 'UBO' is at set 0, binding 0, as block[3], where "
                    "tiny.vert:1 binds 'UBO' as block[2]"},
        ResourceRow{"two_in_one_stage",
                    "layout(binding = 0) uniform UBO { vec4 t; } ubo;\n#define place ubo.t",
                    "layout(binding = 1) uniform A { vec4 t; } a;\n"
                    "layout(binding = 1) uniform B { vec4 t; } b;\n#define tint (a.t + b.t)",
                    {},
                    "tiny.frag:2: error: the uniform block 'B' is at set 0, binding 1, where tiny.frag:1 "
                    "binds 'A'"}),
    [](const auto& row) { return std::string(row.param.name); });

struct PerVertexRow {
    const char* name;
    const char* vertex;    ///< declares and writes an output
    const char* fragment;  ///< declares an input and the value `tint` of it
    const char* message = "";
};

/// GL_EXT_fragment_shader_barycentric: an input has an element for each vertex of the triangle.
class PerVertexInput : public testing::TestWithParam<PerVertexRow> {};

TEST_P(PerVertexInput, MatchesTheOutputWithoutTheArray) {
    const PerVertexRow& row = GetParam();
    MemoryFileSystem files;
    files.write("tiny.vert", fmt::format("{} gl_Position = vec4(1.0); }}\n", row.vertex));
    files.write("tiny.frag", fmt::format("#extension GL_EXT_fragment_shader_barycentric : require\n{}\n"
                                         "layout(location = 0) out vec4 color;\n"
                                         "void main() {{ color = vec4(tint * gl_BaryCoordEXT, 1.0); }}\n",
                                         row.fragment));
    SearchPath search;
    const Family family = family_of_files({"tiny.vert", "tiny.frag"}, files, search).value();
    const Composition composition = compose(family, {Key{}}, search, Dialect::vulkan).value();
    const std::string text = first_text(validate(family, composition, {.spirv_val = true}).diagnostics);
    EXPECT_EQ(text.substr(0, text.find(" [default]")), row.message);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, PerVertexInput,
    testing::Values(
        PerVertexRow{"vector", "layout(location = 0) out vec3 tone; void main() { tone = vec3(1.0);",
                     "layout(location = 0) pervertexEXT in vec3 tone[];\n#define tint tone[2]"},
        PerVertexRow{"array_of_stated_size",
                     "layout(location = 0) out vec3 tone[2]; void main() { tone[0] = tone[1] = vec3(1.0);",
                     "layout(location = 0) pervertexEXT in vec3 tone[3][2];\n#define tint tone[2][1]"},
        PerVertexRow{"block",
                     "layout(location = 0) out Surface { vec3 tone; } s; void main() { s.tone = vec3(1.0);",
                     "layout(location = 0) pervertexEXT in Surface { vec3 tone; } s[];\n"
                     "#define tint s[1].tone"},
        PerVertexRow{"of_another_type", "layout(location = 0) out vec2 tone; void main() { tone = vec2(1.0);",
                     "layout(location = 0) pervertexEXT in vec3 tone[];\n#define tint tone[2]",
                     "tiny.frag:2: error: 'tone' is vec3 here, but vec2 in tiny.vert:1"}),
    [](const auto& row) { return std::string(row.param.name); });

TEST(VulkanInterface, NamesTheSizesOfWorkGroups) {
    MemoryFileSystem files;
    files.write("a.comp",
                "#version 450\nlayout(local_size_x_id = 5, local_size_z_id = 7) in;\n"
                "layout(constant_id = 1) const float gain = 2.0;\n"
                "layout(std430, set = 0, binding = 0) buffer Values { float values[]; };\n"
                "void main() { values[gl_GlobalInvocationID.x] *= gain * float(gl_WorkGroupSize.x); }\n");
    SearchPath search;
    const Family family = family_of_files({"a.comp"}, files, search).value();
    const Composition composition = compose(family, {Key{}}, search, Dialect::vulkan).value();
    const Validated validated = validate(family, composition, {.keep_spirv = true});
    ASSERT_EQ(first_text(validated.diagnostics), "");
    EXPECT_THAT(interface_of(validated, composition.permutations[0]).specialization_constants,
                ElementsAre(SpecializationConstant{"gain", "float", 1, 0x40000000},
                            SpecializationConstant{"local_size_x", "uint", 5, 1},
                            SpecializationConstant{"local_size_z", "uint", 7, 1}));
}

struct LimitRow {
    const char* name;
    const char* group;
    const char* size;  ///< of the shared array
    const char* message;
};

/// What Vulkan guarantees less of than OpenGL is warned of from there on.
class WorkGroupLimit : public testing::TestWithParam<LimitRow> {};

TEST_P(WorkGroupLimit, IsSaid) {
    MemoryFileSystem files;
    files.write("a.comp",
                fmt::format("#version 450\nlayout({}) in;\nshared float t[{}];\n"
                            "layout(std430, set = 0, binding = 0) buffer Values {{ float value; }};\n"
                            "void main() {{ t[0] = 1.0; value = t[0]; }}\n",
                            GetParam().group, GetParam().size));
    SearchPath search;
    const Family family = family_of_files({"a.comp"}, files, search).value();
    const Composition composition = compose(family, {Key{}}, search, Dialect::vulkan).value();
    const std::string text = first_text(validate(family, composition, {}).diagnostics);
    EXPECT_EQ(text.substr(0, text.find(" [")), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, WorkGroupLimit,
    testing::Values(
        LimitRow{"guaranteed", "local_size_x = 16, local_size_y = 8", "4096", ""},
        LimitRow{"group_warned_of", "local_size_x = 129", "1",
                 "a.comp:2: warning: invocations of a work group: 129, Vulkan guarantees only 128 "
                 "(maxComputeWorkGroupInvocations)"},
        LimitRow{"largest_group", "local_size_x = 1024", "1",
                 "a.comp:2: warning: invocations of a work group: 1024, Vulkan guarantees only 128 "
                 "(maxComputeWorkGroupInvocations)"},
        LimitRow{
            "group_refused", "local_size_x = 32, local_size_y = 33", "1",
            "a.comp:2: error: invocations of a work group: 1056, gobo takes only 1024, Vulkan guarantees "
            "128 (maxComputeWorkGroupInvocations)"},
        LimitRow{"shared_warned_of", "local_size_x = 1", "4097",
                 "a.comp:3: warning: bytes of shared variables: 16388, Vulkan guarantees only 16384 "
                 "(maxComputeSharedMemorySize)"},
        LimitRow{
            "shared_refused", "local_size_x = 1", "8193",
            "a.comp:3: error: bytes of shared variables: 32772, gobo takes only 32768, Vulkan guarantees "
            "16384 (maxComputeSharedMemorySize)"}),
    [](const auto& row) { return std::string(row.param.name); });

TEST(FragmentOutputs, AreWarnedOfFromTheFifthOn) {
    const auto said = [](int location) {
        MemoryFileSystem files;
        files.write("a.vert", "#version 450\nvoid main() { gl_Position = vec4(0.0); }\n");
        files.write("a.frag", fmt::format("#version 450\nlayout(location = {}) out vec4 color;\n"
                                          "void main() {{ color = vec4(1.0); }}\n",
                                          location));
        SearchPath search;
        const Family family = family_of_files({"a.vert", "a.frag"}, files, search).value();
        const Composition composition = compose(family, {Key{}}, search, Dialect::vulkan).value();
        const std::string text = first_text(validate(family, composition, {}).diagnostics);
        return text.substr(0, text.find(" ["));
    };
    EXPECT_EQ(said(3), "");
    EXPECT_EQ(said(4),
              "a.frag:2: warning: fragment output locations up to the last of 'color': 5, Vulkan guarantees "
              "only 4 (maxFragmentOutputAttachments)");
}

struct ArrayRow {
    const char* name;
    const char* text;        ///< declares 't', the size of which is computed
    std::uint32_t size;      ///< of 't'
    const char* error = "";  ///< where it cannot have one
};

class ComputedArraySize : public testing::TestWithParam<ArrayRow> {};

/// The elements of the variable 't'.
std::uint32_t size_of_t(const SpirvModule& words) {
    const spirv::Module module = spirv::read_module(words).value();
    for (const spirv::Variable& variable : module.variables)
        if (module.name(variable.id) == "t") return module.type(variable.type).count;
    return 0;
}

TEST_P(ComputedArraySize, IsKnown) {
    MemoryFileSystem files;
    files.write("a.comp",
                fmt::format("#version 450\n"
                            "layout(constant_id = 1) const int A = 2;\n"
                            "layout(constant_id = 2) const uint U = 7;\n"
                            "layout(constant_id = 3) const bool Q = true;\n"
                            "{}\n"
                            "layout(std430, set = 0, binding = 0) buffer Values {{ float value; }};\n"
                            "void main() {{ t[0] = 1.0; value = t[0] + t[A - 2]; }}\n",
                            GetParam().text));
    SearchPath search;
    const Family family = family_of_files({"a.comp"}, files, search).value();
    const Composition composition = compose(family, {Key{}}, search, Dialect::vulkan).value();
    const Validated validated = validate(family, composition, {.keep_spirv = true, .spirv_val = true});
    ASSERT_EQ(first_text(validated.diagnostics), GetParam().error);
    if (*GetParam().error == '\0') {
        EXPECT_EQ(size_of_t(validated.stage(0).spirv), GetParam().size);
    }
}

#define GROUP "layout(local_size_x = 4) in; "
INSTANTIATE_TEST_SUITE_P(
    Rows, ComputedArraySize,
    testing::Values(
        ArrayRow{"work_group", "layout(local_size_x_id = 0) in; shared float t[gl_WorkGroupSize.x];", 1},
        ArrayRow{
            "twice_work_group_and_one",
            "layout(local_size_x = 8, local_size_x_id = 0) in; shared float t[2 * gl_WorkGroupSize.x + 1];",
            17},
        ArrayRow{"product_of_a_work_group",
                 "layout(local_size_x_id = 0, local_size_y = 8, local_size_y_id = 9) in; "
                 "shared float t[gl_WorkGroupSize.x * gl_WorkGroupSize.y];",
                 8},
        ArrayRow{"height_of_a_work_group",
                 "layout(local_size_x = 8, local_size_y_id = 9) in; shared float t[gl_WorkGroupSize.y];", 1},
        ArrayRow{"shift_left", GROUP "shared float t[A << 1];", 4},
        ArrayRow{"shift_right", GROUP "shared float t[U >> 1];", 3},
        ArrayRow{"choice", GROUP "shared float t[A > 2 ? 3 : 2];", 2},
        ArrayRow{"component", GROUP "const ivec2 D = ivec2(A, 3); shared float t[D.x];", 2},
        ArrayRow{"swizzle", GROUP "const ivec2 D = ivec2(A, 3); const ivec3 E = D.yxx; shared float t[E.x];",
                 3},
        ArrayRow{"sum_of_vectors", GROUP "const ivec2 D = ivec2(A, 3); shared float t[(D + D).y];", 6},
        ArrayRow{"of_a_bool", GROUP "shared float t[int(Q) + 1];", 2},
        ArrayRow{"of_conditions", GROUP "shared float t[int(A == 2 && !Q || U >= 7u) + 1];", 2},
        ArrayRow{"conversion", GROUP "shared float t[uint(A) + U];", 9},
        ArrayRow{"bits", GROUP "shared float t[(~A & 7) + (A | 4) + (A ^ 1)];", 14},
        ArrayRow{"remainder", GROUP "shared float t[U % 4u];", 3},
        ArrayRow{"negation", GROUP "shared float t[-(-A)];", 2},
        ArrayRow{
            "of_none", GROUP "shared float t[A - 2];", 0,
            "a.comp:5: error: the size of an array in 't' is 0 where specialisation constants stand at "
            "their defaults [default]\n    layout(local_size_x = 4) in; shared float t[A - 2];\n"
            "  help: state defaults that make it at least 1, divide by none that is 0, and shift by fewer "
            "bits than there are\n"},
        ArrayRow{
            "in_front_of_a_member",
            GROUP "shared float t[1];\nlayout(std430, set = 0, binding = 1) buffer W { float first[A + 1], "
                  "rest; };",
            0,
            "a.comp:6: error: 'rest' has offset 4, within that of 'first', which stands above it [default]\n"
            "    layout(std430, set = 0, binding = 1) buffer W { float first[A + 1], rest; };\n"
            "  help: state its offset: glslang counts an array whose size is computed from "
            "specialisation constants as one element\n"},
        ArrayRow{"in_front_of_a_stated_offset",
                 GROUP "shared float t[1];\nlayout(std430, set = 0, binding = 1) buffer W { float first[A + "
                       "1]; layout(offset = 12) float rest; };",
                 1},
        ArrayRow{
            "division_by_zero", GROUP "shared float t[A / (A - 2)];", 0,
            "a.comp:5: error: the size of an array in 't' has no value where specialisation constants "
            "stand at their defaults [default]\n    layout(local_size_x = 4) in; shared float t[A / (A - "
            "2)];\n"
            "  help: state defaults that make it at least 1, divide by none that is 0, and shift by fewer "
            "bits than there are\n"}),
    [](const auto& row) { return std::string(row.param.name); });
#undef GROUP

const std::string kLamps = "[features.lamp]\ncount = [0, 6]\nconstant = \"LAMPS\"\nspecialize = true\n";
const std::string kLampFragment =
    "#include <lamp>\n"
    "#if LAMPS > 0\nBLOCK(0, Lamps) { vec4 lamps[LAMPS]; } lamps;\n#endif\n"
    "OUTPUT(0) vec4 color;\n"
    "void main() {\n    color = vec4(0.0);\n"
    "#if LAMPS > 0\n    for (int i = 0; i < LAMPS; ++i) color += lamps.lamps[i];\n#endif\n}\n";

class SpecializedCount : public testing::TestWithParam<Dialect> {};

TEST_P(SpecializedCount, SharesOneStageButFor0) {
    const Built lamps =
        built(kLamps, kVertex, kLampFragment, {"lamp=1", "lamp=4", "lamp=6", "default"}, GetParam());
    const auto stage = [&](std::size_t i) {
        return lamps.composition.permutations[i].stages[StageKind::fragment];
    };
    EXPECT_EQ(stage(0), stage(1));
    EXPECT_EQ(stage(0), stage(2));
    EXPECT_NE(stage(0), stage(3));
    EXPECT_THAT(fragment_of(lamps),
                HasSubstr("#define LAMPS_LARGEST 6\nlayout(constant_id = 0) const int LAMPS = 6;\n"));
    EXPECT_THAT(fragment_of(lamps), HasSubstr("#if LAMPS_LARGEST > 0\n"));
    EXPECT_THAT(fragment_of(lamps, 3), HasSubstr("#define LAMPS 0\n#define LAMPS_LARGEST 0\n"));
    EXPECT_THAT(lamps.composition.permutations[1].specialized, ElementsAre(gobo::SpecializedCount{0, 4}));
    EXPECT_THAT(lamps.composition.permutations[3].specialized, IsEmpty());
    EXPECT_THAT(lamps.composition.notes, IsEmpty());
}

TEST_P(SpecializedCount, LeavesArraysAtTheirLargest) {
    const Built lamps = built(kLamps, kVertex, kLampFragment, {"lamp=2"}, GetParam());
    const SpirvModule& words =
        lamps.validated.stage(lamps.composition.permutations[0].stages[StageKind::fragment]).spirv;
    const Interface largest = reflect_stage(words).value();
    ASSERT_EQ(largest.specialization_constants.size(), 1u);
    EXPECT_EQ(largest.specialization_constants[0], (SpecializationConstant{"LAMPS", "int", 0, 6}));
    const SpirvModule two = spirv::specialized(words, {{0, 2}}).value();
    const Interface specialized = reflect_stage(two).value();
    EXPECT_THAT(specialized.specialization_constants, IsEmpty());
    EXPECT_EQ(specialized.blocks, largest.blocks) << "6 lamps, however many are asked for";
    EXPECT_THAT(specialized.blocks[0].members[0].array, ElementsAre(6));
}

TEST_P(SpecializedCount, LeavesComputedArraysAtTheirLargest) {
    // The largest need not be that of the largest count.
    for (const auto& [size, largest] : {std::pair{"LAMPS > 2 ? 4 : 2", 4U},
                                        {"LAMPS > 2 ? 2 : 5", 5U},
                                        {"8 - LAMPS", 7U},
                                        {"2 * LAMPS + 1", 13U}}) {
        const std::string fragment = fmt::format(
            "#include <lamp>\nOUTPUT(0) vec4 color;\n#if LAMPS > 0\nfloat t[{}];\n#endif\n"
            "void main() {{\n    color = vec4(0.0);\n#if LAMPS > 0\n    t[1] = color.x;\n"
            "    for (int i = 0; i < LAMPS; ++i) color += t[1];\n#endif\n}}\n",
            size);
        const Built lamps = built(kLamps, kVertex, fragment, {"lamp=1", "lamp=6"}, GetParam());
        EXPECT_THAT(lamps.composition.notes, IsEmpty()) << size;
        const int stage = lamps.composition.permutations[0].stages[StageKind::fragment];
        EXPECT_EQ(size_of_t(spirv::specialized(lamps.validated.stage(stage).spirv, {{0, 6}}).value()),
                  largest)
            << size;
    }
}

INSTANTIATE_TEST_SUITE_P(Dialects, SpecializedCount, testing::Values(Dialect::vulkan, Dialect::gl_spirv),
                         [](const auto& row) { return std::string(name_of(row.param)); });

TEST(SpecializedCountOfTexts, IsAMacroAsEver) {
    const Built lamps = built(kLamps, kVertex, kLampFragment, {"lamp=1", "lamp=4"}, Dialect::glsl450);
    EXPECT_THAT(fragment_of(lamps), HasSubstr("#define LAMPS 1\n"));
    EXPECT_THAT(fragment_of(lamps), Not(HasSubstr("LARGEST")));
    EXPECT_NE(lamps.composition.permutations[0].stages, lamps.composition.permutations[1].stages);
}

struct LiteralRow {
    const char* name;
    const char* body;
    const char* fragment;
    const char* note;
};

/// Where more hangs on a count than a loop and an array, its keys keep it as a literal.
class LiteralCount : public testing::TestWithParam<LiteralRow> {};

TEST_P(LiteralCount, IsNotedWithTheReason) {
    const LiteralRow& row = GetParam();
    const Built lamps = built(kLamps + row.body,
                              "vec4[LAMPS] raysToLamps() {\n    vec4 rays[LAMPS];\n"
                              "    for (int i = 0; i < LAMPS; ++i) rays[i] = vec4(float(i));\n"
                              "    return rays;\n}\n#include <varyings>\n"
                              "void main() {\n    gl_Position = raysToLamps()[0];\n    writeVaryings();\n}\n",
                              row.fragment, {"lamp=1", "lamp=4"});
    EXPECT_THAT(lamps.composition.permutations[0].specialized, IsEmpty());
    EXPECT_NE(lamps.composition.permutations[0].stages, lamps.composition.permutations[1].stages);
    EXPECT_THAT(fragment_of(lamps), HasSubstr("#define LAMPS 1\n#define LAMPS_LARGEST 1\n"));
    ASSERT_EQ(lamps.composition.notes.size(), 1u);
    EXPECT_EQ(to_text(lamps.composition.notes[0]), row.note);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, LiteralCount,
    testing::Values(
        LiteralRow{
            "varyings", "[varyings.rays]\ncount = \"lamp\"\ntype = \"vec4\"\nvalue = \"raysToLamps()\"\n",
            "OUTPUT(0) vec4 color;\n"
            "void main() {\n    color = vec4(0.0);\n"
            "    for (int i = 0; i < LAMPS; ++i) color += rays[i];\n}\n",
            "tiny.toml:8:1: note: no specialisation constant, but a stage for each number of lamp: the "
            "varying 'rays' has as many values [lamp=1, and 1 more key]\n"},
        LiteralRow{"conditions", "",
                   "#include <lamp>\nOUTPUT(0) vec4 color;\nvoid main() {\n    color = vec4(0.0);\n"
                   "#if LAMPS > 2\n    color.r = 1.0;\n#endif\n}\n",
                   "tiny.frag:5:1: note: no specialisation constant, but a stage for each number of lamp: "
                   "this asks for "
                   "more than whether there is one [lamp=1, and 1 more key]\n    #if LAMPS > 2\n    ^\n"}),
    [](const auto& row) { return std::string(row.param.name); });

}  // namespace
}  // namespace gobo
