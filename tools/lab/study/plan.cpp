#include "lab/study/plan.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/numbers.hpp"
#include "core/text.hpp"
#include "family/key.hpp"
#include "family/read_features.hpp"
#include "family/selection.hpp"
#include "lab/raster/rasterise.hpp"
#include "lab/render/shadow_maps.hpp"
#include "lab/study/qualities.hpp"

namespace gobo::study {
namespace {

/// A point in the world, or `point` as it is.
void read_point(const TomlTable& table, std::string_view name, std::array<double, 3>& point) {
    if (!table.has(name)) return;
    const std::vector<double> numbers = table.numbers(name);
    if (numbers.size() == 3)
        std::copy(numbers.begin(), numbers.end(), point.begin());
    else
        table.reader.error(table.place_of(name), fmt::format("'{}' is not a point", name), "write [x, y, z]");
}

void read_extent(const TomlTable& table, std::string_view name, int least, int& extent) {
    constexpr int kMost = 1024;
    const std::int64_t number = table.integer(name).value_or(extent);
    if (number >= least && number <= kMost)
        extent = static_cast<int>(number);
    else
        table.reader.error(table.place_of(name), fmt::format("'{}' is {}", name, number),
                           fmt::format("choose from {} to {}", least, kMost));
}

StudyScene read_scene(const TomlTable& row) {
    const std::vector<std::string> meshes = {"plane", "sphere", "teapot", "torus"};
    StudyScene scene;
    scene.name = row.required_string("name");
    row.called(fmt::format("the study scene '{}'", scene.name))
        .only({"name", "mesh", "detail", "floor_cells", "camera", "target", "values"});
    scene.mesh = row.string("mesh").value_or(scene.mesh);
    if (std::ranges::count(meshes, scene.mesh) == 0)
        row.reader.error(row.place_of("mesh"), fmt::format("there is no mesh '{}'", scene.mesh),
                         suggestion(scene.mesh, meshes));
    read_extent(row, "detail", 3, scene.detail);
    read_extent(row, "floor_cells", 0, scene.floor_cells);
    read_point(row, "camera", scene.camera);
    read_point(row, "target", scene.target);
    scene.values = read_render_values(row, "values");
    return scene;
}

void check_keys(TomlReader& reader, const Place& place, const std::vector<std::string>& texts,
                const Family& family) {
    if (reader.failed()) return;
    for (const std::string& text : texts)
        if (const Result<Key> key = parse_key(family, text, place); !key) reader.take(key.error());
}

void check_quality(const TomlTable& table, std::string_view entry, const std::string& name,
                   const Family& family) {
    std::vector<std::string> known;
    for (const Feature& feature : family.features)
        if (feature.role == Role::quality) known.push_back(feature.name);
    if (std::ranges::count(known, name) == 0)
        table.reader.error(table.place_of(entry), fmt::format("the family has no quality feature '{}'", name),
                           suggestion(name, known));
}

StudyCurve read_curve(const TomlTable& row, const Family& family) {
    row.only({"feature", "over", "numbers", "effects"});
    StudyCurve curve;
    curve.feature = row.required_string("feature");
    curve.over = row.required_string("over");
    curve.numbers = row.numbers("numbers");
    curve.effects = row.required_string("effects");
    if (row.reader.failed()) return curve;
    check_quality(row, "feature", curve.feature, family);
    check_keys(row.reader, row.place_of("effects"), {curve.effects}, family);
    return curve;
}

StudyChange read_change(const TomlTable& row, const Family& family) {
    row.only({"from", "to", "from_values", "to_values"});
    StudyChange change;
    change.from = row.required_string("from");
    change.to = row.required_string("to");
    change.from_values = read_render_values(row, "from_values");
    change.to_values = read_render_values(row, "to_values");
    check_keys(row.reader, row.place_of(), {change.from, change.to}, family);
    return change;
}

/// Of a family that names none: as many combinations of effects as a reader can take in.
std::vector<std::string> effects_by_default(const Family& family) {
    constexpr std::size_t kMostEffects = 8;
    std::vector<std::string> effects;
    const Result<std::vector<Key>> keys = select(family, Selection{}, "450");
    if (!keys) return {key_text(family, default_key(family))};
    for (const Key& key : *keys) {
        const std::string text = key_text(family, effects_of(family, key));
        if (std::find(effects.begin(), effects.end(), text) == effects.end()) effects.push_back(text);
        if (effects.size() == kMostEffects) break;
    }
    return effects;
}

StudyPlan completed(StudyPlan plan, const Family& family) {
    if (plan.effects.empty()) plan.effects = effects_by_default(family);
    if (plan.quick.empty()) plan.quick = {plan.effects.front()};
    if (plan.scenes.empty())
        plan.scenes = {{.name = "teapot"},
                       {.name = "coarse sphere", .mesh = "sphere", .detail = 12, .floor_cells = 4}};
    return plan;
}

Result<Mesh> mesh_of(const FileSystem& shipped, const StudyScene& scene) {
    if (scene.mesh == "sphere") return make_sphere(scene.detail, std::max(2, scene.detail / 2));
    if (scene.mesh == "torus") return make_torus(1, 0.4, scene.detail, std::max(3, scene.detail / 2));
    if (scene.mesh == "plane") return make_plane(3, scene.detail);
    return read_obj(shipped, "data/meshes/teapot.obj");
}

std::string identity_of(const std::vector<RenderValue>& values) {
    std::string text;
    for (const RenderValue& value : values)
        text += fmt::format("{}={}{};", value.name, value.source, value.numbers);
    return text;
}

/// Draws to one map's texels where the nearest surface lies.
void draw_depth(const Object& object, const ShadowCamera& camera, double* texels) {
    // As glPolygonOffset(2, ...) moves surfaces from the light: what slopes shades itself otherwise. What
    // faces the light has no slope; its depth is still not compared with itself within kShadowEdge.
    constexpr double kSlopes = 2;
    constexpr double kLeastOffset = 2e-4;
    const glm::dmat4 to_clip = camera.projection * camera.view * object.model;
    std::vector<glm::dvec4> positions;
    for (const auto& position : object.mesh.positions)
        positions.push_back(to_clip * glm::dvec4(glm::dvec3(position), 1));
    const std::vector<std::uint32_t>& indices = object.mesh.indices;
    for (const raster::Fragment& fragment : raster::rasterise(positions, indices, kShadowSide, kShadowSide)) {
        if (!fragment.is_covered) continue;
        const std::size_t corner = 3 * std::size_t{fragment.triangle};
        const raster::Interpolator triangle(
            {positions[indices[corner]], positions[indices[corner + 1]], positions[indices[corner + 2]]},
            kShadowSide, kShadowSide);
        const double x = fragment.x + 0.5;
        const double y = fragment.y + 0.5;
        const double slope = std::max(std::abs(triangle.at(x + 1, y).depth - fragment.weights.depth),
                                      std::abs(triangle.at(x, y + 1).depth - fragment.weights.depth));
        const double depth = fragment.weights.depth + (kSlopes * slope + kLeastOffset);
        double& texel = texels[static_cast<std::ptrdiff_t>(fragment.y) * kShadowSide + fragment.x];
        // Maps are floats.
        texel = std::min(texel, nearest_float(std::clamp(depth, 0.0, 1.0)));
    }
}

bool is_near_edge(const evaluate::DepthTexels& maps, const evaluate::ImageRequest& request) {
    evaluate::ImageRequest fetch = request;
    fetch.compares = false;
    const double left = std::floor(request.coordinates[0] * maps.width - 0.5);
    const double lower = std::floor(request.coordinates[1] * maps.height - 0.5);
    for (const double x : {left, left + 1}) {
        for (const double y : {lower, lower + 1}) {
            fetch.coordinates[0] = x;
            fetch.coordinates[1] = y;
            if (std::abs(evaluate::answer(maps, fetch)[0] - request.reference) < kShadowEdge) return true;
        }
    }
    return false;
}

}  // namespace

Result<StudyPlan> read_plan(std::string_view text, const std::string& path, const Family& family) {
    TomlReader reader(text, path);
    const TomlTable root(reader, reader.root(), "the plan");
    root.only({"effects", "quick", "rate", "scenes", "curves", "changes"});
    StudyPlan plan;
    plan.effects = root.strings("effects");
    plan.quick = root.strings("quick");
    plan.rate = root.strings("rate");
    check_keys(reader, root.place_of("effects"), plan.effects, family);
    check_keys(reader, root.place_of("quick"), plan.quick, family);
    for (const std::string& name : plan.rate) check_quality(root, "rate", name, family);
    for (const TomlTable& row : root.tables("scenes", "a study scene"))
        plan.scenes.push_back(read_scene(row));
    for (const TomlTable& row : root.tables("curves", "a study curve"))
        plan.curves.push_back(read_curve(row, family));
    for (const TomlTable& row : root.tables("changes", "a study change"))
        plan.changes.push_back(read_change(row, family));
    if (reader.failed()) return tl::unexpected(reader.errors());
    return completed(std::move(plan), family);
}

StudyPlan default_plan(const Family& family) {
    return completed({}, family);
}

void DrawnScene::add_values(const std::vector<RenderValue>& more) {
    values.insert(values.end(), more.begin(), more.end());
}

Result<DrawnScene> draw_scene(const FileSystem& shipped, const Family& family, const StudyScene& scene,
                              int width, int height) {
    GOBO_TRY(Mesh mesh, mesh_of(shipped, scene));
    DrawnScene drawn;
    drawn.name = scene.name;
    drawn.objects = demo_objects(std::move(mesh));
    if (scene.floor_cells > 0)
        drawn.objects.back().mesh = make_plane(12, scene.floor_cells);
    else
        drawn.objects.pop_back();
    drawn.values = family.render;
    drawn.add_values(scene.values);
    drawn.view = {demo_camera(), width, height};
    drawn.view.camera.position = {scene.camera[0], scene.camera[1], scene.camera[2]};
    drawn.view.camera.target = {scene.target[0], scene.target[1], scene.target[2]};
    drawn.identity = fmt::format("{} {} {} {} {} {}x{} {}", scene.mesh, scene.detail, scene.floor_cells,
                                 scene.camera, scene.target, width, height, identity_of(drawn.values));
    return drawn;
}

Result<std::vector<DrawnScene>> draw_scenes(const FileSystem& shipped, const Family& family,
                                            const StudyPlan& plan) {
    std::vector<DrawnScene> scenes;
    for (const StudyScene& scene : plan.scenes) {
        GOBO_TRY(DrawnScene drawn, draw_scene(shipped, family, scene));
        scenes.push_back(std::move(drawn));
    }
    return scenes;
}

DrawnScene sphere_scene(const Family& family, int slices, int width, int height) {
    DrawnScene drawn;
    drawn.name = fmt::format("sphere of {} slices", slices);
    drawn.objects = {{make_sphere(slices, std::max(2, slices / 2)), glm::dmat4(1), {}}};
    drawn.values = family.render;
    drawn.view = {demo_camera(), width, height};
    drawn.identity = fmt::format("{} {}x{} {}", drawn.name, width, height, identity_of(drawn.values));
    return drawn;
}

DrawnScene with_shadows(const Family& family, const Key& key, DrawnScene scene) {
    Family placed = family;
    // The last value of a name holds, and lights are looked up from the front.
    placed.render.assign(scene.values.rbegin(), scene.values.rend());
    const std::vector<ShadowLight> lights = shadow_lights(placed, key);
    if (lights.empty()) return scene;
    const ShadowPlan plan = shadow_plan(lights, scene.objects, scene.view.camera.view(), kShadowSide);
    evaluate::DepthTexels maps{kShadowSide, kShadowSide, static_cast<int>(plan.cameras.size()), {}};
    const std::size_t texels = std::size_t{kShadowSide} * kShadowSide;
    maps.depths.assign(texels * plan.cameras.size(), 1);
    for (std::size_t layer = 0; layer < plan.cameras.size(); ++layer)
        for (const Object& object : scene.objects)
            draw_depth(object, plan.cameras[layer], maps.depths.data() + layer * texels);
    scene.add_values(plan.values);
    scene.shadow_maps = std::make_shared<const evaluate::DepthTexels>(std::move(maps));
    return scene;
}

evaluate::Image image_of(std::shared_ptr<const evaluate::DepthTexels> maps,
                         std::function<void(std::size_t)> near_edge) {
    return [maps = std::move(maps), near_edge = std::move(near_edge)](const evaluate::ImageRequest& request) {
        if (near_edge && request.compares && is_near_edge(*maps, request)) near_edge(request.invocation);
        return evaluate::answer(*maps, request);
    };
}

}  // namespace gobo::study
