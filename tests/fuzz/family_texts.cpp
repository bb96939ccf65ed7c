#include "family_texts.hpp"

#include <algorithm>

#include "core/text.hpp"
#include "family/read_family.hpp"
#include "family/selection.hpp"
#include "results.hpp"

namespace gobo::fuzz {

Files parts_of(std::string_view input) {
    Files parts;
    std::string name;
    while (!input.empty()) {
        const std::size_t end = std::min(input.find('\n'), input.size() - 1) + 1;
        const std::string_view line = input.substr(0, end);
        input.remove_prefix(end);
        if (line.starts_with("---- "))
            name = trim(line.substr(5));
        else
            parts[name] += line;
    }
    return parts;
}

const Family& small_family() {
    static const Family family = read_family(R"(name = "tiny"
vertex = "tiny.vert"
fragment = "tiny.frag"
[features.fog]
values = ["none", "linear", "exponential"]
[features.shade]
define = "SHADED"
[features.point]
count = [0, 3]
constant = "POINTS"
[features.spot]
count = [1, 4]
constant = "SPOTS"
[[rules]]
forbid = "fog == none && point + spot > 3"
reason = "too many"
)",
                                             "tiny.toml")
                                     .value();
    return family;
}

std::vector<Key> some_keys(const Family& family) {
    constexpr std::size_t most_keys = 16;
    constexpr std::size_t most_values = 200;  // covers of more take seconds: tests/errors/cases has some
    std::size_t values = 0;
    for (const Feature& feature : family.features) values += feature.values.size();
    if (values > most_values) return {};
    const Result<std::vector<Key>> keys = select(family, {}, "450");
    if (!is_value(keys)) return {};
    return {keys->begin(), keys->begin() + static_cast<std::ptrdiff_t>(std::min(keys->size(), most_keys))};
}

Result<Family> family_of(const Files& parts) {
    const auto text = parts.find(parts.contains("family.toml") ? "family.toml" : "");
    const auto find_base = [&](const std::string& base) -> Result<FamilyText> {
        const auto found = parts.find(base);
        if (found == parts.end()) return fail(Fault::usage, "there is no such family");
        return FamilyText{found->second, base};
    };
    return read_family(text == parts.end() ? "" : text->second, "f.toml", find_base);
}

}  // namespace gobo::fuzz
