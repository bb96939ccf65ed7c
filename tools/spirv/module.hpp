// A SPIR-V module read into instructions, and what it says of its ids: types, constants, names, decorations,
// lines of the source.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <unordered_map>
#include <vector>

#include <spirv/unified1/spirv.hpp>

#include "core/diagnostic.hpp"
#include "spirv/glsl_type.hpp"

namespace gobo::spirv {

/// A type, value, label, function or string of the module.
enum class Id : std::uint32_t { none = 0 };

/// One instruction. Reading past its end gives 0, which is nobody's id, so that a malformed module ends in a
/// diagnostic and never in a wild read.
struct Instruction {
    spv::Op opcode = spv::OpNop;
    std::span<const std::uint32_t> words;  ///< with the leading word
    std::uint32_t line = 0;                ///< index into Module::lines
    Id type = Id::none;                    ///< of its result
    Id result = Id::none;

    [[nodiscard]] std::uint32_t word(std::size_t index) const {
        return index < words.size() ? words[index] : 0;
    }
    [[nodiscard]] Id id(std::size_t index) const { return Id{word(index)}; }
    /// The word as one of SPIR-V's enumerants, all of which are below 2^31.
    template <class Enumerant>
    [[nodiscard]] Enumerant as(std::size_t index) const {
        return static_cast<Enumerant>(std::min(word(index), 0x7fffffffU));
    }
};

/// What an OpTypeImage says.
struct Image {
    spv::Dim dimension = spv::Dim2D;
    bool depth = false;  ///< compared on sampling: a shadow sampler
    bool arrayed = false;
    bool multisampled = false;
    bool storage = false;  ///< read and written without a sampler
    spv::ImageFormat format = spv::ImageFormatUnknown;
};

/// A type. The ids in it are of types that the module declares earlier, so types never form a cycle.
struct Type {
    spv::Op opcode = spv::OpNop;  ///< the instruction that declares it; OpNop for no type
    GlslType value;           ///< of a scalar, vector or matrix; of others the component of the first scalar
    Id element = Id::none;    ///< component, column, array element, texel, sampled image's image, pointee
    std::uint32_t count = 0;  ///< components, columns, elements or members; 0 for an array without a size
    std::vector<Id> members;  ///< of a struct
    Image image;              ///< of an image or sampled image
    spv::StorageClass storage = spv::StorageClassMax;  ///< of a pointer
    std::uint32_t scalars =
        0;  ///< numbers or images in a value, at most kMostScalars; 0 where there is no value
    std::uint32_t depth = 1;  ///< levels of types within types
    std::uint64_t parts = 1;  ///< types within it, all structs written out

    static constexpr std::uint32_t kMostScalars = ~0U;

    [[nodiscard]] bool is_array() const {
        return opcode == spv::OpTypeArray || opcode == spv::OpTypeRuntimeArray;
    }
    [[nodiscard]] bool is_image() const {
        return opcode == spv::OpTypeImage || opcode == spv::OpTypeSampledImage;
    }
};

/// A variable outside functions.
struct Variable {
    Id id = Id::none;
    Id type = Id::none;  ///< of the value, not of the pointer
    spv::StorageClass storage = spv::StorageClassPrivate;
};

struct EntryPoint {
    spv::ExecutionModel model = spv::ExecutionModelVertex;
    Id function = Id::none;
};

/// Stands for the whole id, in place of one of its members.
inline constexpr int kWhole = -1;

/// A literal string: bytes from the lowest of each word up to a zero.
[[nodiscard]] std::string literal_text(std::span<const std::uint32_t> literal);

/// A line of the source; that without a file is unknown.
struct Line {
    Id file = Id::none;
    int number = 0;

    friend bool operator==(const Line&, const Line&) = default;
};

/// A module. It refers to the words it was read from, which must outlive it.
struct Module {
    std::vector<Instruction> instructions;
    std::vector<std::uint32_t> definitions;  ///< by id: index into instructions plus 1, or 0
    std::vector<Line> lines;                 ///< lines[0] is unknown
    std::vector<EntryPoint> entry_points;
    std::vector<Variable> variables;  ///< in the order of declaration
    std::unordered_map<Id, Type> types;
    std::unordered_map<Id, std::int64_t> integers;  ///< constants of 32 bits; specialisable ones by default
    /// Arrays whose size is computed from specialisation constants and is, by their defaults, none that an
    /// array can have, or not known. They stand there with one element.
    std::set<Id> unknown_sizes;
    /// Literal strings that name ids and members of structs (kWhole: the id itself), sorted by these.
    std::vector<std::pair<std::pair<Id, int>, std::span<const std::uint32_t>>> names;
    /// By id and member: the decoration's first literal, 0 where it has none.
    std::map<std::tuple<Id, int, spv::Decoration>, std::uint32_t> decorations;

    /// The type of that id; one whose opcode is OpNop where there is none.
    [[nodiscard]] const Type& type(Id id) const;
    /// The instruction that defines the id; nullptr where there is none, as for what is being read.
    [[nodiscard]] const Instruction* definition(Id id) const;
    /// The name that debug information gives, or empty.
    [[nodiscard]] std::string name(Id id, int member = kWhole) const;
    /// The first literal of the decoration, or nothing where it is absent.
    [[nodiscard]] std::optional<std::uint32_t> decoration(Id id, spv::Decoration kind,
                                                          int member = kWhole) const;
    [[nodiscard]] Place place(std::uint32_t line) const;
};

/// Reads a module in the processor's own byte order. A truncated or inconsistent one is an error
/// (Fault::internal: modules come from glslang) that names the word at which reading stopped.
[[nodiscard]] Result<Module> read_module(std::span<const std::uint32_t> words);

/// GLSL's name of a type that is no array: "float", "ivec3", "sampler2DArrayShadow", "uimageBuffer", or the
/// struct's name.
[[nodiscard]] std::string type_name(const Module& module, Id type);

/// GLSL's name of an image's format: "rgba8"; empty where it states none.
[[nodiscard]] std::string_view format_name(spv::ImageFormat format);

}  // namespace gobo::spirv
