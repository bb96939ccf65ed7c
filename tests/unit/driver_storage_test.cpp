// What the evaluator says that a fragment writes to storage blocks and images, against what a driver writes.
#include <array>

#include <gtest/gtest.h>

#include "evaluate_support.hpp"
#include "lab/render/program.hpp"
#include "lab/render/render.hpp"

namespace gobo::evaluate {
namespace {

constexpr int kSide = 8;
constexpr std::size_t kPixels = kSide * kSide;

constexpr const char* kVertex = R"(#version 450
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }
)";
/// Each pixel has an element and a texel of its own, so that the order of pixels is no matter.
constexpr const char* kDeclarations = R"(#version 450
#extension GL_ARB_gpu_shader_int64 : require
layout(std430, binding = 0) buffer Numbers { int numbers[64]; };
layout(std430, binding = 1) buffer Vectors { vec4 vectors[64]; };
layout(std430, binding = 2) buffer Matrices { layout(row_major) mat3 turns[64]; };
layout(binding = 0, rgba32f) uniform image2D colors;
layout(binding = 1, r32ui) uniform uimage2D words;
layout(location = 0) out vec4 r;
void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    int at = p.y * 8 + p.x;
    r = vec4(0.0);
)";

struct Case {
    const char* name;
    const char* body;
};

const Case kCases[] = {
    {"nothing", ""},
    {"a_number", "numbers[at] = numbers[at] * 2 - p.x;"},
    {"in_a_branch", "if (p.x > p.y) numbers[at] = 7; else vectors[at].z = 9.0;"},
    {"in_a_loop", "for (int k = 0; k < p.x; ++k) { numbers[at] += k; vectors[at][k % 4] *= 2.0; }"},
    {"a_vector", "vectors[at] = vectors[at].wzyx + vec4(p, 0.5, 0.25); vectors[at].y = 3.0;"},
    {"a_matrix_by_rows",
     "turns[at][p.x % 3] = vec3(1.0, 2.0, 3.0); vectors[at].xyz = turns[at] * vec3(1.0, 0.0, 2.0);"},
    {"atomic_sums", "vectors[at].x = float(atomicAdd(numbers[at], 5) + atomicAdd(numbers[at], -9));"},
    {"atomic_extremes",
     "vectors[at].x = float(atomicMax(numbers[at], 3)); vectors[at].y = float(atomicMin(numbers[at], 30));"},
    {"atomic_bits",
     "atomicAnd(numbers[at], 0x3c); atomicOr(numbers[at], 1 << p.x); vectors[at].x = "
     "float(atomicXor(numbers[at], 5));"},
    {"atomic_exchanges",
     "vectors[at].x = float(atomicExchange(numbers[at], p.y)); vectors[at].y = "
     "float(atomicCompSwap(numbers[at], "
     "3, -1)); vectors[at].z = float(atomicCompSwap(numbers[at], p.y, 11));"},
    {"a_texel", "imageStore(colors, p, imageLoad(colors, p).yxwz * 2.0);"},
    {"a_texel_read_again",
     "imageStore(colors, p, vec4(p, 1.0, 2.0)); vectors[at] = imageLoad(colors, p) * 3.0;"},
    {"outside_of_the_image",
     "vectors[at] = imageLoad(colors, -1 - p); imageStore(colors, p - 8, vec4(5.0));"},
    {"the_size_of_an_image", "numbers[at] = imageSize(colors).x * 10 + imageSize(words).y;"},
    {"atomics_of_a_texel",
     "uint n = imageAtomicAdd(words, p, 4u); n += imageAtomicMax(words, p, 120u) * 2u; numbers[at] = int(n + "
     "imageAtomicCompSwap(words, p, 120u, 1u));"},
    {"doubles",
     "double d = double(numbers[at]) / 3.0lf + 1e-12lf; vectors[at] = vec4(d * 3.0lf - double(numbers[at]), "
     "fract(d), sqrt(abs(d)), mod(d, 0.7lf)); numbers[at] = int(floor(d * 1e7lf));"},
    {"doubles_in_matrices",
     "dmat3 m = dmat3(turns[at]) * dmat3(0.1lf); m[0] += dvec3(1e-3lf); turns[at] = mat3(m * m); "
     "vectors[at].x = float(determinant(dmat2(vectors[at])));"},
    {"bits_of_doubles",
     "uvec2 u = unpackDouble2x32(double(numbers[at]) / 3.0lf); numbers[at] = int(u.x ^ u.y);"},
    {"integers_of_64_bits",
     "int64_t l = int64_t(numbers[at]) * 123456789123l; numbers[at] = int((l >> 20) ^ (l / 1000l)) + int(l < "
     "0l);"},
    {"unsigned_integers_of_64_bits",
     "uint64_t u = uint64_t(int64_t(numbers[at])) * 0x9e3779b97f4a7c15ul; numbers[at] = int(u >> 33) + int(u "
     "% 1000ul) + "
     "int(u > 0x8000000000000000ul); vectors[at].x = float(u / 3ul);"},
    {"conversions_of_64_bits",
     "int64_t l = int64_t(vectors[at].x * 1e10); vectors[at].y = float(double(l) * 0.5lf); numbers[at] = "
     "int(uint64_t(uint(numbers[at])) >> 4);"},
};

std::vector<int> first_numbers() {
    std::vector<int> numbers;
    for (int at = 0; at < int{kPixels}; ++at) numbers.push_back(3 * at - 50);
    return numbers;
}
/// Of vectors, texels and, three of four, columns of matrices.
std::vector<float> first_floats(std::size_t count) {
    std::vector<float> floats;
    for (std::size_t i = 0; i < count; ++i) floats.push_back(static_cast<float>(i % 23) / 4 - 2);
    return floats;
}
std::vector<std::uint32_t> first_words() {
    std::vector<std::uint32_t> words;
    for (std::uint32_t at = 0; at < kPixels; ++at) words.push_back(100 + at);
    return words;
}

/// All that the shader may write.
struct Memory {
    std::vector<int> numbers = first_numbers();
    std::vector<float> vectors = first_floats(4 * kPixels);
    std::vector<float> matrices = first_floats(12 * kPixels);  ///< rows of three, each with one for padding
    std::vector<float> colors = first_floats(4 * kPixels);
    std::vector<std::uint32_t> words = first_words();
};

Memory drawn(const Context& context, const std::string& fragment) {
    Memory memory;
    const auto framebuffer = make_framebuffer(context, kSide, kSide);
    const auto program = link_program(context, {stage_text(StageKind::vertex, "a.vert", kVertex),
                                                stage_text(StageKind::fragment, "a.frag", fragment)});
    EXPECT_TRUE(framebuffer && program) << (program ? "" : to_text(program.error().front()));
    if (!framebuffer || !program) return memory;
    const GladGLContext& gl = context.gl();
    GlResources resources(context);
    framebuffer->bind();
    std::array<GLuint, 3> buffers{};
    const auto add_buffer = [&](std::size_t binding, const auto& content) {
        buffers[binding] =
            resources.make_buffer(GL_SHADER_STORAGE_BUFFER, content.data(), content.size() * 4);
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(binding), buffers[binding]);
    };
    add_buffer(0, memory.numbers);
    add_buffer(1, memory.vectors);
    add_buffer(2, memory.matrices);
    std::array<GLuint, 2> textures{};
    const auto add_image = [&](std::size_t unit, GLenum inside, GLenum format, GLenum type,
                               const void* texels) {
        gl.GenTextures(1, &textures[unit]);
        resources.adopt({textures[unit], GL_TEXTURE_2D});
        gl.BindTexture(GL_TEXTURE_2D, textures[unit]);
        gl.TexStorage2D(GL_TEXTURE_2D, 1, inside, kSide, kSide);
        gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, kSide, kSide, format, type, texels);
        gl.BindImageTexture(static_cast<GLuint>(unit), textures[unit], 0, GL_FALSE, 0, GL_READ_WRITE, inside);
    };
    add_image(0, GL_RGBA32F, GL_RGBA, GL_FLOAT, memory.colors.data());
    add_image(1, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, memory.words.data());
    GLuint array = 0;
    gl.GenVertexArrays(1, &array);
    gl.BindVertexArray(array);
    gl.UseProgram(program->id());
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
    const auto read_buffer = [&](std::size_t binding, auto& content) {
        gl.BindBuffer(GL_SHADER_STORAGE_BUFFER, buffers[binding]);
        gl.GetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(content.size() * 4),
                            content.data());
    };
    read_buffer(0, memory.numbers);
    read_buffer(1, memory.vectors);
    read_buffer(2, memory.matrices);
    gl.BindTexture(GL_TEXTURE_2D, textures[0]);
    gl.GetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_FLOAT, memory.colors.data());
    gl.BindTexture(GL_TEXTURE_2D, textures[1]);
    gl.GetTexImage(GL_TEXTURE_2D, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, memory.words.data());
    gl.DeleteVertexArrays(1, &array);
    EXPECT_EQ(gl.GetError(), static_cast<GLenum>(GL_NO_ERROR));
    return memory;
}

/// The same by one invocation for each pixel.
Memory evaluated(const std::string& fragment) {
    const Memory before;
    const Program program =
        decode(compile(ShaderStage::fragment, fragment), {.widths = Widths::up_to_64}).value();
    Invocations invocations;
    invocations.count = kPixels;
    for (const Port& port : program.inputs)
        if (port.name == "gl_FragCoord")
            for (const int axis : {0, 1, 2, 3})
                for (int at = 0; at < int{kPixels}; ++at)
                    invocations.values[port.name].push_back(axis == 0   ? at % kSide + 0.5
                                                            : axis == 1 ? at / kSide + 0.5
                                                                        : 1.0);
    const auto bytes_of = [](const auto& content) {
        const auto* const first = reinterpret_cast<const std::byte*>(content.data());
        return std::vector<std::byte>(first, first + content.size() * 4);
    };
    for (const UniformBlock& block : program.uniform_blocks)
        invocations.blocks[block.name] = block.name == "Numbers"   ? bytes_of(before.numbers)
                                         : block.name == "Vectors" ? bytes_of(before.vectors)
                                                                   : bytes_of(before.matrices);
    const auto texel_of = [](const auto& content, std::size_t channels) {
        return [&content, channels](const ImageRequest& request) -> std::array<double, 4> {
            if (request.what == ImageRequest::What::size) return {kSide, kSide, 0, 0};
            const auto at = static_cast<std::size_t>(request.coordinates[1]) * kSide +
                            static_cast<std::size_t>(request.coordinates[0]);
            std::array<double, 4> texel{0, 0, 0, 1};
            for (std::size_t c = 0; c < channels; ++c)
                texel[c] = static_cast<double>(content[at * channels + c]);
            return texel;
        };
    };
    invocations.images = {{"colors", texel_of(before.colors, 4)}, {"words", texel_of(before.words, 1)}};
    const Result<Outputs> outputs = program.has_wide ? run<double>(program, invocations, {.is_single = true})
                                                     : run<float>(program, invocations);
    EXPECT_TRUE(outputs) << to_text(outputs.error().front());
    Memory memory;
    if (!outputs) return memory;
    for (std::size_t at = 0; at < kPixels; ++at) {
        const auto left = [&](const std::string& name, std::size_t component, auto& to) {
            const auto found = outputs->values.find(name + "[" + std::to_string(at) + "]");
            if (found != outputs->values.end())
                to = static_cast<std::remove_reference_t<decltype(to)>>(
                    found->second[component * kPixels + at]);
        };
        left("Numbers.numbers", 0, memory.numbers[at]);
        for (std::size_t c = 0; c < 4; ++c) left("Vectors.vectors", c, memory.vectors[4 * at + c]);
        for (std::size_t c = 0; c < 9; ++c)
            left("Matrices.turns", c, memory.matrices[12 * at + c % 3 * 4 + c / 3]);
    }
    for (const WrittenTexel& written : outputs->written) {
        const auto [x, y, z, w] = written.place.coordinates;
        if (std::min(x, y) < 0) continue;  // goes nowhere
        const auto at = static_cast<std::size_t>(y * kSide + x);
        for (std::size_t c = 0; c < 4 && program.images[written.place.image].name == "colors"; ++c)
            memory.colors[4 * at + c] = static_cast<float>(written.texel[c]);
        if (program.images[written.place.image].name == "words")
            memory.words[at] = static_cast<std::uint32_t>(static_cast<std::int64_t>(written.texel[0]));
    }
    return memory;
}

class StorageOfDriver : public ::testing::TestWithParam<Case> {};

TEST_P(StorageOfDriver, IsWhatIsEvaluated) {
    const Result<Context> context = open_context(Backend::osmesa);
    ASSERT_TRUE(context) << to_text(context.error().front());
    const std::string fragment = std::string(kDeclarations) + GetParam().body + "\n}\n";
    const Memory by_driver = drawn(*context, fragment);
    const Memory by_evaluator = evaluated(fragment);
    EXPECT_EQ(by_evaluator.numbers, by_driver.numbers);
    EXPECT_EQ(by_evaluator.vectors, by_driver.vectors);
    EXPECT_EQ(by_evaluator.matrices, by_driver.matrices);
    EXPECT_EQ(by_evaluator.colors, by_driver.colors);
    EXPECT_EQ(by_evaluator.words, by_driver.words);
}

INSTANTIATE_TEST_SUITE_P(Bodies, StorageOfDriver, ::testing::ValuesIn(kCases),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace gobo::evaluate
