// A SPIR-V module read into what reflection and other consumers ask about: types, names, decorations,
// variables.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <spirv/unified1/spirv.hpp11>

#include "core/diagnostic.hpp"

namespace gobo::spirv {

using Id = std::uint32_t;

/// One instruction. `operands` are all words after the first, result type and result included.
struct Instruction {
    spv::Op opcode = spv::Op::OpNop;
    std::span<const std::uint32_t> operands;
};

/// What an OpTypeImage says.
struct Image {
    spv::Dim dimension = spv::Dim::Dim2D;
    bool depth = false;  ///< compared on sampling: a shadow sampler
    bool arrayed = false;
    bool multisampled = false;
    bool storage = false;  ///< read and written without a sampler
};

/// A type. Ids in it are of types that the module declares earlier, so types never form a cycle.
struct Type {
    spv::Op opcode = spv::Op::OpTypeVoid;  ///< the instruction that declares it
    int width = 0;                         ///< bits of a number
    bool is_signed = false;                ///< of an integer
    Id element = 0;  ///< component, column, array element, image's texel, sampled image's image, pointee
    int count = 0;   ///< components, columns or array elements; 0 for an array without a size
    std::vector<Id> members;  ///< of a struct
    Image image;
    int depth = 1;           ///< levels of types within types
    std::int64_t parts = 1;  ///< types within it, all structs written out
};

/// A module-scope variable.
struct Variable {
    Id id = 0;
    Id type = 0;  ///< of the value, not of the pointer
    spv::StorageClass storage = spv::StorageClass::Private;
};

struct EntryPoint {
    spv::ExecutionModel model = spv::ExecutionModel::Vertex;
    Id function = 0;
    std::string name;
};

/// Stands for the whole id, in place of one of its members.
inline constexpr int whole = -1;

/// The literal string that names an id or one of its members.
struct Name {
    Id id = 0;
    int member = whole;
    std::span<const std::uint32_t> literal;  ///< ends in a zero
};

/// A decoration of an id or of one of its members, with its first literal, 0 where it has none.
struct Decoration {
    Id id = 0;
    int member = whole;
    spv::Decoration kind = spv::Decoration::Max;
    std::uint32_t value = 0;
};

/// A module. It owns the words that its instructions refer to, so it moves but does not copy.
class Module {
  public:
    Module() = default;
    Module(Module&&) = default;
    Module& operator=(Module&&) = default;
    Module(const Module&) = delete;
    Module& operator=(const Module&) = delete;
    ~Module() = default;

    std::vector<std::uint32_t> words;
    std::vector<Instruction> instructions;
    std::vector<EntryPoint> entry_points;
    std::vector<Variable> variables;      ///< in the order of declaration
    std::map<Id, Type> types;             ///< every type that the module declares
    std::map<Id, std::int64_t> integers;  ///< integer constants; specialisable ones by their defaults
    std::vector<Name> names;              ///< sorted by id and member
    std::vector<Decoration> decorations;  ///< sorted by id, member and kind

    /// The type of an id that some Type or Variable of this module names.
    [[nodiscard]] const Type& type(Id id) const { return types.at(id); }
    /// The name that debug information gives, or empty.
    [[nodiscard]] std::string name(Id id, int member = whole) const;
    /// The first literal of the decoration (0 where it has none), or nothing where it is absent.
    [[nodiscard]] std::optional<int> decoration(Id id, spv::Decoration kind, int member = whole) const;
};

/// Reads a module whose words are in the machine's own byte order. A truncated or inconsistent one is an
/// error (Fault::internal: modules come from glslang) that names the word at which reading stopped.
[[nodiscard]] Result<Module> read_module(std::vector<std::uint32_t> words);

}  // namespace gobo::spirv
