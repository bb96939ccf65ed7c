// The interface of a program as applications see it: blocks, uniforms, samplers, inputs and outputs.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"

namespace gobo {

/// How stages declare and use an entry. Programs may differ in it, so it never makes two entries unequal.
struct Usage {
    bool unused = false;     ///< no stage reads it; an output: the stage never writes it
    bool anonymous = false;  ///< of a block, or an input or output in one: it has no instance, so its members
                             ///< are names of their own
    std::string precision = {};  ///< "mediump"; empty but of plain uniforms, and of samplers, in OpenGL ES
    /// What linkers compare beside the type: of an image its format, "rgba8"; of a member of a storage block
    /// how its memory is accessed, "coherent readonly"; of a geometry stage's output "stream 1", but not 0.
    std::string access = {};
    /// What is stated though it holds without, and is compared all the same: "smooth" of an input or output,
    /// "[]" of an array whose size its use gives, "offset" of a block's member.
    std::string stated = {};

    friend bool operator==(const Usage&, const Usage&) { return true; }
};

/// How a value is carried from the vertices to a fragment; without any of these smoothly.
struct Interpolation {
    bool flat = false;
    bool noperspective = false;
    bool centroid = false;
    bool sample = false;
    bool invariant = false;

    friend bool operator==(const Interpolation&, const Interpolation&) = default;
};

/// A member of a uniform block or struct. Offsets, sizes and strides are in bytes.
struct Member {
    std::string name;
    std::string type;        ///< GLSL name: "vec3", "mat4", "bool", or the struct's name
    int offset = 0;          ///< from the start of what contains it (block or struct)
    std::vector<int> array;  ///< extents, outermost first; empty where it is no array
    int array_stride = 0;    ///< of the outermost dimension; 0 where it is no array
    int matrix_stride = 0;   ///< 0 where it is no matrix
    bool row_major = false;
    std::vector<Member> members;  ///< of a struct
    Usage usage = {};

    friend bool operator==(const Member&, const Member&) = default;
};

/// A uniform block, laid out by std140 unless it says otherwise.
struct Block {
    std::string name;                 ///< of the block, not of its instance; "Name[1]" in an array of blocks
    int binding = -1;                 ///< -1 where the source states none
    int size = 0;                     ///< bytes, as OpenGL reports UNIFORM_BLOCK_DATA_SIZE
    std::vector<std::string> stages;  ///< "vertex", "fragment", sorted as the pipeline runs
    std::vector<Member> members;
    Usage usage = {};
    int set = -1;  ///< Vulkan's descriptor set; -1: OpenGL has none

    friend bool operator==(const Block&, const Block&) = default;
};

/// A uniform outside any block. A struct that holds samplers is listed member by member, as OpenGL does.
struct Uniform {
    std::string name;
    std::string type;
    int location = -1;  ///< -1 where the source states none
    std::vector<int> array;
    std::vector<Member> members;  ///< of a struct (offsets are meaningless and 0)
    std::vector<std::string> stages;
    Usage usage = {};
    int counter_binding =
        -1;  ///< of an atomic counter its buffer, and where it stands there, in bytes; else -1
    int counter_offset = -1;

    friend bool operator==(const Uniform&, const Uniform&) = default;
};

struct Sampler {
    std::string name;  ///< in a struct the path, as OpenGL has it: "surfaces[1].albedo"
    std::string type;  ///< "sampler2DArrayShadow"
    int binding = -1;
    std::vector<int> array;
    std::vector<std::string> stages;
    Usage usage = {};
    int set = -1;       ///< Vulkan's descriptor set; -1: OpenGL has none
    int location = -1;  ///< as a uniform; -1 where the source states none

    friend bool operator==(const Sampler&, const Sampler&) = default;
};

/// What declares a variable: it is declared by itself, or a member of a struct or of a block.
enum class Whole : std::uint8_t { itself, structure, block };

/// A vertex attribute, a fragment output, or a value between the stages.
struct Variable {
    std::string name;  ///< in a block or struct the path, as OpenGL has it: "Surface.normal", "ray[1].origin"
    std::string type;
    int location = -1;
    std::vector<int> array;  ///< without the extent that counts the vertices, where it has one
    int component = 0;       ///< the first it takes of its location
    Interpolation interpolation = {};
    bool per_vertex = false;  ///< an array with an element for each vertex of the primitive or patch
    bool patch = false;       ///< one for all vertices of a patch
    Usage usage = {};
    Whole whole = Whole::itself;

    friend bool operator==(const Variable&, const Variable&) = default;
};

/// A number or boolean that is chosen when a pipeline is made of the SPIR-V.
struct SpecializationConstant {
    std::string name;
    std::string type;         ///< "int", "uint", "float" or "bool"
    int id = 0;               ///< its constant_id
    std::uint32_t value = 0;  ///< the bits of its default

    friend bool operator==(const SpecializationConstant&, const SpecializationConstant&) = default;
};

/// Of one stage, or of a linked program. Each list is sorted by name.
struct Interface {
    std::vector<std::string> stages;
    std::vector<Block> blocks;          ///< uniform blocks
    std::vector<Block> storage_blocks;  ///< shader storage blocks; a last array without a size has extent 0
    std::vector<Uniform> uniforms;
    std::vector<Sampler> samplers;
    std::vector<Variable> inputs;       ///< of the first stage
    std::vector<Variable> outputs;      ///< of the last stage
    std::vector<Block> push_constants;  ///< Vulkan's, each a block without binding
    std::vector<SpecializationConstant> specialization_constants;

    friend bool operator==(const Interface&, const Interface&) = default;
};

/// Where an entry is bound: its binding if it can have one, else its location.
template <class Entry>
[[nodiscard]] auto& place_of(Entry& entry) {
    if constexpr (requires { entry.binding; })
        return entry.binding;
    else
        return entry.location;
}

/// "Lights" of "Lights.lights[0].on" and of "Lights[2]": what the source declares.
[[nodiscard]] std::string_view root_of(std::string_view name);

/// "Lights.lights[0].on" as "Lights.lights.on".
[[nodiscard]] std::string without_indices(std::string_view name);

/// The interface of a program: inputs of its first stage, outputs of its last (as the pipeline runs, whatever
/// the order of `stages`), everything else united by name. Meant for stages that link, so where two declare
/// the same name their declarations agree; should they differ, the earlier stage's stands.
[[nodiscard]] Interface merge(std::vector<Interface> stages);

/// A name that programs declare in ways that no one declaration serves.
struct Differing {
    std::string kind;  ///< "uniform block", "storage block", "uniform", "sampler", "input" or "output"
    std::string name;
    /// For each program which of the declarations it has, counted from 1 as the list has them; 0 where none.
    std::vector<int> declared;

    friend bool operator==(const Differing&, const Differing&) = default;
};

/// What several programs, the permutations of a family, declare together.
struct United {
    Interface
        interface;  ///< a name that they declare differently stands in its list once for each declaration
    std::vector<Differing> differing;
};

/// The interfaces of several programs as one: lists united by name. One declaration serves arrays of uniforms
/// and of samplers, and the array that ends a block, whatever their outermost extents: the largest is kept;
/// and structs of uniforms outside blocks, whatever members each has. One that states no binding or location
/// agrees with one that does.
[[nodiscard]] United unite(const std::vector<Interface>& programs);

/// OpenGL's type enumerants (0x8B56 is GL_BOOL) by flattened name, as glslang's reflection and OpenGL's
/// program-interface queries list them: "Fog.enabled" or, for a block without instance, "enabled";
/// "Lights.lights[0].on". glslang lists unread members only with EShReflectionAllBlockVariables, unread
/// blocks only with EShReflectionSharedStd140UBO. Array subscripts are ignored: all elements have one type.
using GlTypes = std::map<std::string, int>;

/// Whether a block has an unsigned integer, which may have been a boolean: only then are GlTypes worth
/// collecting.
[[nodiscard]] bool may_hold_bools(const Interface& interface);

/// The interface with "uint" and "uvecN" in blocks, as which SPIR-V stores booleans, turned back into "bool"
/// and "bvecN" where `types` says so.
[[nodiscard]] Interface restore_bools(Interface interface, const GlTypes& types);

}  // namespace gobo
