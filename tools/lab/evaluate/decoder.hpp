// Turns a module into a Program: functions inlined, values given slots. Internal to evaluation.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include <spirv/unified1/GLSL.std.450.h>

#include "lab/evaluate/function_order.hpp"
#include "lab/evaluate/instruction_table.hpp"
#include "lab/evaluate/module.hpp"
#include "lab/evaluate/program.hpp"
#include "lab/evaluate/types.hpp"

namespace gobo::evaluate {

struct ImageCall;

/// Where a value is while the decoder works.
struct Value {
    std::uint32_t type = 0;
    std::uint32_t slot = 0;
    int allocation = -1;  ///< of slots that are given back after its last use; -1 for slots of its own
    int variable = -1;    ///< the variable whose slots it shares, valid until that is written; -1 for none
    std::uint32_t name = 0;
};

/// A place in a variable: fixed slots, and perhaps an offset that each lane computes.
struct Pointer {
    std::uint32_t type = 0;  ///< of what it points to
    std::uint32_t slot = 0;
    int variable = -1;
    std::optional<std::uint32_t> offset;  ///< slot
    std::uint32_t name = 0;
    std::string path;  ///< the name, as text
};

class Decoder {
  public:
    Decoder(const Module& module, const Types& types) : module_(module), types_(types) {}

    Result<Program> decode();

  private:
    struct Allocation {
        std::uint32_t slot = 0;
        std::uint32_t count = 0;
        std::uint32_t remaining = 0;  ///< uses to come
        bool is_free = false;
    };
    struct Variable {
        bool is_read_only = false;
    };
    /// A function that is being inlined.
    struct Frame {
        const Function* function = nullptr;
        UsesById uses;
        std::unordered_map<std::uint32_t, Value> values;
        std::unordered_map<std::uint32_t, Pointer> pointers;
        std::unordered_map<std::uint32_t, std::uint32_t> labels;  ///< SPIR-V label to ours
        std::uint32_t result_slot = 0;
        std::uint32_t result_type = 0;
        std::uint32_t return_label = Program::kEnd;
        std::uint32_t at = 0;  ///< instruction being decoded
    };
    /// The result of the instruction being decoded, where it must outlive its block.
    struct Kept {
        std::uint32_t slot = 0;
        std::uint32_t temporary = 0;
        std::uint32_t count = 0;
    };

    // decode.cpp: the module.
    void report(const Instruction& instruction, std::string message, std::string help = {});
    void report_unknown(const Instruction& instruction);
    const EntryPoint* find_entry_point();
    void finish_program();

    // decode_interface.cpp: constants, variables, ports.
    struct Layout {
        int block = -1;
        std::uint32_t offset = 0;  ///< bytes
        std::uint32_t matrix_stride = 0;
        bool is_row_major = false;
    };
    void decode_globals();
    void decode_constant(const Instruction& instruction);
    std::optional<std::vector<std::uint32_t>> constant_bits(const Instruction& instruction);
    void decode_variable(const Instruction& instruction);
    void set_default(const Instruction& variable, std::uint32_t type, std::uint32_t slot);
    void name_interface(const Instruction& variable, const Type& pointer, std::uint32_t slot);
    void add_ports(std::vector<Port>& ports, const std::string& name, std::uint32_t type, std::uint32_t slot,
                   int& location, const Layout& layout);
    void add_member_ports(std::vector<Port>& ports, const std::string& name, std::uint32_t type,
                          std::uint32_t slot, int& location, const Layout& layout);
    void add_leaf(std::vector<Port>& ports, const std::string& name, std::uint32_t type, std::uint32_t slot,
                  int& location, const Layout& layout);
    void initialise_globals();

    // decode_values.cpp: slots and lookups.
    std::uint32_t permanent(std::uint32_t count);
    std::uint32_t temporary(std::uint32_t count, std::uint32_t uses, int& allocation);
    void release(std::uint32_t id);
    void free_allocation(int allocation);
    std::uint32_t define(const Instruction& instruction);
    void share(const Instruction& instruction, const Value& value);
    [[nodiscard]] bool may_share(const Instruction& instruction, const Value& value);
    [[nodiscard]] bool is_written(int variable, std::uint32_t from, std::uint32_t to);
    [[nodiscard]] int variable_of(std::uint32_t pointer) const;
    void finish_instruction(const Instruction& instruction);
    Value value(const Instruction& instruction, std::uint32_t id);
    Pointer pointer(const Instruction& instruction, std::uint32_t id);
    [[nodiscard]] std::optional<std::uint32_t> constant_index(std::uint32_t id) const;
    std::uint32_t intern(const std::string& name);
    [[nodiscard]] Slice slice(const Value& value) const;
    Operation& emit(std::uint32_t code, const Instruction& instruction, std::uint32_t count,
                    std::uint32_t result, const std::vector<Value>& operands,
                    std::vector<std::uint32_t> words = {});
    Operation& emit_row(std::uint32_t row, const Instruction& instruction, std::uint32_t count,
                        std::uint32_t result, const std::vector<Value>& operands,
                        std::vector<std::uint32_t> words = {});
    void charge(Kind kind, std::uint32_t count);

    // decode_instruction.cpp: what stands in a block.
    void decode_instruction(const Instruction& instruction);
    bool decode_by_signature(const Instruction& instruction, std::uint32_t code, std::size_t first_operand);
    [[nodiscard]] bool fits(std::string_view signature, std::uint32_t result,
                            const std::vector<Value>& operands, std::uint32_t& count) const;
    void decode_extended(const Instruction& instruction);
    void decode_product(const Instruction& instruction);
    void decode_matrix_times_scalar(const Instruction& instruction);
    void decode_square(const Instruction& instruction, std::uint32_t code);
    void decode_two_results(const Instruction& instruction);
    void decode_split(const Instruction& instruction, std::uint32_t code, bool through_pointer);
    void decode_interpolate(const Instruction& instruction, std::uint32_t code);

    // decode_memory.cpp.
    void decode_local_variable(const Instruction& instruction);
    void decode_load(const Instruction& instruction);
    void decode_store(const Instruction& instruction);
    void store(const Instruction& instruction, const Pointer& target, const Value& value);
    void decode_access_chain(const Instruction& instruction);
    void share_or_copy(const Instruction& instruction, const Value& value);
    void decode_extract(const Instruction& instruction);
    void decode_construct(const Instruction& instruction);
    void decode_insert(const Instruction& instruction);
    void decode_shuffle(const Instruction& instruction);
    void decode_dynamic_component(const Instruction& instruction);
    bool step_into(const Instruction& instruction, std::uint32_t& type, std::uint32_t& slot,
                   std::uint32_t index);

    // decode_image.cpp.
    bool decode_image(const Instruction& instruction);
    void read_image_operands(const Instruction& instruction, std::size_t at, ImageCall& call,
                             std::vector<Value>& operands);

    // decode_flow.cpp: blocks and calls.
    void inline_function(const Function& function, Frame new_frame);
    void decode_block(const BasicBlock& basic);
    void decode_call(const Instruction& instruction);
    void decode_terminator(const BasicBlock& basic, const Instruction& instruction);
    void begin_block(std::uint32_t label);
    void end_block(Block::End end, std::uint32_t place);
    void jump(std::uint32_t label, std::uint32_t place);
    void decode_branch(const BasicBlock& basic, const Instruction& instruction);
    void decode_switch(const BasicBlock& basic, const Instruction& instruction);
    void add_edge(const BasicBlock& from, std::uint32_t spirv_label, const Instruction& instruction);
    void add_phi_copies(const BasicBlock& from, const BasicBlock& to, const Instruction& instruction);
    Value phi_value(const Instruction& phi);
    std::uint32_t new_label();
    [[nodiscard]] Block& block() { return program_.blocks.back(); }
    [[nodiscard]] Frame& frame() { return *frames_.back(); }

    const Module& module_;
    const Types& types_;
    Program program_;
    std::optional<Diagnostic> error_;
    std::vector<Frame*> frames_;
    std::unordered_map<std::uint32_t, Value> constants_;
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> constant_bits_;
    std::unordered_map<std::uint32_t, Pointer> globals_;
    std::vector<Variable> variables_;
    std::vector<Allocation> allocations_;
    std::map<std::uint32_t, std::vector<std::uint32_t>> free_slots_;  ///< by count: first slots
    std::vector<int> to_free_;                                        ///< after this instruction
    std::optional<Kept> kept_;
    std::vector<bool> is_quick_;               ///< of each operation
    std::vector<std::uint32_t> label_blocks_;  ///< block of each label
    std::map<std::string, std::uint32_t> name_indices_;
};

/// Programs beyond this many slots, operations or blocks are refused.
inline constexpr std::uint32_t kLargestProgram = 1U << 19U;
inline constexpr std::size_t kDeepestCall = 64;

}  // namespace gobo::evaluate
