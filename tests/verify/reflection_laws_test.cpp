// The laws of reflection hold of the shipped pieces of `pbr`, and each finds a piece that breaks it.
#include "lab/verify/reflection_laws.hpp"

#include <gtest/gtest.h>

#include "core/file_system.hpp"
#include "family/read_family.hpp"
#include "lab/evaluate/evaluate.hpp"
#include "lit_library.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

/// The laws tried on a key of pbr with a piece replaced.
verify::StageReport tried(const std::string& text, const Overlay& overlay) {
    const DiskFileSystem disk;
    const auto of_templates = [&](const std::string& name) {
        const std::string path = "templates/" + name + ".toml";
        return Result<FamilyText>(FamilyText{disk.read(GOBO_SOURCE_DIR "/" + path).value(), path});
    };
    const FamilyText pbr = of_templates("pbr").value();
    const Family family = read_family(pbr.text, pbr.path, of_templates).value();
    const std::vector<Key> keys = keys_of(family, {text});
    const Composition composition = compose_lit(family, keys, overlay).value();
    ValidateOptions options;
    options.keep_spirv = true;
    const Validated validated = validate(family, composition, options);
    const int fragment = composition.permutations.front().stages[StageKind::fragment];
    const auto program = evaluate::decode(validated.stages[static_cast<std::size_t>(fragment)].spirv).value();
    return verify::check_laws(program, oracle::model_of(family, keys.front()).value(), 7).value();
}

struct Row {
    const char* law;
    const char* key;
    const char* piece;
    const char* broken;
};

const Row kRows[] = {
    {"fragmentColor of a furnace", "environment_brdf=constant reflection=image",
     "environment_brdf/constant.glsl",
     "vec2 environmentBrdf(float nv, float roughness) { return vec2(1.3, 0.0); }\n"},
    {"fragmentColor of a white furnace", "multiple_scattering=returned reflection=image",
     "multiple_scattering/returned.glsl",
     "vec3 returnedToEnvironment(vec2 brdf, vec3 once) { return vec3(0.0); }\nvec3 highlightScale() { return "
     "vec3(1.0); "
     "}\n"},
    {"fragmentColor with light and viewer exchanged", "directional=1 visibility=half_angle",
     "visibility/half_angle.glsl",
     "float visibilityTerm(float alpha, float nl, float nv, float square) { return nv / max(square, 1e-4); "
     "}\n"},
    {"fragmentColor of the mirror image", "directional=1 visibility=half_angle", "visibility/half_angle.glsl",
     "#include \"pbr/surface.glsl\"\nfloat visibilityTerm(float alpha, float nl, float nv, float square) "
     "{ return 1.5 + surface.normal.x; }\n"},
    {"fragmentColor of metal over another dielectric", "directional=1 fresnel=constant",
     "fresnel/constant.glsl",
     "#include \"pbr/surface.glsl\"\nvec3 fresnelReflectance(float vh) { return material.dielectric; }\n"},
};

TEST(ReflectionLaws, HoldOfTheShippedPiecesAndFindBrokenOnes) {
    for (const Row& row : kRows) {
        const verify::StageReport shipped = tried(row.key, {});
        EXPECT_GT(shipped.figures.points, 0U);
        EXPECT_EQ(shipped.failed_points, 0U) << row.law;
        bool is_found = false;
        for (const verify::Failure& failure : tried(row.key, {{row.piece, row.broken}}).worst)
            is_found |= failure.output == row.law;
        EXPECT_TRUE(is_found) << row.law;
    }
}

}  // namespace
}  // namespace gobo
