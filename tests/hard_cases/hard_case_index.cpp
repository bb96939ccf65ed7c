#include "hard_case_index.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/text.hpp"

namespace gobo {
namespace {

const std::vector<HardCase> kHardCases = {
    {"H-N1", "a vector of length 0 to be normalized", "NaN", {}},
    {"H-N2", "a vector of length 1e-20 and less", "its square underflows: infinity or NaN", {}},
    {"H-N3", "a vector of length 1e20 and more", "its square overflows: the zero vector", {}},
    {"H-N4", "a light exactly behind the viewer's ray", "the half vector is NaN", {}},
    {"H-S1", "pow(0, 0): shininess and cosine 0", "undefined", {}},
    {"H-S2", "a base of a power slightly below 0", "NaN, or a highlight that comes back", {}},
    {"H-S3",
     "shininess of 1e4 to 1e6",
     "the highlight is off by 0.05 and more",
     {"hard_cases/sharp_highlights_test.cpp"}},
    {"H-S4", "a light behind the surface", "a highlight on the dark side", {}},
    {"H-L1", "a light at the surface point", "0 / 0", {}},
    {"H-L2", "all attenuation coefficients 0", "1 / 0", {}},
    {"H-L3", "intensity 1e30, exponent 1e6, distance 1e19", "infinity and NaN", {}},
    {"H-P1", "inner cone and outer cone are one", "smoothstep with equal edges: undefined", {}},
    {"H-P2", "a cutoff of 0, 90 or 180 degrees", "light leaks, or is missing", {}},
    {"H-P3", "behind the light, inside a wide cone", "a power of a negative cosine: NaN", {}},
    {"H-P4", "a cutoff of 1e-4 radians", "a cosine resolves 3.5e-4 radians", {}},
    {"H-F1", "fog whose near is its far", "0 / 0", {}},
    {"H-F2", "a coordinate of 1e20 in radial fog", "the length overflows", {}},
    {"H-F3", "an infinite colour behind fog that hides it", "0 times infinity: NaN", {}},
    {"H-T1", "a cosine of exactly 1 with tones", "one more tone, brighter than the top one", {}},
    {"H-T2", "a cosine beside an edge of two tones", "a rounding decides", {}},
    {"H-G1", "a singular model matrix", "its inverse is NaN", {"unit/normal_matrix_test.cpp"}},
    {"H-G2", "a mirrored model, two-sided", "the wrong side is lit", {"unit/normal_matrix_test.cpp"}},
    {"H-G3", "a scale of 1 : 1e4", "normals of other surfaces", {"unit/normal_matrix_test.cpp"}},
    {"H-D1",
     "a depth outside [0, 1], or none at all",
     "clamped, or the fragment is lost",
     {"hard_cases/depth_targets_test.cpp"}},
    {"H-D2",
     "a depth that is not where it was promised",
     "nobody says so",
     {"hard_cases/depth_targets_test.cpp"}},
    {"H-W1", "a shadow's coordinate with w not above 0", "a mirrored texel's shadow, or NaN", {}},
    {"H-W2",
     "light at a grazing angle on a shadow's map",
     "surfaces shade themselves, or shadows come off",
     {"verify/shadow_picture_test.cpp"}},
    {"H-B1",
     "one bright small light in spherical harmonics",
     "negative irradiance",
     {"unit/light_probes_test.cpp"}},
    {"H-X1", "a radiance of 1e5 to a target of 16-bit floats", "infinity", {}},
    {"H-X2",
     "a sum of 4096 lights",
     "off by 4e-5",
     {"hard_cases/light_sum_test.cpp", "hard_cases/drawn_light_sum_test.cpp"}},
    {"H-I1",
     "interpolation leaves a quantity's range by a rounding",
     "roots of negative numbers, negative light",
     {}},
};

/// "H", "N1", "S15".
bool is_id(const std::string& word) {
    return !word.empty() && word.front() >= 'A' && word.front() <= 'Z' &&
           std::all_of(word.begin() + 1, word.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

const std::vector<HardCase>& hard_cases() {
    return kHardCases;
}

CaseName case_name(const std::string& name) {
    std::vector<std::string> words = split(name, '_');
    std::vector<std::string> ids;
    std::size_t at = 0;
    for (; at < words.size() && is_id(words[at]); ++at)
        if (words[at] != "H") ids.push_back(words.front() == "H" ? "H-" + words[at] : words[at]);
    words.erase(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(at));
    return {fmt::format("{}", fmt::join(ids, ", ")), fmt::format("{}", fmt::join(words, " "))};
}

}  // namespace gobo
