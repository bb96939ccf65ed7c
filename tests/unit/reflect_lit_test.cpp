// The family lit: nothing declared in vain, and an interface that spirv-cross and OpenGL confirm.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compose/compose.hpp"
#include "family/read_family.hpp"
#include "family/selection.hpp"
#include "program_interface.hpp"
#include "reflect/reflect.hpp"
#include "reflect_compile.hpp"
#include "reflect_unused.hpp"
#include "reflect_witness.hpp"

namespace gobo {
namespace {

using ::testing::IsEmpty;

template <class T>
T value_of(Result<T> result) {
    EXPECT_TRUE(result) << to_text(result.error().front());
    return std::move(result).value_or(T{});
}

/// Lit over every pair of its features' values: every stage that differs, once.
Composition composed_lit() {
    const DiskFileSystem files;
    const std::string root = GOBO_SOURCE_DIR;
    const std::string path = root + "/templates/lit.toml";
    const Family family = value_of(read_family(value_of(files.read(path)), path));
    Selection selection;
    selection.cover = 2;
    SearchPath search;
    search.add(files, root + "/templates", "templates/", true);
    search.add(files, root + "/shader_lib", "shader_lib/", true);
    return value_of(compose(family, value_of(select(family, selection, "450")), search, Dialect::glsl450));
}

testing::Compiled compiled(const Composition& composition, const gobo::Stage& stage) {
    const auto kind = stage.kind == StageKind::vertex ? testing::Stage::vertex : testing::Stage::fragment;
    testing::Compiled result = testing::compile(kind, source_of(composition, stage));
    EXPECT_EQ(result.log, "");
    return result;
}

/// Where OpenGL's account of the linked permutation differs from `interface`.
std::vector<std::string> differences_from_opengl(const Context& context, const Composition& composition,
                                                 const Permutation& permutation, const Interface& interface) {
    const Result<Program> program =
        link_program(context, {stage_text(composition, permutation.stages[StageKind::vertex]),
                               stage_text(composition, permutation.stages[StageKind::fragment])});
    if (!program) return {to_text(program.error().front())};
    return differences(interface, interface_of_program(context, *program));
}

TEST(Lit, DeclaresNothingInVain) {
    const Composition lit = composed_lit();
    ASSERT_GT(lit.stages.size(), 20u);
    for (const gobo::Stage& stage : lit.stages) {
        EXPECT_THAT(value_of(unused_variables(compiled(lit, stage).spirv)), IsEmpty())
            << source_of(lit, stage);
    }
}

TEST(Lit, IsReflectedAsBothWitnessesSay) {
    const Composition lit = composed_lit();
    std::vector<Interface> stages;
    for (const gobo::Stage& stage : lit.stages) {
        const testing::Compiled module = compiled(lit, stage);
        stages.push_back(restore_bools(value_of(reflect_stage(module.spirv)), module.types));
        EXPECT_EQ(testing::facts_of(stages.back()), testing::facts_of_spirv_cross(module.spirv, "lit"));
    }
    const Result<Context> context = open_context(Backend::osmesa);
    ASSERT_TRUE(context) << to_text(context.error().front());
    for (const Permutation& permutation : lit.permutations) {
        const Interface program =
            merge({stages[static_cast<std::size_t>(permutation.stages[StageKind::vertex])],
                   stages[static_cast<std::size_t>(permutation.stages[StageKind::fragment])]});
        EXPECT_THAT(differences_from_opengl(*context, lit, permutation, program), IsEmpty());
    }
}

TEST(Lit, HasOneInterfaceForAllPermutations) {
    const Composition lit = composed_lit();
    std::vector<Interface> stages;
    for (const gobo::Stage& stage : lit.stages)
        stages.push_back(value_of(reflect_stage(compiled(lit, stage).spirv)));
    // Programs, not stages: what a vertex stage hands on is nobody's but its fragment stage's.
    std::vector<Interface> programs;
    for (const Permutation& permutation : lit.permutations)
        programs.push_back(
            merge({stages[static_cast<std::size_t>(permutation.stages[StageKind::vertex])],
                   stages[static_cast<std::size_t>(permutation.stages[StageKind::fragment])]}));
    const Interface family = unite(programs).interface;
    const auto lights = std::ranges::find(family.blocks, "PointLights", &Block::name);
    ASSERT_NE(lights, family.blocks.end());
    EXPECT_EQ(lights->members.back().array, std::vector<int>{8});  // the largest count that lit offers
}

}  // namespace
}  // namespace gobo
