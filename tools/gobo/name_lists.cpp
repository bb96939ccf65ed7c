#include "gobo/name_lists.hpp"

#include <fmt/format.h>

#include "core/text.hpp"

namespace gobo {

Result<std::vector<std::string>> names_in(std::string_view option, const std::vector<std::string>& lists) {
    for (const std::string& names : lists)
        if (has_empty_part(names, ','))
            return fail(Fault::usage, fmt::format("{}: '{}' holds an empty name", option, names),
                        "write one comma between two names");
    return split(join(lists, ","), ',');
}

}  // namespace gobo
