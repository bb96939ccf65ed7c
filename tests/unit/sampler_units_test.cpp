// Which texture unit each sampler of a family gets, as OpenGL has it once the header's tables are applied.
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#define GOBO_GL_NO_LOADER
#include <gobo/gl.hpp>

#include "compose/compose.hpp"
#include "emit/sections.hpp"
#include "family/key.hpp"
#include "family/selection.hpp"
#include "lab/render/program.hpp"
#include "small_families.hpp"
#include "spirv/glsl_type.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

constexpr const char* plain = "void main() { gl_Position = vec4(0.0); }\n";

/// The tables of a generated header, filled at run time.
struct Tables {
    static inline std::vector<runtime::BlockBinding> blocks;
    static inline std::vector<runtime::SamplerBinding> samplers;
    static constexpr std::array<runtime::BlockBinding, 0> storage_blocks{};
};

struct UnitsRow {
    const char* name;
    const char* features;
    const char* fragment;
    std::vector<const char*> in_table;  ///< the samplers of the header, whatever their units
};

void PrintTo(const UnitsRow& row, std::ostream* stream) {
    *stream << row.name;
}

/// Which texture unit OpenGL has for each active sampler once the header's tables are applied.
std::vector<std::pair<std::string, int>> units_of(const GladGLContext& gl, unsigned program) {
    std::vector<std::pair<std::string, int>> units;
    int count = 0;
    gl.GetProgramiv(program, GL_ACTIVE_UNIFORMS, &count);
    for (int i = 0; i < count; ++i) {
        char name[100];
        int elements = 0;
        GLenum type = 0;
        gl.GetActiveUniform(program, static_cast<GLuint>(i), sizeof name, nullptr, &elements, &type, name);
        if (type != GL_SAMPLER_2D && type != GL_SAMPLER_CUBE) continue;
        std::string root = name;
        if (root.ends_with("[0]")) root.resize(root.size() - 3);
        for (int element = 0; element < elements; ++element) {
            const std::string part = elements > 1 ? root + "[" + std::to_string(element) + "]" : name;
            int unit = -1;
            gl.GetUniformiv(program, gl.GetUniformLocation(program, part.c_str()), &unit);
            units.emplace_back(part, unit);
        }
    }
    return units;
}

class SamplerUnits : public testing::TestWithParam<std::tuple<UnitsRow, const char*>> {};

TEST_P(SamplerUnits, AreNeverShared) {
    const auto& [row, version] = GetParam();
    const std::string head = std::string("#version ") + version + "\n";
    const std::map<std::string, std::string, std::less<>> files = {
        {"tiny.vert", head + plain}, {"tiny.frag", head + "precision highp float;\n" + row.fragment}};
    const MemoryFileSystem disk(files);
    SearchPath search;
    search.add(disk, "", "", false);
    const Family family = family_of(row.features);
    Selection selection;
    selection.all = true;
    const Composition composition =
        compose(family, select(family, selection, "450").value(), search, Dialect::own).value();
    const Validated validated = validate(family, composition, {});
    ASSERT_EQ(exit_status(validated.diagnostics), 0) << first_text(validated.diagnostics);
    std::vector<Interface> programs;
    for (const Permutation& permutation : composition.permutations)
        programs.push_back(interface_of(validated, permutation));
    const Interface family_interface = with_places(unite(programs).interface);

    Tables::samplers.clear();
    std::vector<std::string> in_table;
    for (const Sampler& sampler : family_interface.samplers) {
        Tables::samplers.push_back(
            {sampler.name, sampler.type, sampler.binding, element_count(sampler.array)});
        in_table.push_back(sampler.name);
    }
    EXPECT_THAT(in_table, testing::ElementsAreArray(row.in_table));
    const Result<Context> context = open_context(Backend::osmesa);
    ASSERT_TRUE(context.has_value());
    for (const Permutation& permutation : composition.permutations) {
        const Result<Program> program = link_program(*context, stages_of(composition, permutation));
        ASSERT_TRUE(program.has_value()) << to_text(program.error().front());
        gl::set_bindings<Tables>(program->id(), context->gl());
        std::set<int> taken;
        std::string all = key_text(family, permutation.key) + ":";
        for (const auto& [name, unit] : units_of(context->gl(), program->id())) {
            all += " " + name + "=" + std::to_string(unit);
            EXPECT_TRUE(taken.insert(unit).second) << all;
        }
        EXPECT_FALSE(taken.empty());
    }
}

const UnitsRow units_rows[] = {
    {"unread_in_some_keys",
     "[features]\ngloss = { define = \"GLOSS\" }\nbumps = { define = \"BUMPS\" }\n",
     "uniform sampler2D albedo;\nuniform sampler2D bumps;\nuniform sampler2D gloss;\nuniform sampler2D "
     "dead;\n"
     "out vec4 c;\nvoid main() {\n    c = texture(albedo, vec2(0.0));\n#ifdef GLOSS\n"
     "    c += texture(gloss, vec2(0.0));\n#endif\n#ifdef BUMPS\n    c += texture(bumps, "
     "vec2(0.0));\n#endif\n}\n",
     {"albedo", "bumps", "gloss"}},
    {"unstated",
     "",
     "uniform sampler2D a;\nuniform sampler2D b;\nout vec4 c;\n"
     "void main() { c = texture(a, vec2(0.0)) - texture(b, vec2(0.0)); }\n",
     {"a", "b"}},
    {"arrays",
     "",
     "uniform sampler2D a;\nuniform sampler2D maps[3];\nuniform samplerCube z;\nout vec4 c;\n"
     "void main() { c = texture(a, vec2(0.0)) + texture(maps[0], vec2(0.0)) + texture(maps[2], vec2(0.0)) "
     "+ texture(z, vec3(1.0)); }\n",
     {"a", "maps", "z"}},
    {"in_structs",
     "",
     "struct Surface { vec4 tint; sampler2D albedo; sampler2D bumps; };\nuniform Surface surfaces[2];\n"
     "uniform sampler2D other;\nout vec4 c;\nvoid main() { c = surfaces[0].tint + texture(other, vec2(0.0))\n"
     "    + texture(surfaces[0].albedo, vec2(0.0)) * texture(surfaces[1].albedo, vec2(0.0))\n"
     "    * texture(surfaces[1].bumps, vec2(0.0)); }\n",
     {"other", "surfaces[0].albedo", "surfaces[0].bumps", "surfaces[1].albedo", "surfaces[1].bumps"}},
};

INSTANTIATE_TEST_SUITE_P(Rows, SamplerUnits,
                         testing::Combine(testing::ValuesIn(units_rows),
                                          testing::Values("330 core", "450", "300 es")),
                         [](const auto& row) {
                             std::string name = std::get<0>(row.param).name;
                             return name + "_" + std::string(std::get<1>(row.param)).substr(0, 3);
                         });

/// One is stated: the others keep away from it.
TEST(SamplerUnit, KeepsAwayFromAStatedOne) {
    const std::map<std::string, std::string, std::less<>> files = {
        {"tiny.vert", std::string("#version 450\n") + plain},
        {"tiny.frag",
         "#version 450\nlayout(binding = 0) uniform sampler2D mask;\nuniform sampler2D albedo;\n"
         "uniform sampler2D normals[2];\nlayout(binding = 0) uniform sampler2D dead;\nout vec4 c;\n"
         "void main() { c = texture(mask, vec2(0.0)) + texture(albedo, vec2(0.0)) "
         "+ texture(normals[1], vec2(0.0)); }\n"}};
    const MemoryFileSystem disk(files);
    SearchPath search;
    search.add(disk, "", "", false);
    const Family family = family_of("");
    const Composition composition = compose(family, {{}}, search, Dialect::own).value();
    const Validated validated = validate(family, composition, {});
    const Interface interface =
        with_places(unite({interface_of(validated, composition.permutations.front())}).interface);
    std::vector<std::string> units;
    for (const Sampler& sampler : interface.samplers)
        units.push_back(sampler.name + " " + std::to_string(sampler.binding));
    EXPECT_THAT(units, testing::ElementsAre("albedo 1", "mask 0", "normals 2"));
}

}  // namespace
}  // namespace gobo
