#include "lab/study/points.hpp"

#include <algorithm>
#include <optional>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "lab/oracle/model.hpp"
#include "lab/raster/raster_object.hpp"
#include "lab/study/parallel_results.hpp"
#include "lab/verify/expectation.hpp"
#include "lab/verify/inputs.hpp"
#include "validate/validate.hpp"

namespace gobo::study {
namespace {

Result<Variant> decode(const Validated& validated, const Permutation& permutation) {
    if (!permutation.stages.is_usual_pair())
        return fail(Fault::input, "a study needs a vertex stage, a fragment stage and no other");
    const SpirvModule& vertex =
        validated.stages[static_cast<std::size_t>(permutation.stages[StageKind::vertex])].spirv;
    const SpirvModule& fragment =
        validated.stages[static_cast<std::size_t>(permutation.stages[StageKind::fragment])].spirv;
    GOBO_TRY(raster::Pipeline program, raster::pipeline_of(vertex, fragment));
    const XXH64_hash_t hash =
        XXH3_64bits_withSeed(fragment.data(), fragment.size() * sizeof fragment[0],
                             XXH3_64bits(vertex.data(), vertex.size() * sizeof vertex[0]));
    return Variant{permutation.key, std::move(program), interface_of(validated, permutation), hash};
}

/// Uniform blocks as values by name, as samples take them.
void spell_out_blocks(const evaluate::Program& program, evaluate::Invocations& invocations) {
    for (const evaluate::Port& port : program.uniforms) {
        if (port.block < 0 || invocations.values.contains(port.name)) continue;
        const std::string& block = program.uniform_blocks[static_cast<std::size_t>(port.block)].name;
        const auto bytes = invocations.blocks.find(block);
        if (bytes != invocations.blocks.end())
            invocations.values[port.name] = evaluate::numbers_in_block(port, bytes->second);
    }
}

/// An input of the fragment stage that differs from fragment to fragment.
struct VaryingField {
    verify::Field field;
    const std::vector<double>* values = nullptr;  ///< component by component, all fragments of each
    std::size_t components = 0;
};

/// The oracle's radiance at the fragments of an object, and where something was decided within a rounding of
/// its edge. False where the oracle does not know the variant's model, or the object's uniforms mean nothing
/// to it.
Result<bool> refer_to_oracle(const Family& family, const Variant& variant, const raster::RasterObject& object,
                             ObjectPoints& part) {
    const auto model = oracle::model_of(family, variant.key);
    if (!model) return false;
    const evaluate::Program& program = variant.program.fragment;
    GOBO_TRY(const evaluate::Invocations inputs, raster::exact_fragment_inputs(variant.program, object));
    evaluate::Invocations first = inputs;
    first.count = 1;
    std::vector<VaryingField> varyings;
    for (const evaluate::Port& port : program.inputs) {
        const auto found = inputs.values.find(port.name);
        if (found == inputs.values.end()) continue;
        if (const auto field = verify::field_of(port.name))
            varyings.push_back({*field, &found->second, port.components});
        std::vector<double>& one = first.values[port.name];
        one.resize(port.components);
        for (std::size_t c = 0; c < port.components; ++c) one[c] = found->second[c * inputs.count];
    }
    spell_out_blocks(program, first);
    std::optional<verify::Sample> sample = verify::sample_of(program, first);
    if (!sample) return false;
    std::vector<double> one;
    for (std::size_t i = 0; i < inputs.count; ++i) {
        for (const VaryingField& varying : varyings) {
            one.resize(varying.components);
            for (std::size_t c = 0; c < varying.components; ++c)
                one[c] = (*varying.values)[c * inputs.count + i];
            varying.field.set(*sample, one);
        }
        oracle::Decisions decisions;
        const auto expected = verify::expect(*model, StageKind::fragment, *sample, decisions);
        const auto color = std::find_if(expected.begin(), expected.end(), [&](const auto& output) {
            return output.output == variant.program.color;
        });
        if (color == expected.end()) return false;
        part.reference[i] = {color->value[0], color->value[1], color->value[2]};
        part.at_edge[i] = decisions.open() > 0;
    }
    return true;
}

/// The nearest fragment of a pixel.
struct Nearest {
    std::size_t object = 0;
    std::size_t fragment = 0;
    double depth = 1;
};

/// Which fragments the depth test leaves, object by object, in order.
Result<std::vector<std::vector<std::size_t>>> visible_fragments(
    const raster::Pipeline& program, const std::vector<raster::RasterObject>& objects) {
    std::map<std::pair<int, int>, Nearest> pixels;
    for (std::size_t o = 0; o < objects.size(); ++o) {
        GOBO_TRY(const auto shaded, raster::shade<double>(program, objects[o]));
        for (std::size_t i = 0; i < shaded.size(); ++i) {
            const raster::Fragment& fragment = objects[o].fragments[i];
            if (!fragment.is_covered || shaded[i].is_discarded) continue;
            Nearest& nearest = pixels[{fragment.y, fragment.x}];
            if (shaded[i].depth < nearest.depth) nearest = {o, i, shaded[i].depth};
        }
    }
    std::vector<std::vector<std::size_t>> visible(objects.size());
    for (const auto& [pixel, nearest] : pixels)
        if (nearest.depth < 1) visible[nearest.object].push_back(nearest.fragment);
    return visible;
}

/// The points at some of the fragments, with the triangles that these lie in and their vertices, each once.
ObjectPoints part_of(const ObjectPoints& all, const std::vector<std::size_t>& fragments) {
    ObjectPoints part;
    raster::RasterObject seen;
    seen.indices = all.object.mesh.indices;
    seen.positions = all.positions;
    for (const std::size_t i : fragments) {
        seen.fragments.push_back(all.fragments[i]);
        part.reference.push_back(all.reference[i]);
        part.at_edge.push_back(all.at_edge[i]);
    }
    part.object.model = all.object.model;
    part.object.values = all.object.values;
    Mesh& mesh = part.object.mesh;
    for (const std::uint32_t vertex : raster::drop_unseen_triangles(seen)) {
        mesh.positions.push_back(all.object.mesh.positions[vertex]);
        mesh.normals.push_back(all.object.mesh.normals[vertex]);
        mesh.texcoords.push_back(all.object.mesh.texcoords[vertex]);
    }
    mesh.indices = std::move(seen.indices);
    part.positions = std::move(seen.positions);
    part.fragments = std::move(seen.fragments);
    return part;
}

/// The sampler of lit's shadow maps answers from the scene's.
void give_shadow_maps(evaluate::Invocations& invocations, const evaluate::Image& maps) {
    for (auto& [name, image] : invocations.images)
        if (name.starts_with("shadowMaps")) image = maps;
}

/// The permutation's own colours in fp64, and where a shadow is decided within a rounding.
Result<void> refer_to_fp64(const Variant& accurate, raster::RasterObject object, const DrawnScene& scene,
                           ObjectPoints& part) {
    const auto mark = [&part](std::size_t invocation) { part.at_edge[invocation] = true; };
    // In quads, invocations are not the fragments alone.
    if (scene.shadow_maps && !accurate.program.needs_quads)
        give_shadow_maps(object.uniforms, image_of(scene.shadow_maps, mark));
    GOBO_TRY(const auto shaded, raster::shade<double>(accurate.program, object));
    for (std::size_t i = 0; i < shaded.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) part.reference[i][c] = shaded[i].color[c];
    return {};
}

/// Fills in what ought to be seen.
Result<void> add_reference(const Family& family, const Variant& accurate, ScenePoints& points) {
    for (ObjectPoints& part : points.objects) {
        if (part.fragments.empty()) continue;
        GOBO_TRY(raster::RasterObject object, shaded_object(accurate, points.scene, part));
        GOBO_TRY(points.from_oracle, refer_to_oracle(family, accurate, object, part));
        if (points.from_oracle) continue;
        GOBO_TRY_DO(refer_to_fp64(accurate, std::move(object), points.scene, part));
    }
    return {};
}

void count(ScenePoints& points) {
    points.pixels = points.edges = points.shown_vertices = 0;
    for (const ObjectPoints& part : points.objects) {
        points.pixels += part.fragments.size();
        points.edges += static_cast<std::size_t>(std::count(part.at_edge.begin(), part.at_edge.end(), true));
        points.shown_vertices += part.object.mesh.positions.size();
    }
}

}  // namespace

Result<Variants> load_variants(const Subject& subject, std::vector<Key> keys, Dialect dialect) {
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    Variants variants;
    GOBO_TRY(variants.composition, compose(subject.family, keys, subject.search, dialect));
    const Validated validated = validate(subject.family, variants.composition,
                                         {.jobs = subject.jobs, .keep_spirv = true, .child_processes = true});
    if (exit_status(validated.diagnostics) != 0) return tl::unexpected(validated.diagnostics);
    GOBO_TRY(variants.all, parallel_results(subject.jobs, keys.size(), [&](std::size_t i) {
                 return decode(validated, variants.composition.permutations[i]);
             }));
    for (std::size_t i = 0; i < keys.size(); ++i) variants.index[keys[i]] = i;
    return variants;
}

Result<ScenePoints> find_points(const Family& family, const Variant& accurate, DrawnScene scene) {
    scene = with_shadows(family, accurate.key, std::move(scene));
    GOBO_TRY(
        const auto objects,
        raster::rasterise_objects(accurate.program, accurate.interface, scene.objects,
                                  raster::with_plain_textures(accurate.interface, scene.values), scene.view));
    GOBO_TRY(const auto visible, visible_fragments(accurate.program, objects));
    ScenePoints points;
    for (std::size_t o = 0; o < objects.size(); ++o) {
        const std::size_t count = objects[o].fragments.size();
        points.objects.push_back(part_of({scene.objects[o], objects[o].positions, objects[o].fragments,
                                          std::vector<Color>(count), std::vector<bool>(count)},
                                         visible[o]));
        points.mesh_vertices += scene.objects[o].mesh.positions.size();
    }
    points.scene = std::move(scene);
    GOBO_TRY_DO(add_reference(family, accurate, points));
    count(points);
    if (points.pixels > 0) return points;
    return fail(Fault::input, "the scene '" + points.scene.name + "' shows no surface");
}

ScenePoints thinned(const ScenePoints& points, std::size_t count_wanted) {
    ScenePoints thin = points;
    const std::size_t step = std::max<std::size_t>(1, points.pixels / count_wanted);
    std::size_t next = 0;
    for (std::size_t o = 0; o < points.objects.size(); ++o) {
        std::vector<std::size_t> kept;
        for (std::size_t i = 0; i < points.objects[o].fragments.size(); ++i)
            if (next++ % step == 0) kept.push_back(i);
        thin.objects[o] = part_of(points.objects[o], kept);
    }
    count(thin);
    return thin;
}

Result<raster::RasterObject> shaded_object(const Variant& variant, const DrawnScene& scene,
                                           const ObjectPoints& points) {
    ViewedObject viewed = viewed_from(scene.view);
    viewed.model = points.object.model;
    std::vector<RenderValue> values = raster::with_plain_textures(variant.interface, scene.values);
    values.insert(values.end(), points.object.values.begin(), points.object.values.end());
    GOBO_TRY(raster::RasterObject object,
             raster::object_inputs(variant.program, variant.interface, points.object.mesh, values, viewed));
    if (scene.shadow_maps)
        for (evaluate::Invocations* stage : {&object.vertices, &object.uniforms})
            give_shadow_maps(*stage, image_of(scene.shadow_maps));
    object.positions = points.positions;
    object.fragments = points.fragments;
    return object;
}

}  // namespace gobo::study
