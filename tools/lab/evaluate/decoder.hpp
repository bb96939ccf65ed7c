// Turns a module into a Program: functions inlined, values given slots. Internal to evaluation.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "lab/evaluate/functions.hpp"
#include "lab/evaluate/instruction_table.hpp"
#include "lab/evaluate/program.hpp"

namespace gobo::evaluate {

using spirv::Id;
using spirv::Instruction;
using spirv::Type;

struct ImageCall;

/// Where a value is while the decoder works; or, as a pointer, a place in a variable: fixed slots, and
/// perhaps an offset that each lane computes.
struct Value {
    Id type = Id::none;  ///< of what a pointer points to
    std::uint32_t slot = 0;
    int allocation = -1;     ///< of slots that are given back after its last use; -1 for slots of its own
    int variable = -1;       ///< whose slots it shares, valid until that is written; -1 for none
    std::uint32_t name = 0;  ///< index into Program::names
    bool is_pointer = false;
    std::uint32_t offset = 0;  ///< slot of a pointer's offset; 0 for none
    bool is_relaxed = false;   ///< a pointer to what is mediump or lowp
};

using Values = std::vector<Value>;
using Words = std::vector<std::uint32_t>;
/// Of each scalar of a constant.
using Bits = std::vector<std::uint64_t>;

class Decoder {
  public:
    Decoder(const spirv::Module& module, Widths widths) : module_(module), widths_(widths) {}

    Result<Program> decode();

  private:
    struct Allocation {
        std::uint32_t slot = 0;
        std::uint32_t count = 0;
        std::uint32_t remaining = 0;  ///< uses to come
        bool is_free = false;
    };
    /// A function that is being inlined.
    struct Frame {
        const Function* function = nullptr;
        UsesById uses;
        std::unordered_map<Id, Value> values;
        std::unordered_map<Id, std::uint32_t> labels;  ///< SPIR-V label to ours
        Value result;
        std::uint32_t return_label = Program::kEnd;
        std::uint32_t at = 0;  ///< instruction being decoded
    };
    /// Where a part of the interface lies.
    struct Location {
        std::uint32_t slot = 0;
        int block = -1;
        std::uint32_t offset = 0;  ///< bytes from the start of the block
        std::uint32_t matrix_stride = 0;
        bool is_row_major = false;
        bool is_written = false;  ///< it may be
    };
    /// A texel that an atomic function changes.
    struct Texel {
        Value image;
        Value coordinates;
        Value sample;
    };

    // decode.cpp: the module, its functions, blocks and calls.
    void report(const Instruction& instruction, std::string message);
    void report_types(const Instruction& instruction);
    void report_type(const Instruction& type, std::string message);
    [[nodiscard]] bool contains(Id whole, Id part) const;
    void check_width(const Instruction& type);
    void check_types();
    void finish_program();
    void inline_function(const Function& function, Frame new_frame);
    void decode_block(const BasicBlock& basic);
    void decode_call(const Instruction& instruction);
    void decode_terminator(const BasicBlock& basic, const Instruction& instruction);
    void begin_block(std::uint32_t label);
    void end_block(Block::End end, std::uint32_t line);
    void jump(std::uint32_t label, std::uint32_t line);
    void decode_branch(const BasicBlock& basic, const Instruction& instruction);
    void decode_switch(const BasicBlock& basic, const Instruction& instruction);
    void add_edge(const BasicBlock& from, Id label, const Instruction& instruction);
    void add_phi_copies(const BasicBlock& from, const BasicBlock& to);
    Value phi_value(const Instruction& phi);
    std::uint32_t new_label();
    [[nodiscard]] Block& block() { return program_.blocks.back(); }
    [[nodiscard]] Frame& frame() { return *frames_.back(); }

    // decode_interface.cpp: constants, variables outside functions, ports.
    void decode_globals();
    void decode_constant(const Instruction& instruction);
    [[nodiscard]] std::optional<Bits> constant_bits(const Instruction& instruction) const;
    [[nodiscard]] std::optional<Bits> computed_bits(const Instruction& instruction) const;
    void add_constants(Id type, std::uint32_t slot, std::span<const std::uint64_t> bits);
    std::optional<Value> new_variable(const Instruction& instruction, const std::string& name,
                                      bool is_read_only);
    void decode_variable(const Instruction& instruction);
    [[nodiscard]] bool is_storage_block(const Instruction& variable) const;
    [[nodiscard]] bool may_write(const Instruction& variable) const;
    void name_interface(const Instruction& variable, Id type, std::uint32_t slot);
    void add_blocks(const std::string& name, Id type, int& number, Location at);
    void add_ports(std::vector<Port>& ports, const std::string& name, Id type, int& number,
                   const Location& at);
    void add_leaf(std::vector<Port>& ports, const std::string& name, Id type, int& number,
                  const Location& at);
    void initialise_globals();

    // decode_values.cpp: slots and lookups.
    [[nodiscard]] bool is_relaxed(Id id) const {
        return module_.decoration(id, spv::DecorationRelaxedPrecision).has_value();
    }
    [[nodiscard]] const Type& type(Id id) const { return module_.type(id); }
    [[nodiscard]] const Type& type(const Value& value) const { return module_.type(value.type); }
    [[nodiscard]] bool is_one(const Value& value, bool (*fits)(Scalar)) const;
    [[nodiscard]] Id part_type(Id type, std::uint32_t index) const;
    [[nodiscard]] std::uint32_t part_offset(Id type, std::uint32_t index) const;
    std::uint32_t permanent(std::uint32_t count);
    std::uint32_t temporary(std::uint32_t count, std::uint32_t uses = 0, int* allocation = nullptr);
    void release(Id id);
    void release_operands(const Instruction& instruction);
    void free_released();
    std::uint32_t define(const Instruction& instruction);
    void share(const Instruction& instruction, const Value& value);
    [[nodiscard]] bool may_share(const Instruction& instruction, const Value& value);
    [[nodiscard]] bool is_written(int variable, std::uint32_t from, std::uint32_t to) const;
    [[nodiscard]] int variable_of(Id pointer) const;
    void finish_instruction(const Instruction& instruction);
    [[nodiscard]] const Value* find(Id id, bool is_pointer) const;
    Value operand(const Instruction& instruction, std::size_t word, bool is_pointer);
    Value value(const Instruction& instruction, std::size_t word) {
        return operand(instruction, word, false);
    }
    Value pointer(const Instruction& instruction, std::size_t word) {
        return operand(instruction, word, true);
    }
    Values values(const Instruction& instruction, std::size_t first_word);
    std::uint32_t intern(const std::string& name);
    [[nodiscard]] Slice slice(const Value& value) const;
    void emit(std::uint32_t code, const Instruction& instruction, std::uint32_t count, std::uint32_t result,
              const Values& operands, Words words = {});
    void emit_row(std::uint32_t row, const Instruction& instruction, std::uint32_t count,
                  std::uint32_t result, const Values& operands, Words words = {});
    void copy(const Instruction& instruction, std::uint32_t count, std::uint32_t to, const Value& from);
    Value of_relaxed(const Value& operand);
    void charge(Kind kind, std::uint32_t count);

    // decode_instruction.cpp: what stands in a block.
    void decode_instruction(const Instruction& instruction);
    bool decode_by_signature(const Instruction& instruction, std::uint32_t code, std::size_t first_operand);
    [[nodiscard]] std::optional<std::uint32_t> components(std::string_view signature, Id result,
                                                          const Values& operands) const;
    void decode_extended(const Instruction& instruction);
    void decode_product(const Instruction& instruction);
    void decode_square(const Instruction& instruction, std::uint32_t code);
    void decode_split(const Instruction& instruction, std::uint32_t code);
    void decode_interpolate(const Instruction& instruction, std::uint32_t code);

    void decode_local_variable(const Instruction& instruction);
    void decode_copy(const Instruction& instruction);
    void decode_load(const Instruction& instruction);
    void decode_store(const Instruction& instruction);
    void store(const Instruction& instruction, const Value& target, const Value& value);
    void store_relaxed(const Instruction& instruction, Value target, const Value& value);
    void decode_access_chain(const Instruction& instruction);
    void share_or_copy(const Instruction& instruction, const Value& value);
    void decode_extract(const Instruction& instruction);
    void decode_construct(const Instruction& instruction);
    void decode_insert(const Instruction& instruction);
    void decode_shuffle(const Instruction& instruction);
    void decode_dynamic_component(const Instruction& instruction);
    bool step_into(const Instruction& instruction, Id& type, std::uint32_t& slot, std::uint32_t index);
    [[nodiscard]] std::string part_name(const std::string& whole, Id type, std::uint32_t index) const;

    // image_functions.cpp.
    bool decode_image(const Instruction& instruction);
    void read_image_operands(const Instruction& instruction, std::size_t at, ImageCall& call,
                             Values& operands);

    // decode_storage.cpp: atomic functions, images that are written, lengths of arrays.
    void decode_image_write(const Instruction& instruction);
    void decode_texel_pointer(const Instruction& instruction);
    void decode_atomic(const Instruction& instruction);
    void decode_length(const Instruction& instruction);
    Value read_texel(const Instruction& instruction, const Texel& texel);
    void write_texel(const Instruction& instruction, const Texel& texel, const Value& value);
    [[nodiscard]] ImageCall call_of_texel(const Instruction& instruction, const Texel& texel);
    Value constant(Id type, std::uint32_t bits);

    const spirv::Module& module_;
    Widths widths_;
    Functions functions_;
    Id std450_ = Id::none;  ///< the GLSL.std.450 instruction set
    Program program_;
    std::optional<Diagnostic> error_;
    std::vector<Frame*> frames_;
    std::unordered_map<std::uint32_t, std::uint32_t> relaxed_slots_;  ///< of_relaxed(): by the constant's own
    std::unordered_map<Id, Value> globals_;  ///< constants, and pointers to variables outside functions
    std::unordered_map<Id, Bits> constant_bits_;
    std::vector<bool> is_read_only_;  ///< of each variable
    std::vector<Allocation> allocations_;
    std::map<std::uint32_t, Words> free_slots_;  ///< by count: first slots
    std::vector<int> to_free_;                   ///< after this instruction
    std::optional<std::uint32_t> kept_;          ///< slot of a result that is still to be copied to its own
    std::vector<bool> is_quick_;                 ///< of each operation
    Words label_blocks_;                         ///< block of each label
    std::map<std::string, std::uint32_t> name_indices_;
    std::unordered_map<Id, Texel> texels_;  ///< pointers to them
};

/// Programs beyond this many slots, operations or blocks are refused.
inline constexpr std::uint32_t kLargestProgram = 1U << 19U;

/// What arrays are indexed by.
[[nodiscard]] inline bool is_index(Scalar scalar) {
    return !is_float(scalar) && !is_wide(scalar) && scalar != Scalar::boolean;
}
[[nodiscard]] inline bool is_boolean(Scalar scalar) {
    return scalar == Scalar::boolean;
}

/// The length of a list as slots, operations and words are counted.
template <class List>
[[nodiscard]] std::uint32_t length_of(const List& list) {
    return static_cast<std::uint32_t>(list.size());
}

}  // namespace gobo::evaluate
