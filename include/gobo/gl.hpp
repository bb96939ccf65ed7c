// From a permutation to an OpenGL program, through whatever loader the application uses.
//
//     #include <glad/gl.h>          // or GL/glew.h, epoxy/gl.h, GLES3/gl3.h: any that declares gl*
//     #include <gobo/gl.hpp>
//     gobo::gl::Program program = gobo::gl::build_program(*lit::find(key));
//     if (!program) std::puts(program.error.c_str());
//
// Where OpenGL's functions are members of a struct (glad's GladGLContext, or one of the application's own
// with members CreateShader, ShaderSource and so on), pass it: build_program(permutation, context). An
// application that has no gl* functions at all defines GOBO_GL_NO_LOADER before it includes this.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <gobo/driver_log.hpp>
#include <gobo/permutation.hpp>
#include <gobo/spirv.hpp>

#if !defined(GOBO_GL_NO_LOADER) && !defined(GL_VERSION_2_0) && !defined(GL_ES_VERSION_3_0)
#error \
    "include the header of your OpenGL loader before <gobo/gl.hpp>, or define GOBO_GL_NO_LOADER and pass a table"
#endif

namespace gobo::gl {

/// A program that links, or the reason why there is none. The caller deletes it (glDeleteProgram).
struct Program {
    unsigned id = 0;    ///< 0 where there is none
    std::string error;  ///< the driver's log, its places translated to the files that the shaders come from

    explicit operator bool() const { return id != 0; }
};

/// OpenGL's constants, which a table of functions does not bring along.
namespace constant {
/// By runtime::StageKind: vertex, tess_control, tess_evaluation, geometry, fragment, compute.
inline constexpr unsigned shader_of_stage[] = {0x8B31, 0x8E88, 0x8E87, 0x8DD9, 0x8B30, 0x91B9};
inline constexpr unsigned delete_status = 0x8B80;
inline constexpr unsigned compile_status = 0x8B81;
inline constexpr unsigned link_status = 0x8B82;
inline constexpr unsigned info_log_length = 0x8B84;
inline constexpr unsigned current_program = 0x8B8D;
inline constexpr unsigned shader_storage_block = 0x92E6;
inline constexpr unsigned shader_binary_format_spirv = 0x9551;
inline constexpr unsigned invalid_index = 0xFFFFFFFF;
}  // namespace constant

#ifndef GOBO_GL_NO_LOADER
/// The functions of the loader that was included: functions, function pointers or macros.
struct LoadedFunctions {
    [[nodiscard]] unsigned CreateShader(unsigned kind) const { return glCreateShader(kind); }
    void ShaderSource(unsigned shader, int count, const char* const* texts, const int* lengths) const {
        // Old headers take texts whose pointers are not constant; the texts are in either case.
        glShaderSource(shader, count, const_cast<const char**>(texts), lengths);
    }
    void CompileShader(unsigned shader) const { glCompileShader(shader); }
    void GetShaderiv(unsigned shader, unsigned name, int* value) const { glGetShaderiv(shader, name, value); }
    void GetShaderInfoLog(unsigned shader, int size, int* length, char* log) const {
        glGetShaderInfoLog(shader, size, length, log);
    }
    void DeleteShader(unsigned shader) const { glDeleteShader(shader); }
    [[nodiscard]] unsigned CreateProgram() const { return glCreateProgram(); }
    void AttachShader(unsigned program, unsigned shader) const { glAttachShader(program, shader); }
    void BindAttribLocation(unsigned program, unsigned location, const char* name) const {
        glBindAttribLocation(program, location, name);
    }
    void LinkProgram(unsigned program) const { glLinkProgram(program); }
    void GetProgramiv(unsigned program, unsigned name, int* value) const {
        glGetProgramiv(program, name, value);
    }
    void GetProgramInfoLog(unsigned program, int size, int* length, char* log) const {
        glGetProgramInfoLog(program, size, length, log);
    }
    void DeleteProgram(unsigned program) const { glDeleteProgram(program); }
    void UseProgram(unsigned program) const { glUseProgram(program); }
    void GetIntegerv(unsigned name, int* value) const { glGetIntegerv(name, value); }
    [[nodiscard]] int GetUniformLocation(unsigned program, const char* name) const {
        return glGetUniformLocation(program, name);
    }
    void Uniform1iv(int location, int count, const int* values) const {
        glUniform1iv(location, count, values);
    }
    [[nodiscard]] unsigned GetUniformBlockIndex(unsigned program, const char* name) const {
        return glGetUniformBlockIndex(program, name);
    }
    void UniformBlockBinding(unsigned program, unsigned block, unsigned binding) const {
        glUniformBlockBinding(program, block, binding);
    }
#ifdef GL_VERSION_4_3
    [[nodiscard]] unsigned GetProgramResourceIndex(unsigned program, unsigned kind, const char* name) const {
        return glGetProgramResourceIndex(program, kind, name);
    }
    void ShaderStorageBlockBinding(unsigned program, unsigned block, unsigned binding) const {
        glShaderStorageBlockBinding(program, block, binding);
    }
#endif
#ifdef GL_VERSION_4_6
    void ShaderBinary(int count, const unsigned* shaders, unsigned format, const void* words,
                      int bytes) const {
        glShaderBinary(count, shaders, format, words, bytes);
    }
    void SpecializeShader(unsigned shader, const char* entry_point, unsigned count, const unsigned* ids,
                          const unsigned* values) const {
        glSpecializeShader(shader, entry_point, count, ids, values);
    }
#endif
};
#endif

namespace detail {

/// Whether storage blocks can be bound: by OpenGL 4.3. In ES their shaders have to state bindings.
template <class Functions, class = void>
struct BindsStorage : std::false_type {};
template <class Functions>
struct BindsStorage<
    Functions, std::void_t<decltype(std::declval<const Functions&>().ShaderStorageBlockBinding(0U, 0U, 0U))>>
    : std::true_type {};

/// Whether a header holds SPIR-V, which states all locations and bindings and need not have names.
template <class Tables, class = void>
struct IsSpirv : std::false_type {};
template <class Tables>
struct IsSpirv<Tables, std::void_t<decltype(Tables::modules)>> : std::true_type {};

/// The log of a shader or program. `get_length(int*)`, `get_log(size, int*, char*)`.
template <class GetLength, class GetLog>
[[nodiscard]] std::string read_log(GetLength get_length, GetLog get_log) {
    int size = 0;
    get_length(&size);
    std::string log(static_cast<std::size_t>(size > 0 ? size : 0), '\0');
    if (log.empty()) return log;
    int length = 0;
    get_log(size, &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    return log;
}

/// The shader where it has been compiled, else 0 with `error` set. `translated(log)` has the log's places
/// name files.
template <class Functions, class Translated>
[[nodiscard]] unsigned if_compiled(unsigned shader, runtime::StageKind kind, const Functions& gl,
                                   std::string& error, Translated translated) {
    int compiled = 0;
    gl.GetShaderiv(shader, constant::compile_status, &compiled);
    if (compiled != 0) return shader;
    const std::string log =
        read_log([&](int* size) { gl.GetShaderiv(shader, constant::info_log_length, size); },
                 [&](int size, int* length, char* text) { gl.GetShaderInfoLog(shader, size, length, text); });
    error = std::string(runtime::name_of(kind)) + " stage does not compile\n" + translated(log);
    gl.DeleteShader(shader);
    return 0;
}

template <class Functions, class Translated>
[[nodiscard]] unsigned compile_texts(const std::vector<std::string_view>& pieces, runtime::StageKind kind,
                                     const Functions& gl, std::string& error, Translated translated) {
    std::vector<const char*> texts;
    std::vector<int> lengths;
    for (const std::string_view piece : pieces) {
        texts.push_back(piece.data());
        lengths.push_back(static_cast<int>(piece.size()));
    }
    const unsigned shader = gl.CreateShader(constant::shader_of_stage[static_cast<std::size_t>(kind)]);
    gl.ShaderSource(shader, static_cast<int>(texts.size()), texts.data(), lengths.data());
    gl.CompileShader(shader);
    return if_compiled(shader, kind, gl, error, translated);
}

template <class Permutation, class Tables, class Functions>
[[nodiscard]] unsigned compile(const Permutation&, const runtime::Stage<Tables>& stage,
                               runtime::StageKind kind, const Functions& gl, std::string& error) {
    std::vector<std::string_view> pieces;
    stage.for_each_piece([&pieces](std::string_view text) { pieces.push_back(text); });
    return compile_texts(pieces, kind, gl, error,
                         [&stage](const std::string& log) { return runtime::translated_log(stage, log); });
}

/// Of a module, with the permutation's values for those specialisation constants that the module has: OpenGL
/// takes no others.
template <class Permutation, class Tables, class Functions>
[[nodiscard]] unsigned compile(const Permutation& permutation, const runtime::SpirvStage<Tables>& stage,
                               runtime::StageKind kind, const Functions& gl, std::string& error) {
    std::vector<unsigned> ids;
    std::vector<unsigned> values;
    for (std::size_t i = 0; i < Tables::specialization_constants.size(); ++i) {
        if (!runtime::has_constant(stage, Tables::specialization_constants[i].id)) continue;
        ids.push_back(Tables::specialization_constants[i].id);
        values.push_back(permutation.specialization()[i]);
    }
    const unsigned shader = gl.CreateShader(constant::shader_of_stage[static_cast<std::size_t>(kind)]);
    gl.ShaderBinary(1, &shader, constant::shader_binary_format_spirv, stage.words(),
                    static_cast<int>(stage.size()));
    gl.SpecializeShader(shader, stage.entry_point, static_cast<unsigned>(ids.size()), ids.data(),
                        values.data());
    return if_compiled(shader, kind, gl, error, [](const std::string& log) { return log; });
}

}  // namespace detail

namespace detail {

/// Does as set_bindings() says with the rows of the tables that `is_wanted(only)`.
template <class Tables, class Functions, class IsWanted>
void set_bindings(unsigned program, const Functions& gl, IsWanted is_wanted) {
    for (const runtime::BlockBinding& block : Tables::blocks) {
        if (!is_wanted(block.only)) continue;
        const unsigned index = gl.GetUniformBlockIndex(program, std::string(block.name).c_str());
        if (index == constant::invalid_index) continue;
        gl.UniformBlockBinding(program, index, static_cast<unsigned>(block.binding));
    }
    if constexpr (Tables::storage_blocks.size() > 0 && BindsStorage<Functions>::value) {
        for (const runtime::BlockBinding& block : Tables::storage_blocks) {
            if (!is_wanted(block.only)) continue;
            const unsigned index = gl.GetProgramResourceIndex(program, constant::shader_storage_block,
                                                              std::string(block.name).c_str());
            if (index == constant::invalid_index) continue;
            gl.ShaderStorageBlockBinding(program, index, static_cast<unsigned>(block.binding));
        }
    }
    int previous = 0;
    gl.GetIntegerv(constant::current_program, &previous);
    int is_deleted = 0;  // it lives as long as it is current, and cannot become so again
    if (previous != 0) gl.GetProgramiv(static_cast<unsigned>(previous), constant::delete_status, &is_deleted);
    gl.UseProgram(program);
    for (const runtime::SamplerBinding& sampler : Tables::samplers) {
        if (!is_wanted(sampler.only)) continue;
        std::vector<int> units;
        for (int unit = 0; unit < sampler.count; ++unit) units.push_back(sampler.binding + unit);
        const int location = gl.GetUniformLocation(program, std::string(sampler.name).c_str());
        if (location >= 0) gl.Uniform1iv(location, sampler.count, units.data());
    }
    gl.UseProgram(is_deleted != 0 ? 0 : static_cast<unsigned>(previous));
}

}  // namespace detail

/// Gives blocks their bindings and samplers their units, by name: needed where the dialect (330, ES 300)
/// cannot state them in the shader. The current program stays current.
template <class Permutation, class Functions>
void set_bindings(const Permutation& permutation, unsigned program, const Functions& gl) {
    detail::set_bindings<typename Permutation::Tables>(
        program, gl, [&permutation](const runtime::Only& only) { return only.applies_to(permutation); });
}

/// The same where all permutations declare alike.
template <class Tables, class Functions>
void set_bindings(unsigned program, const Functions& gl) {
    detail::set_bindings<Tables>(program, gl, [](const runtime::Only&) { return true; });
}

namespace detail {

/// Links the shaders, which go, as the permutation's program; there is none where an error is set already.
template <class Permutation, class Functions>
[[nodiscard]] Program link(const Permutation& permutation, const std::vector<unsigned>& shaders,
                           const Functions& gl, std::string error) {
    Program program;
    program.error = std::move(error);
    if (!program.error.empty()) {
        for (const unsigned shader : shaders) gl.DeleteShader(shader);
        return program;
    }
    const unsigned id = gl.CreateProgram();
    for (const unsigned shader : shaders) gl.AttachShader(id, shader);
    constexpr bool states_places = IsSpirv<typename Permutation::Tables>::value;
    if constexpr (!states_places)
        for (const runtime::VariableLocation& attribute : Permutation::Tables::attributes) {
            if (!attribute.only.applies_to(permutation)) continue;
            gl.BindAttribLocation(id, static_cast<unsigned>(attribute.location),
                                  std::string(attribute.name).c_str());
        }
    gl.LinkProgram(id);
    // They live on within the program until it is deleted.
    for (const unsigned shader : shaders) gl.DeleteShader(shader);
    int linked = 0;
    gl.GetProgramiv(id, constant::link_status, &linked);
    if (linked == 0) {
        const std::string log = detail::read_log(
            [&](int* size) { gl.GetProgramiv(id, constant::info_log_length, size); },
            [&](int size, int* length, char* text) { gl.GetProgramInfoLog(id, size, length, text); });
        program.error = "the stages do not link\n" + log;
        gl.DeleteProgram(id);
        return program;
    }
    if constexpr (!states_places) gl::set_bindings(permutation, id, gl);
    program.id = id;
    return program;
}

}  // namespace detail

/// Compiles and links a permutation of a generated header, and binds its attributes, blocks and samplers as
/// the header says. Needs a current context of OpenGL 3.3 or OpenGL ES 3.0 at least; a header of the dialect
/// gl_spirv one of OpenGL 4.6, or functions ShaderBinary and SpecializeShader (glSpecializeShaderARB).
template <class Permutation, class Functions>
[[nodiscard]] Program build_program(const Permutation& permutation, const Functions& gl) {
    std::string error;
    std::vector<unsigned> shaders;
    runtime::for_each_stage(permutation, [&](runtime::StageKind kind, const auto& stage) {
        const unsigned shader = error.empty() ? detail::compile(permutation, stage, kind, gl, error) : 0;
        if (shader != 0) shaders.push_back(shader);
    });
    return detail::link(permutation, shaders, gl, std::move(error));
}

/// The same from other texts of its stages, each with a `kind` and a `text`: those of <gobo/reload.hpp>.
template <class Permutation, class Stages, class Functions>
[[nodiscard]] Program build_program(const Permutation& permutation, const Stages& stages,
                                    const Functions& gl) {
    std::string error;
    std::vector<unsigned> shaders;
    for (const auto& stage : stages) {
        const auto as_it_is = [](const std::string& log) { return log; };
        const unsigned shader = error.empty() ? detail::compile_texts({std::string_view(stage.text)},
                                                                      stage.kind, gl, error, as_it_is)
                                              : 0;
        if (shader != 0) shaders.push_back(shader);
    }
    return detail::link(permutation, shaders, gl, std::move(error));
}

#ifndef GOBO_GL_NO_LOADER
/// The same through the functions of the loader that was included.
template <class Permutation>
[[nodiscard]] Program build_program(const Permutation& permutation) {
    return build_program(permutation, LoadedFunctions{});
}
#endif

}  // namespace gobo::gl
