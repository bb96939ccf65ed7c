#include "lab/study/study_scene.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lab/render/render.hpp"

namespace gobo::study {
namespace {

Result<Mesh> mesh_of(const FileSystem& shipped, const StudyScene& scene) {
    if (scene.mesh == "sphere") return make_sphere(scene.detail, std::max(2, scene.detail / 2));
    if (scene.mesh == "torus") return make_torus(1, 0.4, scene.detail, std::max(3, scene.detail / 2));
    if (scene.mesh == "plane") return make_plane(3, scene.detail);
    return read_obj(shipped, "data/meshes/teapot.obj");
}

View view_of(const Camera& camera, int width, int height) {
    View view;
    view.camera = camera;
    view.width = width;
    view.height = height;
    return view;
}

}  // namespace

std::string identity_of(const std::vector<RenderValue>& values) {
    std::string text;
    for (const RenderValue& value : values)
        text += fmt::format("{}={}{};", value.name, value.source, value.numbers);
    return text;
}

Result<DrawnScene> draw_scene(const FileSystem& shipped, const Family& family, const StudyScene& scene,
                              int width, int height) {
    Result<Mesh> mesh = mesh_of(shipped, scene);
    if (!mesh) return tl::unexpected(mesh.error());
    Camera camera = demo_camera();
    camera.position = {scene.camera[0], scene.camera[1], scene.camera[2]};
    camera.target = {scene.target[0], scene.target[1], scene.target[2]};
    DrawnScene drawn;
    drawn.name = scene.name;
    drawn.objects = demo_objects(std::move(*mesh));
    if (scene.floor_cells > 0)
        drawn.objects.back().mesh = make_plane(12, scene.floor_cells);
    else
        drawn.objects.pop_back();
    drawn.values = family.render;
    drawn.values.insert(drawn.values.end(), scene.values.begin(), scene.values.end());
    drawn.view = view_of(camera, width, height);
    drawn.identity = fmt::format("{} {} {} {} {} {}x{} {}", scene.mesh, scene.detail, scene.floor_cells,
                                 scene.camera, scene.target, width, height, identity_of(drawn.values));
    return drawn;
}

DrawnScene sphere_scene(const Family& family, int slices, int width, int height) {
    DrawnScene drawn;
    drawn.name = fmt::format("sphere of {} slices", slices);
    drawn.objects = {{make_sphere(slices, std::max(2, slices / 2)), glm::dmat4(1), {}}};
    drawn.values = family.render;
    drawn.view = view_of(demo_camera(), width, height);
    drawn.identity = fmt::format("{} {}x{} {}", drawn.name, width, height, identity_of(drawn.values));
    return drawn;
}

}  // namespace gobo::study
