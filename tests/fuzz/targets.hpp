// What is given inputs of every kind: by libFuzzer (-D GOBO_FUZZ=ON), and by the normal tests those of
// corpus/.
#pragma once

#include <array>
#include <string_view>

namespace gobo::fuzz {

struct Target {
    std::string_view name;  ///< of its folder in corpus/ too
    void (*run)(std::string_view input);
};

/// Every one of them either ends in a value or in errors with messages; anything else aborts.
extern const std::array<Target, 12> kTargets;

}  // namespace gobo::fuzz
