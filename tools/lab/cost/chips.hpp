// The chips whose compilers can be asked, and how their drivers are told which one to be.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"

namespace gobo::cost {

enum class Maker : std::uint8_t {
    amd,    ///< compiled for by Mesa's RADV
    nvidia  ///< by Mesa's NVK
};

/// A GPU that one of Mesa's drivers compiles for without the hardware.
struct Chip {
    std::string_view name;          ///< as --gpu has it; AMD's in capitals the value of RADV_FORCE_FAMILY
    std::string_view architecture;  ///< "RDNA2"
    std::string_view sold_as;       ///< a product that has it
    Maker maker = Maker::amd;
    std::string_view chipset = {};  ///< NVIDIA's, in hexadecimal: the value of NOUVEAU_CHIPSET
};

/// All of them, old ones first. A driver need not know each.
[[nodiscard]] const std::vector<Chip>& chips();

/// The chips of those names, in capitals or not, each once, in the order given. Fault::usage for a name that
/// none has, with the nearest one.
[[nodiscard]] Result<std::vector<Chip>> chips_named(const std::vector<std::string>& names);

/// What to install where the maker's driver is missing.
[[nodiscard]] std::string_view install_driver(Maker maker);
/// What to do where the driver does not know the chip.
[[nodiscard]] std::string_view install_newer(const Chip& chip);

}  // namespace gobo::cost
