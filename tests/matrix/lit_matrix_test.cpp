// The permutations of lit that hold every combination of two feature values, in the full tier of three, and
// the extremes: each is valid in every dialect, none declares or defines anything in vain, no two are the
// same program.
#include <algorithm>
#include <array>
#include <map>
#include <regex>
#include <set>
#include <thread>
#include <tuple>

#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../unit/reflect_unused.hpp"
#include "compose/compose.hpp"
#include "compose/dialect.hpp"
#include "core/text.hpp"
#include "family/key.hpp"
#include "family/read_family.hpp"
#include "family/selection.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

using testing::IsEmpty;

const std::string root = GOBO_SOURCE_DIR;

Family lit_family() {
    const std::string text = DiskFileSystem().read(root + "/templates/lit.toml").value();
    return read_family(text, "templates/lit.toml", {}).value();
}

Composition compose_lit(const Selection& selection, Dialect dialect) {
    static const DiskFileSystem disk;
    const Family family = lit_family();
    SearchPath search;
    search.add(disk, root + "/shader_lib", "shader_lib/", true);
    search.add(disk, root + "/templates", "templates/", true);
    return compose(family, select(family, selection, name_of(dialect)).value(), search, dialect).value();
}

Validated validate_lit(const Composition& composition) {
    ValidateOptions options;
    options.jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    options.spirv_val = true;
    options.keep_spirv = true;
    return validate(lit_family(), composition, options);
}

Selection cover_of(int strength) {
    Selection selection;
    selection.cover = strength;
    return selection;
}

class LitMatrix : public testing::TestWithParam<Dialect> {};

/// By the dialect and how many feature values each combination has.
class LitCover : public testing::TestWithParam<std::tuple<Dialect, int>> {};

TEST_P(LitCover, IsValidAndDeclaresNothingInVain) {
    const auto [dialect, strength] = GetParam();
    const Composition composition = compose_lit(cover_of(strength), dialect);
    EXPECT_GT(composition.permutations.size(), strength == 2 ? 80u : 728u)
        << "two counts of 9 values alone need 81, three 729";
    const Validated validated = validate_lit(composition);
    EXPECT_EQ(to_text(validated.diagnostics), "");
    for (std::size_t i = 0; i < composition.stages.size(); ++i) {
        ASSERT_FALSE(validated.stages[i].spirv.empty());
        EXPECT_THAT(unused_variables(validated.stages[i].spirv).value(), IsEmpty())
            << source_of(composition, composition.stages[i]);
    }
}

/// Every driver takes what the rules allow: no valid key is refused later, the most lights least of all.
TEST_P(LitMatrix, TheMostLightsOfEachKindAreValid) {
    Selection selection;
    selection.cover = 2;
    selection.where = "directional == 8 && point == 8 && spot == 8 && directional_or_point == 8";
    const Composition composition = compose_lit(selection, GetParam());
    EXPECT_GE(composition.permutations.size(), 4u * 4u) << "fogs by depths, of which every dialect has some";
    EXPECT_EQ(to_text(validate_lit(composition).diagnostics), "");
}

TEST_P(LitMatrix, TheMostShadowsOfEachKindAreValid) {
    Selection selection;
    selection.all = true;
    selection.over = {"directional",         "point",         "spot",         "specular",     "shading",
                      "directional_shadows", "point_shadows", "spot_shadows", "shadow_filter"};
    selection.where =
        "directional == 8 && point == 8 && spot == 8 && directional_shadows + point_shadows + spot_shadows "
        "== 12 && (shading == fragment || shading == vertex)";
    const Composition composition = compose_lit(selection, GetParam());
    EXPECT_EQ(composition.permutations.size() % 6, 0U) << "2 shadings, 3 filters";
    EXPECT_EQ(to_text(validate_lit(composition).diagnostics), "");
}

/// Where texts are shipped: in SPIR-V keys that differ in counts share their stages.
class LitMatrixTexts : public LitMatrix {};

TEST_P(LitMatrixTexts, DifferentKeysAreDifferentPrograms) {
    const Composition composition = compose_lit(cover_of(3), GetParam());
    const Family family = lit_family();
    std::map<std::pair<std::string, std::string>, std::string>
        programs;  // by their sources, not their numbers
    for (const Permutation& permutation : composition.permutations) {
        const auto source = [&](int stage) {
            return source_of(composition, composition.stages[static_cast<std::size_t>(stage)]);
        };
        const auto [at, is_new] = programs.try_emplace(
            {source(permutation.stages[StageKind::vertex]), source(permutation.stages[StageKind::fragment])},
            key_text(family, permutation.key));
        EXPECT_TRUE(is_new) << at->second << " and " << key_text(family, permutation.key);
    }
}

std::string dialect_of_row(const testing::TestParamInfo<Dialect>& row) {
    return "glsl" + std::string(name_of(row.param));
}
constexpr auto every_dialect =
    std::to_array({Dialect::glsl450, Dialect::glsl330, Dialect::es300, Dialect::vulkan});

constexpr auto name_of_cover = [](const auto& row) {
    const auto [dialect, strength] = row.param;
    return fmt::format("glsl{}_{}", name_of(dialect), strength == 2 ? "pairs" : "triples");
};
INSTANTIATE_TEST_SUITE_P(Dialects, LitCover,
                         testing::Combine(testing::ValuesIn(every_dialect), testing::Values(2, 3)),
                         name_of_cover);
INSTANTIATE_TEST_SUITE_P(Dialects, LitMatrix, testing::ValuesIn(every_dialect), dialect_of_row);
INSTANTIATE_TEST_SUITE_P(Dialects, LitMatrixTexts,
                         testing::Values(Dialect::glsl450, Dialect::glsl330, Dialect::es300), dialect_of_row);

/// The stage after glslang's preprocessor, so that what an #if leaves out does not count.
std::string preprocessed(const Composition& composition, const Stage& stage) {
    const bool is_vertex = stage.kind == StageKind::vertex;
    glslang::TShader shader(is_vertex ? EShLangVertex : EShLangFragment);
    const std::string source = source_of(composition, stage);
    const char* text = source.c_str();
    shader.setStrings(&text, 1);
    shader.setEnvInput(glslang::EShSourceGlsl, is_vertex ? EShLangVertex : EShLangFragment,
                       glslang::EShClientOpenGL, 100);
    std::string result;
    glslang::TShader::ForbidIncluder no_includes;
    EXPECT_TRUE(shader.preprocess(GetDefaultResources(), 450, ECoreProfile, false, false, EShMsgDefault,
                                  &result, no_includes))
        << shader.getInfoLog();
    return result;
}

/// The functions, structs and global variables that a preprocessed stage defines at top level, by the shape
/// of their first line, and mentions nowhere else. GLSL has no recursion, so what is mentioned is used by a
/// function that is itself mentioned, up to main().
std::vector<std::string> unmentioned(const std::string& text) {
    static const std::regex definition(R"(^(?:(?:const|struct)\s+)?\w+\s+(\w+)\s*[({;=]|^struct\s+(\w+))");
    std::map<std::string, int> mentions;
    for (auto at = text.begin(); at != text.end();) {
        const auto start = std::find_if(at, text.end(), is_identifier_start);
        at = std::find_if_not(start, text.end(), is_identifier_part);
        if (start != at) ++mentions[std::string(start, at)];
    }
    std::set<std::string> unused;
    int depth = 0;
    for (std::string_view rest = text; !rest.empty();) {
        const std::string line(rest.substr(0, rest.find('\n')));
        rest.remove_prefix(std::min(line.size() + 1, rest.size()));
        const std::string bare(trim(line));
        std::smatch found;
        if (depth == 0 && std::regex_search(bare, found, definition)) {
            const std::string name = found[1].matched ? found[1] : found[2];
            if (name != "main" && mentions[name] < 2) unused.insert(name);
        }
        for (const char c : line) depth += c == '{' ? 1 : c == '}' ? -1 : 0;
    }
    return {unused.begin(), unused.end()};
}

TEST(Unmentioned, SeesFunctionsStructsAndGlobals) {
    EXPECT_THAT(
        unmentioned("struct Unused { float a; };\nfloat used(float x) { return x; }\nvec3 lonely() {\n"
                    "    float local = 1.0;\n    return vec3(local);\n}\nvec3 forgotten;\n"
                    "const float spare = 1.0;\nvoid main() { used(1.0); }\n"),
        testing::ElementsAre("Unused", "forgotten", "lonely", "spare"));
}

TEST(LitMatrixText, NothingIsDefinedInVain) {
    glslang::InitializeProcess();
    const Composition composition = compose_lit(cover_of(3), Dialect::glsl450);
    std::set<std::string> unused;
    for (const Stage& stage : composition.stages) {
        for (const std::string& name : unmentioned(preprocessed(composition, stage))) unused.insert(name);
    }
    EXPECT_THAT(unused, IsEmpty());
}

TEST(LitMatrixText, ThePreprocessorOnlyAsksForCounts) {
    std::set<std::string> counts = {"defined"};
    for (const Feature& feature : lit_family().features) {
        if (feature.kind == FeatureKind::count) counts.insert(feature.macro);
    }
    static const std::regex question(R"(^\s*#\s*(if|ifdef|ifndef|elif)\b(.*))");
    static const std::regex word(R"([A-Za-z_]\w*)");
    const DiskFileSystem disk;
    for (const std::string& file : disk.files_below(root + "/shader_lib")) {
        for (const std::string& line : split(disk.read(root + "/shader_lib/" + file).value(), '\n')) {
            std::smatch asked;
            if (!std::regex_match(line, asked, question)) continue;
            const std::string condition = asked[2].str().substr(0, asked[2].str().find("//"));
            for (std::sregex_iterator at(condition.begin(), condition.end(), word), end; at != end; ++at)
                EXPECT_TRUE(counts.contains(at->str())) << file << ": " << line;
        }
    }
}

TEST(LitMatrixText, PiecesAreShortAndSayWhatTheyAre) {
    const DiskFileSystem disk;
    const std::vector<std::string> files = disk.files_below(root + "/shader_lib");
    EXPECT_GT(files.size(), 20u);
    for (const std::string& file : files) {
        const std::string text = disk.read(root + "/shader_lib/" + file).value();
        EXPECT_TRUE(text.starts_with("// ")) << file;
        EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 100) << file;
    }
}

}  // namespace
}  // namespace gobo
