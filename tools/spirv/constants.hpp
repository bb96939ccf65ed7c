// The values of constants: integers, booleans and vectors of them, as they are before a pipeline chooses any.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

#include "spirv/module.hpp"

namespace gobo::spirv {

/// A constant of up to four components: their bits, without those above the component's width.
struct Constant {
    std::array<std::uint64_t, 4> bits = {};
    std::uint32_t count = 1;
    int width = 32;  ///< bits of a component; 1 of a boolean
};

/// Works out constants, in the order in which a module declares them. Those that can be specialised stand at
/// their defaults, or at what `chosen` says by constant_id. Integers wrap around. What SPIR-V leaves
/// undefined (a division by zero, a shift by more bits than there are) has no value, nor has what is computed
/// from it.
class Constants {
  public:
    explicit Constants(const Module& module, std::map<std::uint32_t, std::uint32_t> chosen = {})
        : module_(module), chosen_(std::move(chosen)) {}

    /// Takes the next instruction; does nothing where it is no constant.
    void add(const Instruction& instruction);

    /// Of a scalar or vector that was added; nothing for floats and for what has no value.
    [[nodiscard]] std::optional<Constant> value(Id id) const;

    /// A scalar integer that was added, with a sign where its type has one; nothing beyond 63 bits.
    [[nodiscard]] std::optional<std::int64_t> integer(const Instruction& constant) const;

  private:
    [[nodiscard]] std::optional<Constant> value_of(const Instruction& instruction) const;
    [[nodiscard]] std::optional<Constant> computed(const Instruction& instruction) const;
    [[nodiscard]] std::optional<Constant> composed(const Instruction& instruction, std::size_t first) const;
    [[nodiscard]] std::optional<Constant> shuffled(const Instruction& instruction) const;
    [[nodiscard]] std::optional<Constant> part(Id whole, std::vector<std::uint32_t> path) const;
    /// The shape of a value of that type, all zeros; nothing where it is no integer, boolean or vector.
    [[nodiscard]] std::optional<Constant> zero(Id type) const;

    const Module& module_;
    std::map<std::uint32_t, std::uint32_t> chosen_;
    std::unordered_map<Id, Constant> values_;
};

}  // namespace gobo::spirv
