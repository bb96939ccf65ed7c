// The expressions that single operations of a stage become.
#pragma once

#include <unordered_map>
#include <vector>

#include "lab/evaluate/image_call.hpp"
#include "lab/evaluate/instruction_table.hpp"
#include "lab/prove/expression_builder.hpp"

namespace gobo::prove {

/// Which expression each slot holds.
using Slots = std::vector<std::uint32_t>;

class OperationUnroller {
  public:
    using Id = ExpressionBuilder::Id;

    OperationUnroller(const evaluate::Program& program, const sanitize::InputSpace& space,
                      ExpressionBuilder& builder)
        : program_(program), space_(space), builder_(builder) {}

    /// Those of the operation's result; what is written by an index is changed in the slots. `operands` are
    /// all components of all operands.
    std::vector<Id> results_of(const evaluate::Operation& operation, const evaluate::OperationInfo& info,
                               const evaluate::Row& row, const std::vector<Id>& operands, Slots& slots);

  private:
    std::vector<Id> texels(const evaluate::Operation& operation, const evaluate::OperationInfo& info,
                           const evaluate::Row& row, const Slots& slots);
    /// What a texture may answer: what its domain says of the channel, or 0, as beyond a border.
    Range texel(const evaluate::ImageCall& call, const Slots& slots, std::uint32_t component);
    Id clamped_index(Id index, std::size_t count);
    /// Of the offset in that slot; only those within what is known of it.
    std::vector<std::uint32_t> possible_offsets(Id offset);
    std::vector<Id> gather(const evaluate::Operation& operation, Slots& slots);
    std::vector<Id> scatter(const evaluate::Operation& operation, Slots& slots);

    const evaluate::Program& program_;
    const sanitize::InputSpace& space_;
    ExpressionBuilder& builder_;
    std::unordered_map<Id, std::vector<std::uint32_t>> offsets_;  ///< of each address all that it may be
};

}  // namespace gobo::prove
