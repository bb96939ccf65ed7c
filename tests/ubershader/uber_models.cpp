// uber_models FIGURES.json: what `gobo test` is to `lit`, for the ubershader. Each setting of its switches is
// tried at samples of the model that the setting means, and held against the oracle.
#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "compose/compose.hpp"
#include "core/file_system.hpp"
#include "family/key.hpp"
#include "lab/verify/on_mesh.hpp"
#include "lab/verify/verify.hpp"
#include "settings.hpp"
#include "uber_ports.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

/// The two that switch everything, and behind them those that relations compare them with.
struct Keys {
    std::vector<Key> all;
    std::size_t partners = 0;
};

Keys keys_of(const Family& family) {
    Keys keys{{uber::switched_key(family, "switched"), uber::switched_key(family, "looped")}};
    const std::vector<Key> partners = verify::partners(family, keys.all, "450");
    keys.all.insert(keys.all.end(), partners.begin(), partners.end());
    keys.partners = partners.size();
    return keys;
}

/// Prints what came out of one permutation, and says whether it is right.
bool report(const Family& family, const verify::PermutationReport& found) {
    for (const Diagnostic& diagnostic : found.diagnostics) fmt::print("{}", to_text(diagnostic));
    for (const verify::Failure& failure : found.worst)
        fmt::print("{}: {} stage: {}\n", key_text(family, found.key), name_of(failure.stage),
                   to_text(failure));
    bool is_right = found.has_oracle && found.diagnostics.empty() && found.failed_points == 0;
    for (const verify::RelationReport& relation : found.relations) {
        if (relation.failed == 0) continue;
        fmt::print("{}: the relation {} does not hold: {}\n", key_text(family, found.key),
                   family.relations[relation.relation].text, relation.found);
        is_right = false;
    }
    return is_right;
}

Result<bool> run(const std::string& figures_file) {
    verify::lay_fields_over_lit(uber::uber_field);
    Family family = uber::family();
    // Of what turns together `lit` names its own lights only.
    std::erase_if(family.relations, [](const Relation& relation) {
        return relation.kind == Relation::Kind::turn &&
               std::find(relation.names.begin(), relation.names.end(), "SwitchedLights.lights[].position") ==
                   relation.names.end();
    });
    const Keys keys = keys_of(family);
    SearchPath search;
    uber::add_pieces(search);
    GOBO_TRY(const Composition composition, compose(family, keys.all, search, Dialect::own));
    ValidateOptions validate_options;
    validate_options.keep_spirv = true;
    const Validated validated = validate(family, composition, validate_options);
    if (exit_status(validated.diagnostics) != 0) return tl::unexpected(validated.diagnostics);
    DiskFileSystem disk;
    GOBO_TRY(Mesh teapot, read_obj(disk, GOBO_SOURCE_DIR "/data/meshes/teapot.obj"));
    verify::VerifyOptions options;
    options.partners = keys.partners;
    options.meshes = verify::test_meshes(std::move(teapot));
    options.models = [&](const Key& key) { return uber::models_of(family, key); };
    const verify::VerifyReport found = verify::verify(family, composition, validated, options);
    GOBO_TRY_DO(disk.write(figures_file, verify::figures_json(family, found)));
    fmt::print(
        "{} permutations, {} points ({} on meshes), {} at a discontinuity\n"
        "fp64: at most {:.1e} of the largest term away from the oracle\n"
        "fp32: at most {:.2f} of the error bound\n",
        found.permutations.size(), found.figures.points, found.points_on_meshes, found.figures.edges,
        found.figures.largest_fp64_error, found.figures.largest_fp32_ratio);
    return std::all_of(found.permutations.begin(), found.permutations.end(),
                       [&](const verify::PermutationReport& one) { return report(family, one); }) &&
           static_cast<double>(found.figures.edges) <=
               verify::kLargestEdgeShare * static_cast<double>(found.figures.points);
}

}  // namespace
}  // namespace gobo

int main(int count, char** arguments) {
    if (count != 2) {
        std::fputs("usage: uber_models FIGURES.json\n", stderr);
        return 2;
    }
    const gobo::Result<bool> is_right = gobo::run(arguments[1]);
    if (!is_right)
        for (const gobo::Diagnostic& error : is_right.error()) std::fputs(to_text(error).c_str(), stderr);
    return is_right && *is_right ? 0 : 1;
}
