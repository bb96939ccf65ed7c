#include "lab/study/scene_points.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "lab/study/oracle_reference.hpp"
#include "lab/study/scene_shadows.hpp"
#include "lab/verify/render_feed.hpp"

namespace gobo::study {
namespace {

/// The nearest fragment of a pixel.
struct Nearest {
    std::size_t object = 0;
    std::size_t fragment = 0;
    double depth = 1;
};

/// Which fragments the depth test leaves, object by object, in order.
Result<std::vector<std::vector<std::size_t>>> visible_fragments(
    const verify::SoftwareProgram& program, const std::vector<verify::SoftwareObject>& objects) {
    std::map<std::pair<int, int>, Nearest> pixels;
    for (std::size_t o = 0; o < objects.size(); ++o) {
        const auto shaded = verify::shade_in<double>(program, objects[o]);
        if (!shaded) return tl::unexpected(shaded.error());
        for (std::size_t i = 0; i < shaded->size(); ++i) {
            const verify::Fragment& fragment = objects[o].fragments[i];
            if (!fragment.is_covered || (*shaded)[i].is_discarded) continue;
            Nearest& nearest = pixels[{fragment.y, fragment.x}];
            if ((*shaded)[i].depth < nearest.depth) nearest = {o, i, (*shaded)[i].depth};
        }
    }
    std::vector<std::vector<std::size_t>> visible(objects.size());
    for (const auto& [pixel, nearest] : pixels)
        if (nearest.depth < 1) visible[nearest.object].push_back(nearest.fragment);
    return visible;
}

/// Takes over the triangles of some fragments, and their vertices, each once.
class PartOfObject {
  public:
    PartOfObject(const Object& object, const std::vector<glm::dvec4>& positions)
        : whole_(object), positions_(positions) {
        part_.object.model = object.model;
        part_.object.values = object.values;
    }

    void add(verify::Fragment fragment, const Color& reference, bool at_edge) {
        fragment.triangle = triangle(fragment.triangle);
        part_.fragments.push_back(fragment);
        part_.reference.push_back(reference);
        part_.at_edge.push_back(at_edge);
    }

    [[nodiscard]] ObjectPoints part() && { return std::move(part_); }

  private:
    std::uint32_t triangle(std::uint32_t number) {
        std::vector<std::uint32_t>& indices = part_.object.mesh.indices;
        const auto [found, is_new] =
            triangles_.try_emplace(number, static_cast<std::uint32_t>(indices.size() / 3));
        if (is_new)
            for (std::size_t corner = 0; corner < 3; ++corner)
                indices.push_back(vertex(whole_.mesh.indices[3 * std::size_t{number} + corner]));
        return found->second;
    }

    std::uint32_t vertex(std::uint32_t number) {
        Mesh& mesh = part_.object.mesh;
        const auto [found, is_new] =
            vertices_.try_emplace(number, static_cast<std::uint32_t>(mesh.positions.size()));
        if (!is_new) return found->second;
        mesh.positions.push_back(whole_.mesh.positions[number]);
        mesh.normals.push_back(whole_.mesh.normals[number]);
        mesh.texcoords.push_back(whole_.mesh.texcoords[number]);
        part_.positions.push_back(positions_[number]);
        return found->second;
    }

    const Object& whole_;
    const std::vector<glm::dvec4>& positions_;
    ObjectPoints part_;
    std::map<std::uint32_t, std::uint32_t> triangles_;
    std::map<std::uint32_t, std::uint32_t> vertices_;
};

ViewedObject viewed_from(const View& view, const Object& object) {
    ViewedObject viewed;
    viewed.model = object.model;
    viewed.view = view.camera.view();
    viewed.projection = view.camera.projection(static_cast<double>(view.width) / view.height);
    viewed.viewport = {view.width, view.height};
    return viewed;
}

std::vector<RenderValue> values_of(const Variant& variant, const DrawnScene& scene, const Object& object) {
    std::vector<RenderValue> values = verify::with_plain_textures(variant.interface, scene.values);
    values.insert(values.end(), object.values.begin(), object.values.end());
    return values;
}

/// The sampler of lit's shadow maps answers from the scene's.
void give_shadow_maps(evaluate::Invocations& invocations, const evaluate::Image& maps) {
    for (auto& [name, image] : invocations.images)
        if (name.starts_with("shadowMaps")) image = maps;
}

/// The permutation's own colours in fp64, and where a shadow is decided within a rounding.
Result<void> refer_to_fp64(const Variant& accurate, verify::SoftwareObject object, const DrawnScene& scene,
                           ObjectPoints& part) {
    const auto mark = [&part](std::size_t invocation) { part.at_edge[invocation] = true; };
    // In quads, invocations are not the fragments alone.
    if (scene.shadow_maps && !accurate.program.link.needs_quads)
        give_shadow_maps(object.uniforms, image_of(scene.shadow_maps, mark));
    const auto shaded = verify::shade_in<double>(accurate.program, object);
    if (!shaded) return tl::unexpected(shaded.error());
    for (std::size_t i = 0; i < shaded->size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) part.reference[i][c] = (*shaded)[i].color[c];
    return {};
}

/// Fills in what ought to be seen.
Result<void> add_reference(const Family& family, const Variant& accurate, ScenePoints& points) {
    for (ObjectPoints& part : points.objects) {
        if (part.fragments.empty()) continue;
        const auto object = shaded_object(accurate, points.scene, part);
        if (!object) return tl::unexpected(object.error());
        auto answers = ask_oracle_at(family, accurate, *object);
        if (!answers) return tl::unexpected(answers.error());
        points.from_oracle = answers->has_value();
        if (answers->has_value()) {
            part.reference = std::move((*answers)->colors);
            part.at_edge = std::move((*answers)->at_edge);
            continue;
        }
        if (auto referred = refer_to_fp64(accurate, *object, points.scene, part); !referred) return referred;
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

Result<ScenePoints> find_points(const Family& family, const Variant& accurate, DrawnScene scene) {
    scene = with_shadows(family, accurate.key, std::move(scene));
    const auto objects =
        verify::rasterise_objects(accurate.program, accurate.interface, scene.objects,
                                  verify::with_plain_textures(accurate.interface, scene.values), scene.view);
    if (!objects) return tl::unexpected(objects.error());
    const auto visible = visible_fragments(accurate.program, *objects);
    if (!visible) return tl::unexpected(visible.error());
    ScenePoints points;
    for (std::size_t o = 0; o < objects->size(); ++o) {
        PartOfObject part(scene.objects[o], (*objects)[o].positions);
        for (const std::size_t i : (*visible)[o]) part.add((*objects)[o].fragments[i], {}, false);
        points.objects.push_back(std::move(part).part());
        points.mesh_vertices += scene.objects[o].mesh.positions.size();
    }
    points.scene = std::move(scene);
    if (auto added = add_reference(family, accurate, points); !added) return tl::unexpected(added.error());
    count(points);
    if (points.pixels > 0) return points;
    return fail(Fault::input, "the scene '" + points.scene.name + "' shows no surface");
}

ScenePoints thinned(const ScenePoints& points, std::size_t count_wanted) {
    ScenePoints thin = points;
    const std::size_t step = std::max<std::size_t>(1, points.pixels / count_wanted);
    std::size_t next = 0;
    for (std::size_t o = 0; o < points.objects.size(); ++o) {
        const ObjectPoints& all = points.objects[o];
        PartOfObject part(all.object, all.positions);
        for (std::size_t i = 0; i < all.fragments.size(); ++i)
            if (next++ % step == 0) part.add(all.fragments[i], all.reference[i], all.at_edge[i]);
        thin.objects[o] = std::move(part).part();
    }
    count(thin);
    return thin;
}

Result<verify::SoftwareObject> shaded_object(const Variant& variant, const DrawnScene& scene,
                                             const ObjectPoints& points) {
    const ViewedObject viewed = viewed_from(scene.view, points.object);
    const std::vector<RenderValue> values = values_of(variant, scene, points.object);
    verify::SoftwareObject object;
    auto vertices = verify::uniforms_of(variant.program.vertex, variant.interface, values, viewed);
    if (!vertices) return tl::unexpected(vertices.error());
    auto uniforms = verify::uniforms_of(variant.program.fragment, variant.interface, values, viewed);
    if (!uniforms) return tl::unexpected(uniforms.error());
    verify::add_attributes(variant.program.vertex, points.object.mesh, values, *vertices);
    if (scene.shadow_maps) {
        give_shadow_maps(*vertices, image_of(scene.shadow_maps));
        give_shadow_maps(*uniforms, image_of(scene.shadow_maps));
    }
    object.vertices = std::move(*vertices);
    object.uniforms = std::move(*uniforms);
    object.indices = points.object.mesh.indices;
    object.positions = points.positions;
    object.fragments = points.fragments;
    object.width = scene.view.width;
    object.height = scene.view.height;
    return object;
}

}  // namespace gobo::study
