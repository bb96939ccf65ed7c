#include "lab/verify/figures_json.hpp"

#include <nlohmann/json.hpp>

#include "family/key.hpp"

namespace gobo::verify {

std::string figures_json(const Family& family, const VerifyReport& report) {
    using Json = nlohmann::ordered_json;
    Json permutations = Json::array();
    for (const PermutationReport& permutation : report.permutations)
        permutations.push_back({{"key", key_text(family, permutation.key)},
                                {"points", permutation.figures.points},
                                {"largest_fp32_error", permutation.figures.largest_fp32_error},
                                {"largest_fp64_error", permutation.figures.largest_fp64_error}});
    const Json figures = {{"family", family.name}, {"permutations", std::move(permutations)}};
    return figures.dump(1) + "\n";
}

}  // namespace gobo::verify
