// The catalogue of hard cases: what each is, and where it is tried.
#pragma once

#include <string>
#include <vector>

namespace gobo {

struct HardCase {
    std::string id;     ///< "H-N1", as names of cases, marks of guards and plain shaders have it
    std::string input;  ///< what happens to a shader
    std::string plain;  ///< what the plain formula makes of it
    /// Tests that are no rows of lit_cases(): paths below tests/, where the id stands; may be empty.
    std::vector<std::string> elsewhere;
};

/// In the order of the page.
[[nodiscard]] const std::vector<HardCase>& hard_cases();

/// "H-N1" of "H_N1_zero_normal", and "zero normal"; "H-D1, H-D2" where a case is of both; "S15" of
/// a model's own case.
struct CaseName {
    std::string id;
    std::string what;
};
[[nodiscard]] CaseName case_name(const std::string& name);

}  // namespace gobo
