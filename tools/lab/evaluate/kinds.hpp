// The kinds of operations that are counted.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace gobo::evaluate {

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

inline constexpr std::size_t kKinds = 28;

/// How many operations of each kind.
using Counts = std::array<std::uint64_t, kKinds>;

inline constexpr std::array<std::string_view, kKinds> kKindNames = {
    "add",  "mul",    "div",     "fma",     "sqrt",      "inverse_sqrt", "pow",
    "exp",  "log",    "trig",    "dot",     "geometric", "round",        "min_max",
    "mix",  "matrix", "integer", "compare", "logic",     "select",       "convert",
    "move", "load",   "store",   "branch",  "call",      "derivative",   "image"};

/// The name as reports print it: "inverse_sqrt".
[[nodiscard]] constexpr std::string_view name_of(Kind kind) {
    return kKindNames[static_cast<std::size_t>(kind)];
}

}  // namespace gobo::evaluate
