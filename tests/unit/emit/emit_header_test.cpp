#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/file_system.hpp"
#include "emit/cpp_text.hpp"
#include "emit/emit.hpp"
#include "emit/sections.hpp"
#include "family/constraint.hpp"
#include "sample_family.hpp"

namespace gobo {
namespace {

using sample::Built;

HeaderTemplates templates() {
    const DiskFileSystem files;
    return read_header_templates(files, GOBO_SOURCE_DIR "/templates/header").value();
}

std::string header_of(const Built& built) {
    return emit_header(built.input(), templates()).value().header;
}

struct NameRow {
    const char* name;
    const char* identifier;
    const char* type;
};

class CppNames : public testing::TestWithParam<NameRow> {};

TEST_P(CppNames, AreIdentifiers) {
    EXPECT_EQ(cpp_identifier(GetParam().name), GetParam().identifier);
    EXPECT_EQ(cpp_type_name(GetParam().name), GetParam().type);
    EXPECT_TRUE(is_cpp_identifier(GetParam().identifier));
}

INSTANTIATE_TEST_SUITE_P(
    Names, CppNames,
    testing::Values(NameRow{"fog_distance", "fog_distance", "FogDistance"},
                    NameRow{"default", "default_", "Default"}, NameRow{"co_await", "co_await_", "CoAwait"},
                    NameRow{"4x", "_4x", "_4x"}, NameRow{"a-b", "a_b", "AB"},
                    NameRow{"__Bool", "Bool_", "Bool_"}, NameRow{"a__b", "a_b", "AB"},
                    NameRow{"linux", "linux_", "Linux"}, NameRow{"near", "near_", "Near"},
                    NameRow{"INT_MAX", "INT_MAX_", "INTMAX"}, NameRow{"none", "none", "None_"},
                    NameRow{"--", "unnamed", "unnamed"}));

TEST(CppScope, HandsOutEachNameOnce) {
    CppScope scope({"Fog"});
    EXPECT_EQ(scope.claim("Fog", "_block"), "Fog_block");
    EXPECT_EQ(scope.claim("Fog", "_block"), "Fog_block2");
    EXPECT_EQ(scope.claim("default_"), "default_");
    EXPECT_EQ(scope.claim("default_"), "default_2") << "two '_' in a row are reserved";
}

TEST(CppLiteral, IsRawOnlyWhereThatIsSafe) {
    EXPECT_EQ(cpp_literal("a\tb\n"), "R\"gobo(a\tb\n)gobo\"");
    EXPECT_EQ(cpp_literal(")gobo\"\n"), "R\"gobo2()gobo\"\n)gobo2\"");
    EXPECT_EQ(cpp_literal("say \"\\\""), R"("say \"\\\"")");
    EXPECT_EQ(cpp_literal("\r\n\x01"
                          "1"),
              R"("\015\n\0011")")
        << "a raw literal would lose the carriage return";
    EXPECT_EQ(cpp_literal("// \\ \n"), R"("// \\ \n")") << "compilers warn of a backslash before blanks";
    EXPECT_EQ(cpp_literal("// \\\n"), R"("// \\\n")");
    EXPECT_EQ(cpp_literal("// ?\?/\t\n"), R"("// \077\077/\011\n")");
    EXPECT_EQ(cpp_literal("\n\\ a\n"), "R\"gobo(\n\\ a\n)gobo\"");
}

TEST(CppLiteral, LongTextsAreCutAtLineEnds) {
    const std::string line(99, 'x');
    std::string text;
    for (int number = 0; number < 400; ++number) text += line + "\n";
    const auto parts = cut_for_literals(text);
    ASSERT_EQ(parts.size(), 3U);
    EXPECT_EQ(parts[0].size(), 16000U);
    EXPECT_EQ(parts[1].size(), 16000U);
    EXPECT_EQ(std::string(parts[0]) + std::string(parts[1]) + std::string(parts[2]), text);
    EXPECT_EQ(cut_for_literals("").size(), 1U);
}

struct TypeRow {
    const char* name;
    Member member;
    const char* type;
    const char* extents;
    int size;
};

class CppMemberTypes : public testing::TestWithParam<TypeRow> {};

TEST_P(CppMemberTypes, HaveTheReflectedSize) {
    const auto type = cpp_type_of(GetParam().member);
    ASSERT_TRUE(type);
    EXPECT_EQ(type->type, GetParam().type);
    EXPECT_EQ(type->extents, GetParam().extents);
    EXPECT_EQ(type->size, GetParam().size);
}

Member double_matrix() {
    Member result = sample::member("m", "dmat3", 0);
    result.matrix_stride = 32;
    return result;
}

INSTANTIATE_TEST_SUITE_P(
    Types, CppMemberTypes,
    testing::Values(
        TypeRow{"uint", sample::member("m", "uint", 0), "std::uint32_t", "", 4},
        TypeRow{"dvec3", sample::member("m", "dvec3", 0), "std140::dvec3", "", 24},
        TypeRow{"bvec2", sample::member("m", "bvec2", 0), "std140::bvec2", "", 8},
        TypeRow{"mat2", sample::matrix("m", "mat2", 0), "std140::Mat2", "", 32},
        TypeRow{"mat2x4", sample::matrix("m", "mat2x4", 0), "std140::PlainMatrix<2, 4, float>", "", 32},
        TypeRow{"mat4x3", sample::matrix("m", "mat4x3", 0), "std140::Matrix<4, 3, float, 16>", "", 64},
        TypeRow{"row_major_mat4x3", sample::matrix("m", "mat4x3", 0, true),
                "std140::RowMajorMatrix<4, 3, float, 16>", "", 48},
        TypeRow{"dmat3", double_matrix(), "std140::Matrix<3, 3, double, 32>", "", 96},
        TypeRow{"ivec4_array", sample::array(sample::member("m", "ivec4", 0), {5}, 16), "std140::ivec4",
                "[5]", 80},
        TypeRow{"float_arrays", sample::array(sample::member("m", "float", 0), {2, 3}, 48),
                "std140::Padded<float, 16>", "[2][3]", 96}),
    [](const auto& row) { return std::string(row.param.name); });

TEST(Domains, AreCommentsWhateverTheIndex) {
    const std::vector<Domain> domains = {{"L.lights[].k", 0.001, 10, false, {}, {0}, {}},
                                         {"n", 0.5, 2, true, {}, {}, {}}};
    EXPECT_EQ(domain_text(domains, "L.lights.k"), "[0.001, 10], or 0");
    EXPECT_EQ(domain_text(domains, "n"), "length in [0.5, 2]");
    EXPECT_EQ(domain_text(domains, "other"), "");
}

TEST(EmitHeader, GivesTheSameBytesWhateverTheOrderOfTheKeys) {
    const Built built = sample::lit();
    Built shuffled = built;
    std::reverse(shuffled.composition.permutations.begin(), shuffled.composition.permutations.end());
    EXPECT_EQ(header_of(built), header_of(shuffled));
}

TEST(EmitHeader, AFeatureWithAnEnumOfItsOwnLeavesABlockItsName) {
    Built built = sample::lit();
    EXPECT_NE(header_of(built).find("struct Fog_block {"), std::string::npos);
    built.family.features[2].enum_name = "FogFeature";
    const std::string header = header_of(built);
    EXPECT_NE(header.find("enum class FogFeature : std::uint8_t { none, linear, exponential };"),
              std::string::npos);
    EXPECT_NE(header.find("    FogFeature fog = FogFeature::none;"), std::string::npos);
    EXPECT_NE(header.find("struct Fog {"), std::string::npos);
}

struct ConstraintRow {
    const char* name;
    const char* constraint;
    const char* comment;  ///< empty where a check() looks at the constraint
};

class UncheckedConstraints : public testing::TestWithParam<ConstraintRow> {};

TEST_P(UncheckedConstraints, AreNamedWithTheReason) {
    Built built = sample::lit();
    built.interface.storage_blocks = {
        sample::block("Marks", 0, 16, {sample::array(sample::member("marks", "vec4", 0), {0}, 16)})};
    built.family.domains.push_back(plain_domain(GetParam().constraint, 0, 0));
    const std::string header = header_of(built);
    const std::string_view begin = "// Constraints of the family that no check() looks at:\n";
    const auto at = header.find(begin);
    EXPECT_EQ(at == std::string::npos
                  ? ""
                  : header.substr(at + begin.size(), header.find("\n\n", at) - at - begin.size()),
              GetParam().comment);
}

INSTANTIATE_TEST_SUITE_P(
    Rows, UncheckedConstraints,
    testing::Values(
        ConstraintRow{"checked", "Fog.near < Fog.far", ""},
        ConstraintRow{"of_a_block_that_is_not_here", "unit(Sun.axis)", ""},
        ConstraintRow{"of_an_attribute", "unit(normal)",
                      "//     unit(normal): normal is of each vertex; gobo::is_unit() tells"},
        ConstraintRow{"of_a_component_of_one", "normal.x < 1",
                      "//     normal.x < 1: normal.x is of each vertex"},
        ConstraintRow{"of_a_plain_uniform", "exposure > 0",
                      "//     exposure > 0: exposure is a uniform outside blocks"},
        ConstraintRow{"of_a_block_and_an_attribute", "distinct(Fog.color, position)",
                      "//     distinct(Fog.color, position): position is of each vertex"},
        ConstraintRow{"between_stages", "orthonormal(frame)",
                      "//     orthonormal(frame): frame is between stages; gobo::is_orthonormal() tells"},
        ConstraintRow{"of_an_array_without_a_size", "Marks.marks[].w > 0",
                      "//     Marks.marks[].w > 0: Marks.marks[].w is of an array without a size"},
        ConstraintRow{
            "of_what_is_no_square_matrix", "orthonormal(Fog.color)",
            "//     orthonormal(Fog.color): Fog.color is no square matrix; gobo::is_orthonormal() tells"},
        ConstraintRow{"of_no_such_member", "unit(Fog.axis)", ""}),
    [](const auto& row) { return row.param.name; });

TEST(EmitHeader, AKeyWithTheTopBitSetIsAnUnsignedLiteral) {
    Built built = sample::lit();  // 17 bits
    for (int bit = 17; bit < 64; ++bit) built.family.features.push_back(sample::define(std::to_string(bit)));
    for (Permutation& permutation : built.composition.permutations) {
        permutation.key.resize(built.family.features.size());
        permutation.key.back() = 1;
    }
    const std::string header = header_of(built);
    EXPECT_NE(header.find("9223372036854775808U"), std::string::npos);
}

TEST(EmitHeader, LeavesOutWhatNoPermutationUses) {
    Built built = sample::lit();
    built.composition.permutations.resize(1);
    const std::string header = header_of(built);
    EXPECT_EQ(header.find("piece of point=3"), std::string::npos);
    EXPECT_NE(header.find("piece of default"), std::string::npos);
}

TEST(EmitHeader, WritesOnceWhatProloguesShare) {
    Built built = sample::lit();
    Composition& composition = built.composition;
    for (Stage& stage : composition.stages) {
        const auto number = static_cast<int>(composition.pieces.size());
        composition.pieces.push_back(
            {"prologue", "lit.vert",
             "#version 450 core\n\n#define FOG_DISTANCE_IS_RADIAL 1\n#define STAGE " +
                 std::to_string(number) + "\n"});
        stage.pieces.insert(stage.pieces.begin(), number);
    }
    const std::string header = header_of(built);
    const auto shared = header.find("#define FOG_DISTANCE_IS_RADIAL 1");
    ASSERT_NE(shared, std::string::npos);
    EXPECT_EQ(header.find("#define FOG_DISTANCE_IS_RADIAL 1", shared + 1), std::string::npos);
}

TEST(EmitHeader, RulesOfOtherDialectsDoNotHold) {
    Built built = sample::lit();
    built.family.rules.back().dialects = {"330"};
    EXPECT_EQ(header_of(built).find("varying components"), std::string::npos);
    built.composition.dialect = Dialect::glsl330;
    EXPECT_NE(header_of(built).find("varying components"), std::string::npos);
}

struct VersionRow {
    const char* name;
    Dialect dialect;
    const char* prologue;
    const char* version;
};

class Versions : public testing::TestWithParam<VersionRow> {};

TEST_P(Versions, AreThoseOfTheStages) {
    Composition composition;
    composition.dialect = GetParam().dialect;
    composition.pieces.push_back({"prologue", "lit.vert", GetParam().prologue, false});
    EXPECT_EQ(version_of(composition), GetParam().version);
}

INSTANTIATE_TEST_SUITE_P(
    Dialects, Versions,
    testing::Values(VersionRow{"asked_for", Dialect::glsl330, "#version 330 core\n", "330"},
                    VersionRow{"own_core", Dialect::own, "// a game\n#version 410 core\n", "410"},
                    VersionRow{"own_without_profile", Dialect::own, "#version 120\n", "120"},
                    VersionRow{"own_es", Dialect::own, "#version 300 es\n", "es300"},
                    VersionRow{"own_without_version", Dialect::own, "void main() {}\n", "450"}),
    [](const auto& row) { return std::string(row.param.name); });

TEST(EmitHeader, RefusesWhatIsNoNamespace) {
    const Built built = sample::lit();
    for (const char* name : {"a b", "a::", "::a", "a::class", "1a"}) {
        const auto header = emit_header(built.input(name), templates());
        ASSERT_FALSE(header) << name;
        EXPECT_EQ(to_text(header.error().front()),
                  std::string("gobo: error: '") + name +
                      "' is not a valid C++ namespace\n"
                      "  help: use identifiers with '::' between them, such as game::shaders\n");
        EXPECT_EQ(exit_status(header.error()), 2);
    }
    const std::pair<const char*, const char*> taken[] = {
        {"std", "std"}, {"main", "main"}, {"log::shaders", "log"}, {"game::std", "std"}, {"gobo", "gobo"}};
    for (const auto& [name, whole] : taken) {
        const auto header = emit_header(built.input(name), templates());
        ASSERT_FALSE(header) << name;
        EXPECT_EQ(
            to_text(header.error().front()),
            fmt::format(
                "gobo: error: '{}' cannot be the namespace of a header: C++, GLM or gobo has a '{}' already\n"
                "  help: use another name, such as game::shaders\n",
                name, whole));
        EXPECT_EQ(exit_status(header.error()), 2);
    }
    EXPECT_TRUE(emit_header(built.input("game::log"), templates()));
    EXPECT_NE(
        emit_header(built.input("game::shaders"), templates())->header.find("namespace game::shaders {"),
        std::string::npos);
}

TEST(EmitHeader, RefusesALayoutThatOverlaps) {
    Built built = sample::lit();
    built.interface.blocks = {
        sample::block("Odd", 0, 32, {sample::member("a", "vec4", 0), sample::member("b", "vec4", 8)})};
    const auto header = emit_header(built.input(), templates());
    ASSERT_FALSE(header);
    EXPECT_EQ(to_text(header.error().front()),
              "gobo: error: 'Odd.b' at offset 8 overlaps 'a', which ends at 16\n"
              "  help: state other offsets, or none: layout(std140) gives them\n");
}

}  // namespace
}  // namespace gobo
