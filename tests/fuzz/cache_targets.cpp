#include "core/result_cache.hpp"
#include "results.hpp"
#include "targets.hpp"
#include "validate/batch.hpp"
#include "validate/known_results.hpp"

namespace gobo::fuzz {

bool read_declarations(std::string_view input) {
    static_cast<void>(declarations_of(input));
    static_cast<void>(sizes_by_use(input));
    return true;
}

bool read_cache(std::string_view input) {
    const auto result = result_of(input);
    if (result) require(result_of(bytes_of(*result)).has_value());
    return result.has_value();
}

}  // namespace gobo::fuzz
