#include "figures.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gobo::models {

Result<Figures> read_figures(std::string_view json, const std::string& path) {
    try {  // the library tells of errors by exceptions; none leaves this function
        const nlohmann::json root = nlohmann::json::parse(json);
        Figures figures;
        figures.family = root.at("family");
        for (const nlohmann::json& row : root.at("permutations")) {
            figures.permutations.push_back({row.at("key"), row.at("points"), row.at("largest_fp32_error"),
                                            row.at("largest_fp64_error")});
        }
        return figures;
    } catch (const nlohmann::json::exception& error) {
        return fail(Fault::input, fmt::format("{}: {}", path, error.what()),
                    "write it by: gobo test FAMILY --cover 3 --figures FILE");
    }
}

}  // namespace gobo::models
