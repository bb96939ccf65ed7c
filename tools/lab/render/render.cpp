#include "lab/render/render.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>
#define XXH_INLINE_ALL  // one hash is no reason to link a library
#include <xxhash.h>

#include "family/key.hpp"
#include "lab/render/chosen_values.hpp"

namespace gobo {
namespace {

constexpr double kGround = -0.75;

/// Scales the mesh into the box and puts it on the ground.
glm::dmat4 placed(const Mesh& mesh) {
    const glm::dvec3 box(3, 1.5, 3);
    const Bounds bounds = bounds_of(mesh);
    if (bounds.is_empty()) return glm::dmat4(1);
    const glm::dvec3& low = bounds.low;
    const glm::dvec3& high = bounds.high;
    const glm::dvec3 room = box / glm::max(high - low, glm::dvec3(1e-9));
    const double scale = std::min({room.x, room.y, room.z});
    const glm::dvec3 foot((low.x + high.x) / 2, low.y, (low.z + high.z) / 2);
    return glm::translate(glm::dmat4(1), glm::dvec3(0, kGround, 0)) *
           glm::scale(glm::dmat4(1), glm::dvec3(scale)) * glm::translate(glm::dmat4(1), -foot);
}

/// Whether the fragment stage may write gl_FragColor or gl_FragData, which are no outputs of an interface.
bool mentions_built_in_color(const std::vector<StageText>& stages) {
    return std::ranges::any_of(stages, [](const StageText& stage) {
        return stage.kind == StageKind::fragment && std::ranges::any_of(stage.pieces, [](const Piece& piece) {
                   return piece.text.find("gl_Frag") != std::string::npos &&
                          (piece.text.find("gl_FragColor") != std::string::npos ||
                           piece.text.find("gl_FragData") != std::string::npos);
               });
    });
}

/// Says of a picture that shows its background alone that it does.
Diagnostics warnings_of_nothing(const Picture& picture, bool is_written) {
    const bool is_covered = std::ranges::any_of(picture.depth.values, [](float depth) { return depth < 1; });
    if (is_covered && is_written) return {};
    Diagnostic warning;
    warning.severity = Severity::warning;
    warning.message = is_covered ? "the picture is the background alone: the fragment stage writes no color"
                                 : "the picture is the background alone: nothing of the objects is drawn";
    warning.help = is_covered ? "declare an output at location 0"
                              : "see what gl_Position is, and which fragments are discarded";
    return {warning};
}

}  // namespace

ViewedObject viewed_from(const View& view) {
    return {glm::dmat4(1),
            view.camera.view(),
            view.camera.projection(static_cast<double>(view.width) / view.height),
            {view.width, view.height}};
}

Result<Picture> take_picture(const Framebuffer& framebuffer, const std::array<float, 4>& background,
                             Diagnostics warnings, const std::function<void()>& draw) {
    framebuffer.bind();
    framebuffer.clear(background);
    draw();
    Picture picture{framebuffer.read_color(), framebuffer.read_depth(), std::move(warnings)};
    if (const GLenum error = framebuffer.context().gl().GetError(); error != GL_NO_ERROR)
        return fail(Fault::internal, fmt::format("OpenGL reports the error 0x{:04X} after drawing", error));
    return picture;
}

Result<Picture> render_permutation(const Context& context, const std::vector<StageText>& stages,
                                   const Interface& interface, const std::vector<Object>& objects,
                                   const std::vector<RenderValue>& values, const View& view,
                                   const GivenTextures& textures) {
    GOBO_TRY(const Framebuffer framebuffer, make_framebuffer(context, view.width, view.height, view.depth));
    GOBO_TRY(const Program program, link_program(context, stages));
    set_bindings(context, program, interface);
    GOBO_TRY(const DrawList list,
             make_draw_list(context, program, interface, objects, values, viewed_from(view), textures));
    const bool is_written = writes_color(interface) || mentions_built_in_color(stages);
    GOBO_TRY(Picture picture, take_picture(framebuffer, view.background, list.warnings(), [&] {
                 const GladGLContext& gl = context.gl();
                 const GLboolean written = is_written ? GL_TRUE : GL_FALSE;
                 gl.ColorMask(written, written, written, written);
                 list.draw();
                 gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
             }));
    picture.background_alone = warnings_of_nothing(picture, is_written);
    return picture;
}

std::string picture_name(std::string_view key_text) {
    constexpr std::size_t kLongest = 200;
    std::string name;
    for (const char character : key_text) name += character == '=' ? '-' : character == ' ' ? '+' : character;
    if (name.size() <= kLongest) return name;
    const XXH64_hash_t hash = XXH3_64bits(key_text.data(), key_text.size());
    return fmt::format("{}+{:016x}", name.substr(0, kLongest - 17), hash);
}

std::vector<Object> demo_objects(Mesh mesh) {
    const glm::dmat4 model = placed(mesh);
    // Fine enough for light computed at the vertices to show its cones.
    return {{std::move(mesh), model, {}, false, true},
            {make_plane(12, 96), glm::translate(glm::dmat4(1), glm::dvec3(0, kGround, 0)), {}, false, false}};
}

Camera demo_camera() {
    return {.position = {0, 1.5, 5}, .target = {0, -0.05, 0}, .field_of_view = 0.6, .far_plane = 50};
}

void Framebuffer::bind() const {
    const Context& context = resources_.context();
    context.make_current();
    context.gl().BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    context.gl().Viewport(0, 0, width_, height_);
}

void Framebuffer::clear(const std::array<float, 4>& background) const {
    const GladGLContext& gl = resources_.context().gl();
    gl.ClearColor(background[0], background[1], background[2], background[3]);
    gl.ClearDepth(1);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

Image Framebuffer::read(int channels, GLenum format) const {
    bind();
    const GladGLContext& gl = resources_.context().gl();
    Image upside_down(width_, height_, channels);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
    gl.ReadPixels(0, 0, width_, height_, format, GL_FLOAT, upside_down.values.data());
    Image image(width_, height_, channels);
    const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(width_) * channels;
    for (std::ptrdiff_t y = 0; y < height_; ++y)
        std::copy_n(upside_down.values.begin() + (height_ - 1 - y) * row, row,
                    image.values.begin() + y * row);
    return image;
}

Result<Framebuffer> make_framebuffer(const Context& context, int width, int height, DepthFormat depth) {
    context.make_current();
    const GladGLContext& gl = context.gl();
    GLint largest = 0;
    gl.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
    if (width < 1 || height < 1 || width > largest || height > largest)
        return fail(Fault::usage, fmt::format("cannot draw a picture of {} x {} pixels", width, height),
                    fmt::format("choose both from 1 to {}", largest));
    Framebuffer framebuffer(context, width, height);
    GlResources& resources = framebuffer.resources_;
    framebuffer.framebuffer_ =
        resources.make(&GladGLContext::GenFramebuffers, &GladGLContext::DeleteFramebuffers);
    framebuffer.bind();
    const auto attach = [&](GLenum attachment, GLenum format) {
        const GLuint name =
            resources.make(&GladGLContext::GenRenderbuffers, &GladGLContext::DeleteRenderbuffers);
        gl.BindRenderbuffer(GL_RENDERBUFFER, name);
        gl.RenderbufferStorage(GL_RENDERBUFFER, format, width, height);
        gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, name);
    };
    attach(GL_COLOR_ATTACHMENT0, GL_RGBA32F);
    attach(GL_DEPTH_ATTACHMENT, depth == DepthFormat::bits24 ? GL_DEPTH_COMPONENT24 : GL_DEPTH_COMPONENT32F);
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        return fail(Fault::input,
                    fmt::format("the driver gives no framebuffer of {} x {} float pixels", width, height));
    return framebuffer;
}

}  // namespace gobo
