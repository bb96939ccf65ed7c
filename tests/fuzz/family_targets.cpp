#include <algorithm>

#include "core/text.hpp"
#include "family/expression.hpp"
#include "family/key.hpp"
#include "family/selection.hpp"
#include "family_texts.hpp"
#include "results.hpp"
#include "targets.hpp"

namespace gobo::fuzz {

bool read_family(std::string_view input) {
    const Result<Family> family = family_of(parts_of(input));
    if (!is_value(family)) return false;
    for (const Key& key : some_keys(*family)) {
        const Result<Key> again = parse_key(*family, key_text(*family, key));
        require(again.has_value() && canonical(*family, *again, "450") == canonical(*family, key, "450"));
    }
    return true;
}

bool read_condition(std::string_view input) {
    const Family& family = small_family();
    const auto condition = parse_expression(input, family.features, {"c", 1, 1}, Fault::usage);
    if (!is_value(condition)) return false;
    const Expression opposite = negated(*condition);
    for (int fog = 0; fog < 3; ++fog)
        for (int point = 0; point < 4; ++point) {
            Key key(family.features.size(), 0);
            key[0] = fog;
            key[2] = point;
            require(holds(*condition, key) != holds(opposite, key));
        }
    return true;
}

bool read_selection(std::string_view input) {
    const Files parts = parts_of(input);
    const auto part = [&](const char* name) {
        const auto found = parts.find(name);
        return found == parts.end() ? std::string() : found->second;
    };
    Selection selection;
    selection.where = trim(part("where"));
    selection.over = split(part("over"), ',');
    selection.cover = static_cast<int>(split(part("cover"), ',').size());
    selection.all = !part("all").empty();
    selection.keys = keys_of_text(part("keys"), "keys");
    const Family& family = small_family();
    const auto keys = select(family, selection, "450");
    if (!is_value(keys)) return false;
    require(std::ranges::is_sorted(*keys) && std::ranges::adjacent_find(*keys) == keys->end());
    for (const Key& key : *keys) require(forbidding_rule(family, key, "450") == nullptr);
    return true;
}

}  // namespace gobo::fuzz
