#include "core/glsl_version.hpp"

#include <algorithm>
#include <array>

namespace gobo {

bool is_glsl_version(std::string_view text) {
    constexpr std::array<std::string_view, 17> numbers = {"100", "110", "120", "130", "140", "150",
                                                          "300", "310", "320", "330", "400", "410",
                                                          "420", "430", "440", "450", "460"};
    const std::string_view number = text.substr(0, text.find_first_of(" \t"));
    if (std::ranges::find(numbers, number) == numbers.end()) return false;
    const auto behind = text.find_first_not_of(" \t", number.size());
    const std::string_view profile = behind == std::string_view::npos ? "" : text.substr(behind);
    if (number >= "300" && number < "330") return profile == "es";
    return profile.empty() || (number >= "150" && (profile == "core" || profile == "compatibility"));
}

}  // namespace gobo
