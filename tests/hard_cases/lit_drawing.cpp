#include "lit_drawing.hpp"

#include <algorithm>
#include <cstring>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <spirv/unified1/spirv.hpp>

namespace gobo {
namespace {

const std::vector<double>* value_of(const evaluate::Invocations& invocation, const std::string& name) {
    const auto found = invocation.values.find(name);
    return found == invocation.values.end() ? nullptr : &found->second;
}

bool is_handed_on(const evaluate::Port& port) {
    return !port.name.starts_with("gl_");
}

/// A varying as it is declared: an element of an array stands for all of it.
struct Declared {
    const evaluate::Port* first = nullptr;
    int elements = 0;  ///< 0: no array
};

std::map<std::string, Declared> declared_varyings(const evaluate::Program& fragment) {
    std::map<std::string, Declared> declared;
    for (const evaluate::Port& port : fragment.inputs) {
        if (!is_handed_on(port)) continue;
        const std::size_t bracket = port.name.find('[');
        Declared& whole = declared[port.name.substr(0, bracket)];
        const int index = bracket == std::string::npos ? -1 : std::stoi(port.name.substr(bracket + 1));
        if (whole.first == nullptr || index == 0) whole.first = &port;
        whole.elements = std::max(whole.elements, index + 1);
    }
    return declared;
}

/// A vertex stage that gives the fragment stage what uniforms hold, at one pixel or over the whole target.
std::string feeding_stage(const evaluate::Program& fragment) {
    std::string outputs;
    std::string body;
    int index = 0;
    for (const auto& [name, varying] : declared_varyings(fragment))
        outputs += fmt::format("layout(location = {}) {}out {} {}{};\n", varying.first->location,
                               varying.first->scalar == evaluate::Scalar::float32 ? "" : "flat ",
                               varying.first->type, name,
                               varying.elements > 0 ? fmt::format("[{}]", varying.elements) : "");
    for (const evaluate::Port& port : fragment.inputs) {
        if (!is_handed_on(port)) continue;
        const std::string parts = std::string("xyzw").substr(0, port.components);
        body += fmt::format("    {} = {}(given[{}].{});\n", port.name, port.type, index++, parts);
    }
    return "#version 450\n" + outputs +
           "uniform vec4 given[32];\nuniform float depth;\nuniform bool covers;\n"
           "void main() {\n" +
           body +
           "    vec2 corner = vec2(gl_VertexID % 2, gl_VertexID / 2) * 4.0 - 1.0;\n"
           "    gl_Position = vec4(covers ? corner : vec2(0.0), depth * 2.0 - 1.0, 1.0);\n"
           "}\n";
}

std::unique_ptr<Program> linked(const Context& context, const std::vector<StageText>& stages) {
    Result<Program> program = link_program(context, stages);
    EXPECT_TRUE(program) << (program ? "" : to_text(program.error().front()));
    return program ? std::make_unique<Program>(std::move(*program)) : nullptr;
}

/// The bytes of a uniform block, filled from an invocation's values.
std::vector<std::byte> bytes_of(const evaluate::Program& stage, std::size_t block,
                                const evaluate::Invocations& invocation) {
    std::vector<std::byte> bytes((stage.uniform_blocks[block].size + 15) / 16 * 16);
    for (const evaluate::Port& port : stage.uniforms) {
        const std::vector<double>* numbers = value_of(invocation, port.name);
        if (port.block != static_cast<int>(block) || numbers == nullptr) continue;
        for (std::size_t i = 0; i < port.components; ++i) {
            const auto real = static_cast<float>((*numbers)[i]);
            const auto whole =
                port.scalar == evaluate::Scalar::float32 ? 0 : static_cast<std::int32_t>((*numbers)[i]);
            std::memcpy(bytes.data() + port.offsets[i],
                        port.scalar == evaluate::Scalar::float32 ? static_cast<const void*>(&real) : &whole,
                        4);
        }
    }
    return bytes;
}

constexpr GLsizei kSide = 4;  // texels

/// An array of shadow maps, bound to the active unit.
GLuint depth_texture(const GladGLContext& gl, float depth) {
    constexpr GLsizei kLayers = 64;
    const std::vector<float> texels(kSide * kSide * kLayers, depth);
    GLuint texture = 0;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D_ARRAY, texture);
    gl.TexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_DEPTH_COMPONENT32F, kSide, kSide, kLayers, 0, GL_DEPTH_COMPONENT,
                  GL_FLOAT, texels.data());
    for (const GLenum name : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        gl.TexParameteri(GL_TEXTURE_2D_ARRAY, name, GL_LINEAR);
    for (const GLenum name : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        gl.TexParameteri(GL_TEXTURE_2D_ARRAY, name, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    return texture;
}

/// A picture of one colour, or a cube of six, bound to the active unit.
GLuint color_texture(const GladGLContext& gl, const std::array<double, 4>& color, bool is_cube) {
    std::vector<float> texels;
    for (int texel = 0; texel < kSide * kSide; ++texel)
        for (const double channel : color) texels.push_back(static_cast<float>(channel));
    const GLenum target = is_cube ? GL_TEXTURE_CUBE_MAP : GL_TEXTURE_2D;
    GLuint texture = 0;
    gl.GenTextures(1, &texture);
    gl.BindTexture(target, texture);
    for (GLenum face = 0; face < (is_cube ? 6U : 1U); ++face)
        gl.TexImage2D(is_cube ? GL_TEXTURE_CUBE_MAP_POSITIVE_X + face : target, 0, GL_RGBA32F, kSide, kSide,
                      0, GL_RGBA, GL_FLOAT, texels.data());
    for (const GLenum name : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        gl.TexParameteri(target, name, GL_NEAREST);
    return texture;
}

constexpr float kCleared = -1;  // in every channel, as no permutation writes it

}  // namespace

LitDrawing::LitDrawing(const Context& context, const LitUnderTest& lit, std::size_t permutation)
    : context_(context), lit_(lit), permutation_(permutation) {
    context_.make_current();
    const Composition& composition = lit.composition();
    const StageNumbers& stages = composition.permutations[permutation].stages;
    const StageText fragment = stage_text(composition, stages[StageKind::fragment]);
    own_ = linked(context, {stage_text(composition, stages[StageKind::vertex]), fragment});
    const StageText feeding =
        stage_text(StageKind::vertex, "feeding.vert", feeding_stage(lit.fragment(permutation)));
    handed_on_ = linked(context, {feeding, fragment});
    context_.gl().GenVertexArrays(1, &array_);
}

LitDrawing::~LitDrawing() {
    context_.make_current();
    for (const GLuint texture : textures_) context_.gl().DeleteTextures(1, &texture);
    for (const Buffer& buffer : buffers_) context_.gl().DeleteBuffers(1, &buffer.name);
    context_.gl().DeleteVertexArrays(1, &array_);
}

void LitDrawing::set_uniforms(const Program& program, const evaluate::Program& stage,
                              const evaluate::Invocations& invocation) {
    const GladGLContext& gl = context_.gl();
    for (std::size_t block = 0; block < stage.uniform_blocks.size(); ++block) {
        const std::string& name = stage.uniform_blocks[block].name;
        const GLuint index = gl.GetUniformBlockIndex(program.id(), name.c_str());
        if (index == GL_INVALID_INDEX) continue;
        auto buffer = std::find_if(buffers_.begin(), buffers_.end(),
                                   [&](const Buffer& other) { return other.block == name; });
        if (buffer == buffers_.end()) {
            buffer = buffers_.insert(buffer, {name, 0});
            gl.GenBuffers(1, &buffer->name);
        }
        const std::vector<std::byte> bytes = bytes_of(stage, block, invocation);
        const auto binding = static_cast<GLuint>(buffer - buffers_.begin());
        gl.BindBuffer(GL_UNIFORM_BUFFER, buffer->name);
        gl.BufferData(GL_UNIFORM_BUFFER, static_cast<GLsizeiptr>(bytes.size()), bytes.data(), GL_STREAM_DRAW);
        gl.BindBufferBase(GL_UNIFORM_BUFFER, binding, buffer->name);
        gl.UniformBlockBinding(program.id(), index, binding);
    }
}

/// Textures of one colour, or one depth: what the case's images answer, whatever they are asked.
void LitDrawing::set_textures(const Program& program, const evaluate::Program& stage,
                              const evaluate::Invocations& invocation) {
    for (const evaluate::ImagePort& port : stage.images) {
        const auto image = invocation.images.find(port.name);
        const GLint location = context_.gl().GetUniformLocation(program.id(), port.name.c_str());
        if (image == invocation.images.end() || location < 0) continue;
        evaluate::ImageRequest request;
        request.what = evaluate::ImageRequest::What::fetch;
        const std::array<double, 4> color = image->second(request);
        context_.gl().Uniform1i(location, static_cast<GLint>(textures_.size()));
        context_.gl().ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(textures_.size()));
        const bool is_cube = port.type.dimension == spv::DimCube;
        textures_.push_back(port.type.depth ? depth_texture(context_.gl(), static_cast<float>(color[0]))
                                            : color_texture(context_.gl(), color, is_cube));
    }
}

void LitDrawing::set_attributes(const evaluate::Invocations& vertex) {
    for (const evaluate::Port& port : lit_.vertex(permutation_).inputs) {
        const std::vector<double>* numbers = value_of(vertex, port.name);
        if (!is_handed_on(port) || numbers == nullptr) continue;
        const auto location = static_cast<GLuint>(port.location);
        if (port.scalar == evaluate::Scalar::float32) {
            float values[4] = {0, 0, 0, 1};
            for (std::size_t i = 0; i < port.components; ++i) values[i] = static_cast<float>((*numbers)[i]);
            context_.gl().VertexAttrib4fv(location, values);
        } else {
            context_.gl().VertexAttribI4i(location, static_cast<int>(numbers->front()), 0, 0, 0);
        }
    }
}

void LitDrawing::set_handed_on(const evaluate::Invocations& fragment, double depth) {
    const GladGLContext& gl = context_.gl();
    std::vector<float> given(32 * 4);
    std::size_t index = 0;
    for (const evaluate::Port& port : lit_.fragment(permutation_).inputs) {
        if (!is_handed_on(port)) continue;
        if (const std::vector<double>* numbers = value_of(fragment, port.name))
            for (std::size_t i = 0; i < port.components; ++i)
                given[index * 4 + i] = static_cast<float>((*numbers)[i]);
        ++index;
    }
    gl.Uniform4fv(gl.GetUniformLocation(handed_on_->id(), "given"), 32, given.data());
    gl.Uniform1f(gl.GetUniformLocation(handed_on_->id(), "depth"), static_cast<float>(depth));
}

bool LitDrawing::names_fragment_input(const Inputs& inputs) const {
    const auto& ports = lit_.fragment(permutation_).inputs;
    return std::any_of(ports.begin(), ports.end(), [&](const evaluate::Port& port) {
        // A case names all elements of an array at once: "lightRays[]".
        const std::string all = port.name.substr(0, port.name.find('[')) + "[]";
        return is_handed_on(port) && (inputs.contains(port.name) || inputs.contains(all));
    });
}

Shaded LitDrawing::draw(const Inputs& inputs, DepthFormat depth_format) {
    const Result<Framebuffer> target = make_framebuffer(context_, 1, 1, depth_format);
    EXPECT_TRUE(target);
    Shaded shaded;
    if (!target || !own_ || !handed_on_) return shaded;
    target->bind();
    const GladGLContext& gl = context_.gl();
    gl.ClearColor(kCleared, kCleared, kCleared, kCleared);
    gl.ClearDepth(0.25);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_ALWAYS);
    gl.BindVertexArray(array_);
    const auto own_depth = inputs.find("gl_FragCoord");
    const double depth = own_depth == inputs.end() ? 0.5 : own_depth->second[2];
    StageInputs stages = lit_.inputs_of(permutation_, inputs, sanitize::Machine::ieee);
    const auto front = inputs.find("gl_FrontFacing");
    const bool is_back = front != inputs.end() && front->second[0] == 0;
    const bool is_fed = is_back || names_fragment_input(inputs);
    const Program& program = is_fed ? *handed_on_ : *own_;
    gl.UseProgram(program.id());
    // Whatever the position: the pixel, at that depth.
    stages.vertex.values["Transform.projection"] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2 * depth - 1,
                                                    1};
    if (is_fed) {
        set_handed_on(stages.fragment, depth);
        gl.Uniform1i(gl.GetUniformLocation(program.id(), "covers"), is_back ? 1 : 0);
    } else {
        set_uniforms(program, lit_.vertex(permutation_), stages.vertex);
        set_attributes(stages.vertex);
    }
    for (const GLuint texture : textures_) gl.DeleteTextures(1, &texture);
    textures_.clear();
    set_textures(program, lit_.vertex(permutation_), stages.vertex);
    set_textures(program, lit_.fragment(permutation_), stages.fragment);
    // A block that both stages read is the same for both but for the projection, which no fragment reads.
    const evaluate::Program& fragment = lit_.fragment(permutation_);
    set_uniforms(program, fragment, stages.fragment);
    gl.FrontFace(is_back ? GL_CW : GL_CCW);  // points have no back
    gl.DrawArrays(is_back ? GL_TRIANGLES : GL_POINTS, 0, is_back ? 3 : 1);
    EXPECT_EQ(gl.GetError(), static_cast<GLenum>(GL_NO_ERROR));
    const Image color = target->read_color();
    for (int channel = 0; channel < 4; ++channel)
        shaded.color[static_cast<std::size_t>(channel)] = color.at(0, 0, channel);
    shaded.is_discarded = color.at(0, 0, 0) == kCleared && color.at(0, 0, 3) == kCleared;
    shaded.depth = target->read_depth().at(0, 0, 0);
    return shaded;
}

void LitDrawing::cover(const Inputs& inputs) {
    const GladGLContext& gl = context_.gl();
    const StageInputs stages = lit_.inputs_of(permutation_, inputs, sanitize::Machine::ieee);
    gl.BindVertexArray(array_);
    gl.UseProgram(handed_on_->id());
    set_handed_on(stages.fragment, 0.5);
    set_uniforms(*handed_on_, lit_.fragment(permutation_), stages.fragment);
    if (textures_.empty()) set_textures(*handed_on_, lit_.fragment(permutation_), stages.fragment);
    gl.Uniform1i(gl.GetUniformLocation(handed_on_->id(), "covers"), 1);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace gobo
