#include "lab/render/shadow_maps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include "lab/render/program.hpp"

namespace gobo {
namespace {

/// What must be on the maps: the objects whose shadows are wanted, and whatever they may fall on.
struct ShadowedScene {
    Bounds casters;
    Bounds all;
};

ShadowedScene shadowed_scene(const std::vector<Object>& objects) {
    ShadowedScene scene;
    for (const Object& object : objects) {
        for (const glm::vec3& position : object.mesh.positions) {
            const glm::dvec3 point(object.model * glm::dvec4(position, 1));
            scene.all.add(point);
            if (object.casts_shadow) scene.casters.add(point);
        }
    }
    if (scene.casters.is_empty()) scene.casters = scene.all;
    if (scene.all.is_empty()) scene.casters = scene.all = {glm::dvec3(-1), glm::dvec3(1)};
    return scene;
}

/// The box around a box after a transformation.
Bounds transformed(const Bounds& bounds, const glm::dmat4& matrix) {
    Bounds result;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 point((corner & 1) != 0 ? bounds.high.x : bounds.low.x,
                               (corner & 2) != 0 ? bounds.high.y : bounds.low.y,
                               (corner & 4) != 0 ? bounds.high.z : bounds.low.z);
        result.add(glm::dvec3(matrix * glm::dvec4(point, 1)));
    }
    return result;
}

/// Any direction that is not nearly along `direction`.
glm::dvec3 up_for(const glm::dvec3& direction) {
    return std::abs(direction.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
}

/// The depth range, a little wider, so that what lies at its ends is on the map. The near plane is where the
/// casters begin: what is before them casts no shadow of interest.
ShadowCamera directional_camera(const ShadowLight& light, const ShadowedScene& scene) {
    ShadowCamera camera;
    camera.view = glm::lookAt(light.direction, glm::dvec3(0), up_for(light.direction));
    const Bounds casters = transformed(scene.casters, camera.view);
    const Bounds all = transformed(scene.all, camera.view);
    const glm::dvec3 margin = 0.02 * (casters.high - casters.low) + 1e-6;
    camera.projection =
        glm::ortho(casters.low.x - margin.x, casters.high.x + margin.x, casters.low.y - margin.y,
                   casters.high.y + margin.y, -casters.high.z - margin.z, -all.low.z + margin.z);
    return camera;
}

/// The near plane stands at this part of the distance to the far one, at least: a hundredth of the way costs
/// depth a factor of 100 in resolution at the far end.
constexpr double kNearest = 0.01;

/// The far plane of a map drawn from a point: a little beyond the largest distance to what is in the box.
double far_plane(const Bounds& bounds, const glm::dvec3& from) {
    return 1.01 * glm::length(glm::max(glm::abs(bounds.low - from), glm::abs(bounds.high - from))) + 1e-6;
}

ShadowCamera spot_camera(const ShadowLight& light, const ShadowedScene& scene) {
    constexpr double kWidestHalfAngle = 1.4;  // at 90 degrees a projection has no end
    ShadowCamera camera;
    camera.view = glm::lookAt(light.position, light.position + light.direction, up_for(light.direction));
    const double far = far_plane(scene.all, light.position);
    const double nearest = -transformed(scene.casters, camera.view).high.z;
    const double half = std::clamp(1.02 * light.half_angle, 1e-3, kWidestHalfAngle);
    camera.projection =
        glm::perspective(2 * half, 1.0, std::clamp(0.98 * nearest, kNearest * far, 0.9 * far), far);
    return camera;
}

std::vector<ShadowCamera> cube_cameras(const ShadowLight& light, const ShadowedScene& scene, int side) {
    const double far = far_plane(scene.all, light.position);
    const double half = std::atan(1 + 2.0 / std::max(side, 3));
    const glm::dmat4 projection = glm::perspective(2 * half, 1.0, kNearest * far, far);
    struct Face {
        glm::dvec3 axis, up;
    };
    // OpenGL 4.5, table 8.19: the side along which t grows is up.
    const std::array<Face, 6> faces = {{{{1, 0, 0}, {0, -1, 0}},
                                        {{-1, 0, 0}, {0, -1, 0}},
                                        {{0, 1, 0}, {0, 0, 1}},
                                        {{0, -1, 0}, {0, 0, -1}},
                                        {{0, 0, 1}, {0, -1, 0}},
                                        {{0, 0, -1}, {0, -1, 0}}}};
    std::vector<ShadowCamera> cameras;
    for (const Face& face : faces)
        cameras.push_back({glm::lookAt(light.position, light.position + face.axis, face.up), projection});
    return cameras;
}

std::vector<ShadowCamera> shadow_cameras(const ShadowLight& light, const ShadowedScene& scene, int side) {
    if (light.kind == ShadowLight::Kind::directional) return {directional_camera(light, scene)};
    if (light.kind == ShadowLight::Kind::spot) return {spot_camera(light, scene)};
    return cube_cameras(light, scene, side);
}

/// The numbers that a shader looks a light's maps up with: the members of lit's struct Shadow. `toMap` leads
/// from the eye space of a camera whose view matrix is `view`.
void add_values(std::vector<RenderValue>& values, std::size_t shadow, int layer, const ShadowLight& light,
                const ShadowCamera& camera, const glm::dmat4& view) {
    const glm::dmat4 to_world = glm::inverse(view);
    const glm::dmat4 halved = glm::translate(glm::dmat4(1), glm::dvec3(0.5)) *
                              glm::scale(glm::dmat4(1), glm::dvec3(0.5));  // -1 to 1 becomes 0 to 1
    const bool is_cube = light.kind == ShadowLight::Kind::point;
    const glm::dmat4 to_map = is_cube ? glm::translate(glm::dmat4(1), -light.position) * to_world
                                      : halved * camera.projection * camera.view * to_world;
    const auto add = [&](const char* member, std::vector<double> numbers) {
        values.push_back({fmt::format("Shadows.shadows[{}].{}", shadow, member), {}, std::move(numbers), {}});
    };
    add("toMap", {glm::value_ptr(to_map), glm::value_ptr(to_map) + 16});
    add("layer", {static_cast<double>(layer)});
    // Window depth (1 + z_clip / w) / 2 with z_clip = projection[2][2] * -w + projection[3][2].
    add("depthScale", {is_cube ? 0.5 - 0.5 * camera.projection[2][2] : 0});
    add("depthShift", {is_cube ? 0.5 * camera.projection[3][2] : 0});
    add("spread", {is_cube ? 0.5 * camera.projection[0][0] : 0.5});
}

Result<void> draw_one(const Context& context, const Program& program, const DepthPass& pass,
                      const ShadowCamera& camera, const std::vector<Object>& objects,
                      const std::vector<ObjectWithHoles>& with_holes) {
    const ViewedObject viewed{glm::dmat4(1), camera.view, camera.projection, {pass.side, pass.side}};
    std::vector<DrawList> lists;
    GOBO_TRY(DrawList whole, make_draw_list(context, program, pass.interface, objects, pass.values, viewed));
    lists.push_back(std::move(whole));
    for (const ObjectWithHoles& own : with_holes) {
        GOBO_TRY(DrawList list, make_draw_list(context, own.program, own.interface, {own.object}, own.values,
                                               viewed, own.textures));
        lists.push_back(std::move(list));
    }
    const GladGLContext& gl = context.gl();
    gl.ClearDepth(1);
    gl.Clear(GL_DEPTH_BUFFER_BIT);
    gl.Enable(GL_POLYGON_OFFSET_FILL);
    gl.PolygonOffset(static_cast<GLfloat>(pass.slope), static_cast<GLfloat>(pass.units));
    for (const DrawList& list : lists) list.draw();
    gl.Disable(GL_POLYGON_OFFSET_FILL);
    return {};
}

}  // namespace

std::vector<ShadowLight> shadow_lights(const Family& family, const Key& key) {
    using Kind = ShadowLight::Kind;
    const auto count = [&](const char* feature) {
        const auto index = family.index_of(feature);
        return index ? key[static_cast<std::size_t>(*index)] : 0;
    };
    // What the [render] table gives for a member of a light; nothing where it gives no numbers.
    const auto numbers = [&](const std::string& name) {
        for (const RenderValue& value : family.render)
            if (value.name == name && !value.numbers.empty()) return value.numbers;
        return std::vector<double>();
    };
    const auto vector = [&](const std::string& name) {
        glm::dvec3 first_three(0);
        const std::vector<double> own = numbers(name);
        std::copy_n(own.begin(), std::min<std::size_t>(own.size(), 3), &first_three[0]);
        return first_three;
    };
    const auto direction = [&](const std::string& name) {
        const glm::dvec3 given = vector(name);
        const double length = glm::length(given);
        return length > 0 ? given / length : glm::dvec3(0, 1, 0);
    };
    std::vector<ShadowLight> lights;
    for (int i = 0; i < count("directional_shadows"); ++i) {
        const std::string light = fmt::format("DirectionalLights.lights[{}]", i);
        lights.push_back({Kind::directional, glm::dvec3(0), direction(light + ".direction"), 0});
    }
    for (int i = 0; i < count("spot_shadows"); ++i) {
        const std::string light = fmt::format("SpotLights.lights[{}]", i);
        const std::vector<double> one_minus_cosine = numbers(light + ".outerOneMinusCosine");
        const double cosine =
            1 - (one_minus_cosine.empty() ? 1 : std::clamp(one_minus_cosine.front(), 0.0, 2.0));
        lights.push_back(
            {Kind::spot, vector(light + ".position"), direction(light + ".axis"), std::acos(cosine)});
    }
    for (int i = 0; i < count("point_shadows"); ++i)
        lights.push_back(
            {Kind::point, vector(fmt::format("PointLights.lights[{}].position", i)), glm::dvec3(0), 0});
    return lights;
}

ShadowPlan shadow_plan(const std::vector<ShadowLight>& lights, const std::vector<Object>& objects,
                       const glm::dmat4& view, int side) {
    const ShadowedScene scene = shadowed_scene(objects);
    ShadowPlan plan;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const std::vector<ShadowCamera> own = shadow_cameras(lights[i], scene, side);
        add_values(plan.values, i, static_cast<int>(plan.cameras.size()), lights[i], own.front(), view);
        plan.cameras.insert(plan.cameras.end(), own.begin(), own.end());
    }
    return plan;
}

void ShadowMaps::attach(int layer) const {
    const GladGLContext& gl = resources_.context().gl();
    resources_.context().make_current();
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl.FramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, texture_.name, 0, layer);
    gl.Viewport(0, 0, side_, side_);
}

Image ShadowMaps::layer(int number) const {
    attach(number);
    Image image(side_, side_, 1);
    resources_.context().gl().ReadPixels(0, 0, side_, side_, GL_DEPTH_COMPONENT, GL_FLOAT,
                                         image.values.data());
    return image;
}

Result<ShadowMaps> draw_shadow_maps(const Context& context, const DepthPass& pass,
                                    const std::vector<ShadowLight>& lights,
                                    const std::vector<Object>& objects, const glm::dmat4& view,
                                    const std::vector<ObjectWithHoles>& with_holes) {
    std::vector<Object> whole = objects;
    std::erase_if(whole, [](const Object& object) { return object.shadow_shape != ShadowShape::whole; });
    GOBO_TRY(const Program program, link_program(context, pass.stages));
    set_bindings(context, program, pass.interface);
    const ShadowPlan plan = shadow_plan(lights, objects, view, pass.side);
    ShadowMaps maps(context, pass.side);
    maps.values_ = plan.values;
    const GladGLContext& gl = context.gl();
    context.make_current();
    const GLenum target = GL_TEXTURE_2D_ARRAY;
    maps.texture_ = {maps.resources_.make(&GladGLContext::GenTextures, &GladGLContext::DeleteTextures),
                     target};
    gl.BindTexture(target, maps.texture_.name);
    gl.TexImage3D(target, 0, GL_DEPTH_COMPONENT32F, pass.side, pass.side,
                  static_cast<GLsizei>(plan.cameras.size()), 0, GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
    for (const auto& [state, value] : {std::pair<GLenum, GLint>{GL_TEXTURE_MIN_FILTER, GL_LINEAR},
                                       {GL_TEXTURE_MAG_FILTER, GL_LINEAR},
                                       {GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE},
                                       {GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE},
                                       {GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE},
                                       {GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL}})
        gl.TexParameteri(target, state, value);
    maps.framebuffer_ =
        maps.resources_.make(&GladGLContext::GenFramebuffers, &GladGLContext::DeleteFramebuffers);
    gl.BindFramebuffer(GL_FRAMEBUFFER, maps.framebuffer_);
    gl.DrawBuffer(GL_NONE);
    gl.ReadBuffer(GL_NONE);
    for (std::size_t i = 0; i < plan.cameras.size(); ++i) {
        maps.attach(static_cast<int>(i));
        if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
            return fail(Fault::input, fmt::format("the driver gives no {} shadow maps of {} x {} texels",
                                                  plan.cameras.size(), pass.side, pass.side));
        GOBO_TRY_DO(draw_one(context, program, pass, plan.cameras[i], whole, with_holes));
    }
    return maps;
}

}  // namespace gobo
