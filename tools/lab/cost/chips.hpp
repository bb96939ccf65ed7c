// The chips whose compilers can be asked, and how their drivers are told which one to be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"

namespace gobo::cost {

/// A GPU that Mesa's RADV compiles for without the hardware.
struct Chip {
    std::string_view name;          ///< as --gpu has it; in capitals the value of RADV_FORCE_FAMILY
    std::string_view architecture;  ///< "RDNA2"
    std::string_view sold_as;       ///< a product that has it
};

/// All of them, old ones first. A driver need not know each.
[[nodiscard]] const std::vector<Chip>& chips();

/// The chips of those names, in capitals or not, each once, in the order given. Fault::usage for a name that
/// none has, with the nearest one.
[[nodiscard]] Result<std::vector<Chip>> chips_named(const std::vector<std::string>& names);

/// What to install where a chip is unknown or the driver is missing.
inline constexpr const char* kInstallDriver =
    "install Mesa's Vulkan driver: apt-get install mesa-vulkan-drivers";
inline constexpr const char* kInstallNewer =
    "a newer mesa-vulkan-drivers may know it (on Debian 12: apt-get install -t bookworm-backports "
    "mesa-vulkan-drivers); 'gobo cost --gpu list' says which chips this one knows";

}  // namespace gobo::cost
