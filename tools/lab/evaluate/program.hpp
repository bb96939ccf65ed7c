// A stage made ready to be evaluated: flat operations over numbered slots, in blocks.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/diagnostic.hpp"
#include "lab/evaluate/kinds.hpp"
#include "lab/evaluate/types.hpp"

namespace gobo::evaluate {

/// Consecutive slots that hold one value.
struct Slice {
    std::uint32_t slot = 0;
    std::uint32_t count = 0;
    Scalar scalar = Scalar::real;  ///< of the first slot; a struct's others may differ
    std::uint32_t name = 0;        ///< index into Program::names; 0 where it has none
};

/// One operation, as the machine runs it.
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
    Scalar scalar = Scalar::real;
    std::uint32_t bits = 0;  ///< of the 32-bit value
};

/// A scalar, vector or matrix of the interface.
struct Port {
    std::string name;  ///< "normal", "gl_Position", "PointLights.lights[0].position"
    std::string type;  ///< GLSL name: "vec3"
    int location = -1;
    std::uint32_t slot = 0;
    std::uint32_t components = 1;  ///< column by column
    Scalar scalar = Scalar::real;
    // Uniform blocks: where it lies in the block's bytes.
    int block = -1;                      ///< index into Program::uniform_blocks
    std::vector<std::uint32_t> offsets;  ///< of each component
};

/// A uniform block by name, for filling it from bytes.
struct UniformBlock {
    std::string name;
    std::uint32_t size = 0;  ///< bytes up to the end of the last member
};

/// A sampler or image of the interface; each element of an array is one.
struct ImagePort {
    std::string name;  ///< "tex", "maps[2]"
    ImageType type;
    std::uint32_t slot = 0;  ///< holds the index of this ImagePort
};

/// A decoded stage. A value: owns all it needs, may be run by many threads at once.
struct Program {
    static constexpr std::uint32_t kEnd = 0x7fffffff;  ///< target of an edge that ends the invocation

    bool is_fragment = false;
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
        variables;                                ///< slots set to zero first: start, count
    std::vector<Port> inputs, outputs, uniforms;  ///< sorted by name
    std::vector<UniformBlock> uniform_blocks;
    std::vector<ImagePort> images;
    std::vector<Place> places;       ///< places[0] is unknown
    std::vector<std::string> names;  ///< names[0] is empty

    [[nodiscard]] const Place& place_of(std::uint32_t operation) const {
        return places[infos[operation].place];
    }
};

/// Reads a vertex or fragment stage from the SPIR-V that glslang makes with OpenGL semantics, with or without
/// debug information. Anything that evaluation does not know is an error that names the instruction and the
/// line it comes from; truncated or malformed modules are errors too.
[[nodiscard]] Result<Program> decode(std::span<const std::uint32_t> words);

}  // namespace gobo::evaluate
