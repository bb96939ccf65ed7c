// A stage made ready to be evaluated: flat operations over numbered slots, in blocks.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/diagnostic.hpp"
#include "spirv/module.hpp"

namespace gobo::evaluate {

using gobo::is_integer;
using gobo::Scalar;

[[nodiscard]] constexpr bool is_float(Scalar scalar) {
    return scalar == Scalar::float32 || scalar == Scalar::float64 || scalar == Scalar::float16;
}
/// Of 64 bits.
[[nodiscard]] constexpr bool is_wide(Scalar scalar) {
    return scalar == Scalar::float64 || scalar == Scalar::int64 || scalar == Scalar::uint64;
}
/// Of 8 or 16 bits.
[[nodiscard]] constexpr bool is_narrow(Scalar scalar) {
    return scalar == Scalar::float16 || scalar == Scalar::int8 || scalar == Scalar::uint8 ||
           scalar == Scalar::int16 || scalar == Scalar::uint16;
}
[[nodiscard]] constexpr bool is_unsigned(Scalar scalar) {
    return scalar == Scalar::uint32 || scalar == Scalar::uint64 || scalar == Scalar::uint16 ||
           scalar == Scalar::uint8;
}

/// What an executed operation counts as. Each component counts as one; a matrix product counts the
/// multiplications and additions it consists of.
enum class Kind : std::uint8_t {
    add,           ///< additions, subtractions, negations of floats
    mul,           ///< multiplications of floats
    div,           ///< divisions and remainders of floats
    fma,           ///< fused multiply-adds
    sqrt,          ///< sqrt()
    inverse_sqrt,  ///< inversesqrt()
    pow,           ///< pow()
    exp,           ///< exp(), exp2()
    log,           ///< log(), log2()
    trig,          ///< circular and hyperbolic functions and their inverses
    dot,           ///< dot()
    geometric,     ///< length(), distance(), normalize(), cross(), reflect(), refract(), faceforward()
    round,         ///< floor(), ceil(), fract(), round(), trunc(), modf(), frexp(), ldexp()
    min_max,       ///< min(), max(), clamp(), abs(), sign(), step()
    mix,           ///< mix(), smoothstep()
    matrix,        ///< transpose(), determinant(), inverse()
    integer,       ///< integer arithmetic and bit operations
    compare,       ///< comparisons
    logic,         ///< operations on booleans
    select,        ///< choosing a value by a condition
    convert,       ///< conversions, reinterpretations, packing
    move,          ///< taking composites apart and putting them together, addressing
    load,          ///< reads of variables
    store,         ///< writes of variables
    branch,        ///< conditional branches and switches
    call,          ///< function calls
    derivative,    ///< dFdx(), dFdy(), fwidth(), interpolateAt...()
    image,         ///< texture functions, one each
};

/// The kinds as reports print them, in the order of Kind.
inline constexpr auto kKindNames = std::to_array<std::string_view>(
    {"add",  "mul",    "div",     "fma",     "sqrt",      "inverse_sqrt", "pow",
     "exp",  "log",    "trig",    "dot",     "geometric", "round",        "min_max",
     "mix",  "matrix", "integer", "compare", "logic",     "select",       "convert",
     "move", "load",   "store",   "branch",  "call",      "derivative",   "image"});
inline constexpr std::size_t kKinds = kKindNames.size();

/// How many operations of each kind.
using Counts = std::array<std::uint64_t, kKinds>;

/// Consecutive slots that hold one value.
struct Slice {
    std::uint32_t slot = 0;
    std::uint32_t count = 0;
    Scalar scalar = Scalar::float32;  ///< of the first slot; a struct's others may differ
    std::uint32_t name = 0;           ///< index into Program::names; 0 where it has none
};

/// One operation, as it runs.
struct Operation {
    std::uint32_t row = 0;                    ///< index into the instruction table
    std::uint32_t count = 0;                  ///< components it works on
    std::uint32_t result = 0;                 ///< first slot
    std::array<std::uint32_t, 3> operands{};  ///< first slots
    std::uint32_t extra = 0;                  ///< first of its words in Program::words, as its row reads them
    std::uint32_t extras = 0;
};

/// What a reader wants to know about an operation: where it stands, what it reads and writes.
struct OperationInfo {
    std::uint32_t place = 0;  ///< index into Program::places
    Slice result;             ///< a store's is the variable
    std::vector<Slice> operands;
    bool is_precise = false;  ///< NoContraction: to be computed as written
    bool is_relaxed = false;  ///< RelaxedPrecision: mediump or lowp
};

/// A way from one block to another, with the copies (phi) made by those who take it.
struct Edge {
    std::uint32_t target = 0;  ///< block, or Program::kEnd
    std::uint32_t first_copy = 0;
    std::uint32_t copies = 0;
};

/// Operations without a branch among them, and the branch that ends them.
struct Block {
    enum class End { jump, branch, select, finish, kill };
    std::uint32_t first = 0;  ///< of Program::operations
    std::uint32_t count = 0;
    std::uint32_t quick_first = 0;  ///< of Program::quick
    std::uint32_t quick_count = 0;
    End end = End::finish;
    std::uint32_t condition = 0;  ///< slot, of branch and select
    std::uint32_t edge = 0;       ///< jump: 1; branch: true, false; select: default, then one for each label
    std::uint32_t edges = 0;
    std::uint32_t labels = 0;                           ///< select: first of its labels in Program::words
    std::uint32_t place = 0;                            ///< of its end
    bool is_loop = false;                               ///< a later block jumps to it
    std::vector<std::pair<Kind, std::uint32_t>> costs;  ///< counted at each visit
};

/// A slot filled once, before anything runs.
struct ConstantSlot {
    std::uint32_t slot = 0;
    Scalar scalar = Scalar::float32;
    std::uint32_t bits = 0;   ///< of the value, of one of 64 bits the low ones
    std::uint32_t high = 0;   ///< and the high ones
    bool is_relaxed = false;  ///< only mediump operations read it: of 16 bits where these are
};

/// Slots whose value nobody gives: what a function returns that ends without a return.
struct UndefinedValue {
    std::uint32_t slot = 0;
    std::uint32_t count = 0;
    std::uint32_t place = 0;  ///< of the function
    std::string function;
};

/// A scalar, vector or matrix of the interface.
struct Port {
    std::string name;  ///< "normal", "gl_Position", "PointLights.lights[0].position"
    std::string type;  ///< GLSL name: "vec3"
    int location = -1;
    std::uint32_t slot = 0;
    std::uint32_t components = 1;  ///< column by column
    Scalar scalar = Scalar::float32;
    // Uniform and storage blocks: where it lies in the block's bytes.
    int block = -1;                      ///< index into Program::uniform_blocks
    std::vector<std::uint32_t> offsets;  ///< of each component
    bool is_written = false;  ///< of a storage block or a counter: a uniform that each invocation may write
};

/// A uniform block by name, for filling it from bytes.
struct UniformBlock {
    std::string name;
    std::uint32_t size = 0;  ///< bytes up to the end of the last member
};

/// A sampler or image of the interface; each element of an array is one.
struct ImagePort {
    std::string name;  ///< "tex", "maps[2]"
    spirv::Image type;
    std::uint32_t slot = 0;           ///< holds the index of this ImagePort
    Scalar scalar = Scalar::float32;  ///< of a texel's channels
};

/// A decoded stage. A value: owns all it needs, may be run by many threads at once.
struct Program {
    static constexpr std::uint32_t kEnd = 0x7fffffff;  ///< target of an edge that ends the invocation

    bool is_fragment = false;
    bool has_narrow = false;  ///< it computes with numbers of 8 or 16 bits
    bool has_wide = false;    ///< it computes with numbers of 64 bits: run<double>() alone holds them
    std::vector<Operation> operations;
    std::vector<OperationInfo> infos;  ///< of each operation
    std::vector<Operation> quick;      ///< the operations without those that do nothing but be observed
    std::vector<Operation> copies;     ///< of edges
    std::vector<Edge> edges;
    std::vector<Block> blocks;  ///< in an order in which those who left wait ahead of those who stay
    std::vector<std::uint32_t> words;
    std::uint32_t slots = 0;
    std::vector<ConstantSlot> constants;
    std::vector<std::pair<std::uint32_t, std::uint32_t>>
        variables;  ///< slots set to zero first: start, count
    std::vector<UndefinedValue> undefined;
    std::set<std::uint32_t> unstated_extents;     ///< of `words`: lengths of arrays that state none
    std::vector<Port> inputs, outputs, uniforms;  ///< sorted by name
    std::vector<UniformBlock> uniform_blocks;
    std::vector<ImagePort> images;
    std::vector<Place> places;       ///< places[0] is unknown
    std::vector<std::string> names;  ///< names[0] is empty

    [[nodiscard]] const Place& place_of(std::uint32_t operation) const {
        return places[infos[operation].place];
    }
};

/// The one of that name among a program's ports, which are sorted; nullptr where there is none.
[[nodiscard]] inline const Port* find_port(const std::vector<Port>& ports, std::string_view name) {
    const auto found = std::ranges::lower_bound(ports, name, {}, &Port::name);
    return found != ports.end() && found->name == name ? &*found : nullptr;
}

/// The names of all that the lists hold, for suggestions.
template <class... List>
[[nodiscard]] std::vector<std::string> names_of(const List&... lists) {
    std::vector<std::string> names;
    (std::ranges::transform(lists, std::back_inserter(names), &List::value_type::name), ...);
    return names;
}

/// Elements of an array without a size, unless more are asked for.
inline constexpr std::uint32_t kUnstatedLength = 16;

/// Which widths of numbers a caller knows; others are errors.
enum class Widths { of_32, up_to_32, up_to_64 };

struct DecodeOptions {
    std::uint32_t unstated_length = kUnstatedLength;  ///< of arrays without a size, as storage blocks have
    Widths widths = Widths::up_to_32;
};

/// Reads a vertex or fragment stage from the SPIR-V that glslang makes, with or without debug information.
/// Anything that evaluation does not know is an error that names the instruction and the line it comes from;
/// truncated or malformed modules are errors too.
[[nodiscard]] Result<Program> decode(std::span<const std::uint32_t> words, const DecodeOptions& options = {});

}  // namespace gobo::evaluate
