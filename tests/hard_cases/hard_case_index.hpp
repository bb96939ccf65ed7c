// The catalogue of hard cases: what each is, and where it is tried.
#pragma once

#include <string>
#include <vector>

namespace gobo {

struct HardCase {
    std::string name;   ///< "zero vector", as cases, plain shaders and other tests have it
    std::string code;   ///< "H-N1": nothing but the page's table has it
    std::string input;  ///< what happens to a shader
    std::string plain;  ///< what the plain formula makes of it
    /// Tests that are no rows of lit_cases(): paths below tests/, where the name stands; may be empty.
    std::vector<std::string> elsewhere;
};

/// In the order of the page.
[[nodiscard]] const std::vector<HardCase>& hard_cases();

}  // namespace gobo
