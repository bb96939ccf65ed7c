// Undefined operations on constants: compilers fold them, so that no evaluation of the SPIR-V meets them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gobo::sanitize {

struct ConstantFault {
    int line = 0;           ///< of the text
    std::string message;    ///< as of a trap: "division by zero"
    std::string operation;  ///< "FDiv 1, 0 -> inf"

    friend bool operator==(const ConstantFault&, const ConstantFault&) = default;
};

/// Those of a stage's source, after the preprocessor, in the order of their lines. Functions that main()
/// never reaches are left out, and what a constant condition keeps from being computed.
[[nodiscard]] std::vector<ConstantFault> faults_of_constants(std::string_view source);

}  // namespace gobo::sanitize
