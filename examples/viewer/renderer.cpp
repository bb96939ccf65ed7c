#include "renderer.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <tuple>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#define GOBO_GL_NO_LOADER
#include <gobo/gl.hpp>

#include "depth.hpp"
#include "lab/render/camera.hpp"
#include "lab/render/texture.hpp"
#include "light_blocks.hpp"

namespace viewer {
namespace {

constexpr int frames_timed = 9;

template <class Vector>
GLuint buffer_of(const GladGLContext& gl, GLenum target, const std::vector<Vector>& values) {
    GLuint buffer = 0;
    gl.GenBuffers(1, &buffer);
    gl.BindBuffer(target, buffer);
    gl.BufferData(target, static_cast<GLsizeiptr>(values.size() * sizeof(Vector)), values.data(),
                  GL_STATIC_DRAW);
    return buffer;
}

template <class Vector>
void add_attribute(const GladGLContext& gl, int location, const std::vector<Vector>& values) {
    if (location < 0 || values.empty()) return;
    buffer_of(gl, GL_ARRAY_BUFFER, values);
    gl.EnableVertexAttribArray(static_cast<GLuint>(location));
    gl.VertexAttribPointer(static_cast<GLuint>(location), Vector::length(), GL_FLOAT, GL_FALSE, 0, nullptr);
}

/// `pbr` shares pieces with `lit`, and with them the blocks Transform, Ambient, Hemisphere, Harmonics and
/// Fog.
lit::Transform transform_block(const glm::dmat4& model_view, const glm::dmat4& projection) {
    lit::Transform transform{};
    transform.modelView = glm::mat4(model_view);
    transform.projection = glm::mat4(projection);
    transform.normalMatrix = glm::mat3(gobo::normal_matrix(model_view));
    return transform;
}

/// In eye space, as all of lit's directions.
lit::Hemisphere hemisphere_block(const gobo::scene::Probe& probe, const glm::dmat4& view) {
    lit::Hemisphere block{};
    block.up = glm::vec3(glm::dmat3(view) * probe.up);
    block.sky = glm::vec3(probe.sky);
    block.ground = glm::vec3(probe.ground);
    return block;
}

lit::Harmonics harmonics_block(const gobo::scene::Probe& probe, const glm::dmat4& view) {
    lit::Harmonics block{};
    block.toProbe = glm::mat3(glm::transpose(glm::dmat3(view)));
    for (std::size_t i = 0; i < probe.coefficients.size(); ++i)
        block.coefficients[i] = glm::vec3(probe.coefficients[i]);
    block.scale = static_cast<float>(probe.scale);
    return block;
}

/// Whether the texts are those that the header has.
template <class Permutation>
bool is_as_built(const gobo::ReloadedProgram& program, const Permutation& permutation) {
    bool is_same = true;
    gobo::runtime::for_each_stage(permutation, [&](gobo::runtime::StageKind kind, const auto& stage) {
        const auto other = std::find_if(program.stages.begin(), program.stages.end(),
                                        [&](const auto& reloaded) { return reloaded.kind == kind; });
        is_same = is_same && other != program.stages.end() && other->text == stage.source();
    });
    return is_same;
}

}  // namespace

Renderer::Renderer(const GladGLContext& gl, const Stage& stage, Size size, gobo::KeyRecord& record,
                   const std::string& reload)
    : gl_(gl),
      stage_(stage),
      size_(size),
      record_(record),
      reload_(reload),
      textures_(gl),
      shadows_(gl, stage) {
    make_framebuffer();
    if (stage.scene.is_physical) make_environment();
    for (const StageDraw& draw : stage.draws) {
        upload(draw.mesh);
        for (const std::string& effect : draw.not_drawn)
            complain(effect, draw.name + " needs " + effect + ", which this viewer does not draw");
    }
}

void Renderer::make_framebuffer() {
    GLuint buffers[2] = {};
    gl_.GenFramebuffers(1, &framebuffer_);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl_.GenRenderbuffers(2, buffers);
    gl_.BindRenderbuffer(GL_RENDERBUFFER, buffers[0]);
    gl_.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA32F, size_.width, size_.height);
    gl_.BindRenderbuffer(GL_RENDERBUFFER, buffers[1]);
    gl_.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, size_.width, size_.height);
    gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers[0]);
    gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers[1]);
}

void Renderer::make_environment() {
    const gobo::Result<EnvironmentMaps> maps = studio_maps();
    if (!maps) return complain("studio", "there is no studio: " + maps.error().front().message);
    diffuse_map_ = textures_.of(maps->diffuse);
    specular_map_ = textures_.of(maps->specular);
}

void Renderer::upload(const gobo::Mesh& mesh) {
    Vertices vertices;
    vertices.count = static_cast<GLsizei>(mesh.indices.size());
    gl_.GenVertexArrays(1, &vertices.array);
    gl_.BindVertexArray(vertices.array);
    add_attribute(gl_, lit::attribute::position, mesh.positions);
    add_attribute(gl_, lit::attribute::normal, mesh.normals);
    add_attribute(gl_, lit::attribute::color, mesh.colors);
    add_attribute(gl_, pbr::attribute::texcoord, mesh.texcoords);
    add_attribute(gl_, pbr::attribute::texcoord1, mesh.texcoords1);
    add_attribute(gl_, pbr::attribute::tangent, mesh.tangents);
    buffer_of(gl_, GL_ELEMENT_ARRAY_BUFFER, mesh.indices);
    vertices_.push_back(vertices);
}

template <class Block>
void Renderer::set(const Block& block) {
    GLuint& buffer = blocks_[Block::binding];
    if (buffer == 0) gl_.GenBuffers(1, &buffer);
    gl_.BindBufferBase(GL_UNIFORM_BUFFER, static_cast<GLuint>(Block::binding), buffer);
    gl_.BufferData(GL_UNIFORM_BUFFER, sizeof block, &block, GL_STREAM_DRAW);
}

void Renderer::complain(const std::string& key, const std::string& why) {
    if (complained_.insert(key).second) complaints_.push_back(why);
}

template <class Key>
GLuint Renderer::program_of(const Key& key) {
    const std::string text = key_text(key);
    const auto* const permutation = find(key);
    if (permutation == nullptr) {
        record_.note(text);
        complain(text, describe_missing(key));
        return 0;
    }
    keys_.insert(text);
    Built& built = programs_[permutation];
    if (built.build) return built.id;
    built.key = text;
    built.build = [this, permutation](const gobo::ReloadedProgram* texts) {
        const gobo::gl::Program program = texts != nullptr
                                              ? gobo::gl::build_program(*permutation, texts->stages, gl_)
                                              : gobo::gl::build_program(*permutation, gl_);
        return std::pair(GLuint{program.id}, program.error);
    };
    built.is_as_built = [permutation](const gobo::ReloadedProgram& texts) {
        return viewer::is_as_built(texts, *permutation);
    };
    const auto reloaded = reloaded_.find(text);
    if (reloaded != reloaded_.end()) built.id = built.build(&reloaded->second).first;
    std::string error;
    if (built.id == 0) std::tie(built.id, error) = built.build(nullptr);
    if (built.id == 0) complain(text, error);
    return built.id;
}

std::string Renderer::take_changes() {
    std::size_t changed = 0;
    reload_.take([&](const gobo::ReloadedProgram& program) {
        const bool is_first = reloaded_.find(program.key) == reloaded_.end();
        reloaded_[program.key] = program;
        for (auto& [permutation, built] : programs_) {
            if (built.key != program.key || (is_first && built.is_as_built(program))) continue;
            const auto [id, error] = built.build(&program);
            if (id == 0) {  // the old one stays
                complaints_.push_back(program.key + ": " + error);
                continue;
            }
            gl_.DeleteProgram(built.id);
            built.id = id;
            ++changed;
        }
    });
    const std::string errors = reload_.errors();
    if (errors != reload_errors_ && !errors.empty()) complaints_.push_back(errors);
    const bool is_new_error = errors != reload_errors_;
    reload_errors_ = errors;
    if (changed > 0)
        return std::to_string(changed) + (changed == 1 ? " program changed" : " programs changed");
    return is_new_error ? (errors.empty() ? "errors are mended" : "errors") : "";
}

void Renderer::set_classic(const StageDraw& draw, const glm::dmat4& view) {
    const auto lights = light_blocks<ClassicLights>(stage_, draw, view);
    set(draw.material);
    set(draw.toon);
    set(lights.directional);
    set(lights.point);
    set(lights.spot);
}

void Renderer::set_physical(const StageDraw& draw, const glm::dmat4& view) {
    const PhysicalDraw& physical = *draw.physical;
    const auto lights = light_blocks<PhysicalLights>(stage_, draw, view);
    const glm::mat3 to_world(glm::transpose(glm::dmat3(view)));
    pbr::ImageLight image_light{};
    image_light.color = glm::vec3(stage_.scene.ambient);
    image_light.weight = static_cast<float>(draw.probe.share);
    image_light.toMap = to_world;
    pbr::Reflection reflection{};
    reflection.toMap = to_world;
    reflection.weight = physical.mirrored;
    reflection.roughestLevel = static_cast<float>(gobo::kRoughnessLevels - 1);
    set(physical.material);
    set(physical.iridescence);
    set(physical.placements);
    set(physical.cutout);
    set(image_light);
    set(reflection);
    set(lights.directional);
    set(lights.point);
    set(lights.spot);
    const auto bind = [&](int unit, GLenum target, GLuint texture) {
        gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
        gl_.BindTexture(target, texture);
    };
    bind(pbr::sampler::diffuseMap, GL_TEXTURE_CUBE_MAP, diffuse_map_);
    bind(pbr::sampler::specularMap, GL_TEXTURE_CUBE_MAP, specular_map_);
    constexpr std::array<int, gobo::scene::kMapFeatures.size()> units = {
        pbr::sampler::baseColorMap, pbr::sampler::metallicRoughnessMap, pbr::sampler::normalMap,
        pbr::sampler::occlusionMap, pbr::sampler::emissiveMap};
    for (std::size_t map = 0; map < units.size(); ++map) {
        const auto& use = physical.maps[map];
        if (!use) continue;
        const auto kind = static_cast<gobo::scene::MapKind>(map);
        const bool is_color =
            kind == gobo::scene::MapKind::base_color || kind == gobo::scene::MapKind::emissive;
        const GLuint texture = textures_.of(stage_.scene.pictures[use->picture], *use, is_color);
        bind(units[map], GL_TEXTURE_2D, texture);
    }
}

void Renderer::draw(std::size_t number, const Settings& settings, const glm::dmat4& view,
                    const glm::dmat4& projection) {
    const StageDraw& draw = stage_.draws[number];
    const GLuint program = draw.physical ? program_of(pbr::select(under(draw.physical->state, settings)))
                                         : program_of(lit::select(under(draw.state, settings)));
    if (program == 0) return;
    set(transform_block(view * draw.model, projection));
    set(lit::Ambient{glm::vec3(stage_.scene.ambient), {}});
    set(hemisphere_block(draw.probe, view));
    set(harmonics_block(draw.probe, view));
    set(draw.fog);
    if (draw.physical)
        set_physical(draw, view);
    else
        set_classic(draw, view);
    set(shadows_.block(draw, settings, view));
    gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(lit::sampler::shadowMaps));
    gl_.BindTexture(GL_TEXTURE_2D_ARRAY, shadows_.texture());
    draw_mesh(number, program);
}

void Renderer::draw_depths(const gobo::ShadowCamera& camera) {
    const GLuint program = program_of(depth::Key());
    for (std::size_t i = 0; i < stage_.draws.size(); ++i) {
        if (stage_.draws[i].physical && stage_.draws[i].physical->is_blended) continue;
        set(transform_block(camera.view * stage_.draws[i].model, camera.projection));
        draw_mesh(i, program);
    }
}

void Renderer::draw_mesh(std::size_t number, GLuint program) {
    const StageDraw& draw = stage_.draws[number];
    const bool is_mirrored = glm::determinant(glm::dmat3(draw.model)) < 0;
    if (draw.double_sided)
        gl_.Disable(GL_CULL_FACE);
    else
        gl_.Enable(GL_CULL_FACE);
    gl_.CullFace(is_mirrored ? GL_FRONT : GL_BACK);
    gl_.UseProgram(program);
    gl_.BindVertexArray(vertices_[number].array);
    gl_.DrawElements(GL_TRIANGLES, vertices_[number].count, GL_UNSIGNED_INT, nullptr);
}

void Renderer::draw(const Settings& settings, const Orbit& orbit) {
    shadows_.draw([&](const gobo::ShadowCamera& camera) { draw_depths(camera); });
    keys_.clear();
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl_.Viewport(0, 0, size_.width, size_.height);
    const auto& background = orbit.start.background;
    gl_.ClearColor(background[0], background[1], background[2], background[3]);
    gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl_.Enable(GL_DEPTH_TEST);
    const glm::dmat4 view = orbit.view();
    std::vector<std::size_t> blended;
    for (std::size_t i = 0; i < stage_.draws.size(); ++i) {
        if (stage_.draws[i].physical && stage_.draws[i].physical->is_blended)
            blended.push_back(i);
        else
            draw(i, settings, view, orbit.start.projection);
    }
    // Behind all others, the farthest first.
    const auto depth = [&](std::size_t i) { return (view * glm::dvec4(stage_.draws[i].middle, 1)).z; };
    std::ranges::stable_sort(blended, {}, depth);
    gl_.Enable(GL_BLEND);
    gl_.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    gl_.DepthMask(GL_FALSE);
    for (const std::size_t i : blended) draw(i, settings, view, orbit.start.projection);
    gl_.DepthMask(GL_TRUE);
    gl_.Disable(GL_BLEND);
}

double Renderer::frame_time(const Settings& settings, const Orbit& orbit) {
    using Clock = std::chrono::steady_clock;
    draw(settings, orbit);  // programs are built here
    gl_.Finish();
    std::vector<double> times;
    for (int i = 0; i < frames_timed; ++i) {
        const Clock::time_point start = Clock::now();
        draw(settings, orbit);
        gl_.Finish();
        times.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    }
    std::nth_element(times.begin(), times.begin() + frames_timed / 2, times.end());
    return times[frames_timed / 2];
}

gobo::Image Renderer::picture() const {
    gobo::Image image(size_.width, size_.height, 4);
    std::vector<float> upward(image.values.size());
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    gl_.ReadPixels(0, 0, size_.width, size_.height, GL_RGBA, GL_FLOAT, upward.data());
    const std::size_t row = upward.size() / static_cast<std::size_t>(size_.height);
    for (std::size_t y = 0; y < static_cast<std::size_t>(size_.height); ++y)  // OpenGL's rows run up
        std::copy_n(upward.end() - static_cast<std::ptrdiff_t>((y + 1) * row), row,
                    image.values.begin() + static_cast<std::ptrdiff_t>(y * row));
    for (std::size_t i = 3; i < image.values.size(); i += 4) image.values[i] = 1;  // what is blended, too
    return image;
}

void Renderer::show(Size window) const {
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    gl_.Enable(GL_FRAMEBUFFER_SRGB);
    gl_.BlitFramebuffer(0, 0, size_.width, size_.height, 0, 0, window.width, window.height,
                        GL_COLOR_BUFFER_BIT, GL_LINEAR);
    gl_.Disable(GL_FRAMEBUFFER_SRGB);
}

std::vector<std::string> Renderer::take_complaints() {
    return std::exchange(complaints_, {});
}

}  // namespace viewer
