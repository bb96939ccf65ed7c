// Prologues, exactly.
#include "compose/dialect.hpp"

#include <gtest/gtest.h>

namespace gobo {
namespace {

bool everything(std::string_view) {
    return true;
}
bool nothing(std::string_view) {
    return false;
}
bool all_but_early(std::string_view name) {
    return name != "early_fragment_tests";
}

struct PrologueRow {
    const char* name;
    Dialect dialect;
    StageKind stage;
    const char* own_version;
    bool (*mentions)(std::string_view);
    const char* text;
};

class Prologue : public testing::TestWithParam<PrologueRow> {};

TEST_P(Prologue, IsExact) {
    const PrologueRow& row = GetParam();
    EXPECT_EQ(dialect_prologue(row.dialect, row.stage, row.own_version, {}, row.mentions), row.text);
}

constexpr const char* modern =
    "#define BLOCK(binding_, name_) layout(std140, binding = binding_) uniform name_\n"
    "#define VARYING(location_) layout(location = location_) in\n"
    "#define ATTRIBUTE(location_) layout(location = location_) in\n"
    "#define OUTPUT(location_) layout(location = location_) out\n"
    "#define SAMPLER(binding_, type_) layout(binding = binding_) uniform type_\n"
    "#define DEPTH(qualifier_) layout(qualifier_)\n";
const std::string modern_450 = std::string("#version 450 core\n") + modern;
const std::string modern_420 = std::string("#version 420\n") + modern;

INSTANTIATE_TEST_SUITE_P(
    Rows, Prologue,
    testing::Values(
        PrologueRow{"bare_450", Dialect::glsl450, StageKind::vertex, "330 core", nothing,
                    "#version 450 core\n"},
        PrologueRow{"bare_330", Dialect::glsl330, StageKind::vertex, "", nothing, "#version 330 core\n"},
        PrologueRow{"bare_es300", Dialect::es300, StageKind::fragment, "", nothing,
                    "#version 300 es\nprecision highp float;\nprecision highp int;\n"},
        PrologueRow{"own_unstated", Dialect::own, StageKind::vertex, "", nothing, "#version 450 core\n"},
        PrologueRow{"own_stated", Dialect::own, StageKind::vertex, "150", nothing, "#version 150\n"},
        PrologueRow{"own_es_states_its_precision_itself", Dialect::own, StageKind::fragment, "300 es",
                    nothing, "#version 300 es\n"},
        PrologueRow{"vulkan_keeps_a_later_version", Dialect::vulkan, StageKind::vertex, "460 core", nothing,
                    "#version 460\n"},
        PrologueRow{"gl_spirv_keeps_a_later_version", Dialect::gl_spirv, StageKind::vertex, "460", nothing,
                    "#version 460 core\n"},
        PrologueRow{"vulkan_raises_an_earlier_version", Dialect::vulkan, StageKind::vertex, "330 core",
                    nothing, "#version 450\n"},
        PrologueRow{"gl_spirv_raises_es", Dialect::gl_spirv, StageKind::vertex, "300 es", nothing,
                    "#version 450 core\n"},
        PrologueRow{"spirv_without_a_version", Dialect::vulkan, StageKind::vertex, "", nothing,
                    "#version 450\n"},
        PrologueRow{"dialect_450_lowers_460", Dialect::glsl450, StageKind::vertex, "460", nothing,
                    "#version 450 core\n"},
        PrologueRow{"fragment_450", Dialect::glsl450, StageKind::fragment, "", everything,
                    modern_450.c_str()},
        PrologueRow{"own_420", Dialect::own, StageKind::fragment, "420", all_but_early, modern_420.c_str()},
        PrologueRow{"vertex_330", Dialect::glsl330, StageKind::vertex, "", all_but_early,
                    "#version 330 core\n"
                    "#extension GL_ARB_conservative_depth : enable\n"
                    "#define BLOCK(binding_, name_) layout(std140) uniform name_\n"
                    "#define VARYING(location_) out\n"
                    "#define ATTRIBUTE(location_) layout(location = location_) in\n"
                    "#define OUTPUT(location_) layout(location = location_) out\n"
                    "#define SAMPLER(binding_, type_) uniform type_\n"
                    "#define DEPTH(qualifier_) layout(qualifier_)\n"},
        PrologueRow{"own_150_is_spelt_as_330", Dialect::own, StageKind::vertex, "150",
                    [](std::string_view name) { return name == "BLOCK"; },
                    "#version 150\n#define BLOCK(binding_, name_) layout(std140) uniform name_\n"},
        PrologueRow{"early_tests_330", Dialect::glsl330, StageKind::fragment, "",
                    [](std::string_view name) { return name == "DEPTH" || name == "early_fragment_tests"; },
                    "#version 330 core\n#extension GL_ARB_shader_image_load_store : enable\n"
                    "#define DEPTH(qualifier_) layout(qualifier_)\n"},
        PrologueRow{"sampler_es300", Dialect::es300, StageKind::fragment, "",
                    [](std::string_view name) { return name == "SAMPLER"; },
                    "#version 300 es\nprecision highp float;\nprecision highp int;\n"
                    "#define SAMPLER(binding_, type_) uniform highp type_\n"}),
    [](const auto& row) { return row.param.name; });

TEST(Dialect, NamesReadBack) {
    for (const Dialect dialect : {Dialect::glsl450, Dialect::glsl330, Dialect::es300})
        EXPECT_EQ(dialect_of(name_of(dialect)), dialect);
    EXPECT_EQ(name_of(Dialect::own), "450");
    EXPECT_EQ(dialect_of("460"), std::nullopt);
}

}  // namespace
}  // namespace gobo
