#include "small_families.hpp"

#include <algorithm>
#include <stdexcept>

#include "family/key.hpp"
#include "family/read_family.hpp"

namespace gobo {

Family family_of(const std::string& body) {
    const std::string head = "name = \"tiny\"\nvertex = \"tiny.vert\"\nfragment = \"tiny.frag\"\n";
    Result<Family> family = read_family(head + body, "tiny.toml", {});
    if (!family) throw std::invalid_argument(first_text(family.error()));
    return std::move(*family);
}

Family lit_family() {
    const std::string path = GOBO_SOURCE_DIR "/templates/lit.toml";
    return read_family(DiskFileSystem().read(path).value(), "templates/lit.toml", {}).value();
}

const std::vector<std::pair<std::string, std::string>>& small_families() {
    static const std::vector<std::pair<std::string, std::string>> families = {
        {"without_features", ""},
        {"one_choice", "[features.a]\nvalues = [\"x\", \"y\", \"z\"]\n"},
        {"no_rules",
         "[features]\na = { values = [\"x\", \"y\"] }\nb = { count = [0, 2], constant = \"B\" }\n"
         "c = { define = \"C\" }\n"},
        {"defaults_in_chain",
         "[features]\na = { values = [\"x\", \"y\"] }\nb = { values = [\"x\", \"y\", \"z\"] }\n"
         "c = { define = \"C\" }\nd = { count = [0, 3], constant = \"D\" }\n"
         "[[rules]]\nwhen = \"b == x\"\ndefault = [\"c\"]\n"
         "[[rules]]\nwhen = \"a == x\"\ndefault = [\"b\"]\n"},
        {"sums",
         "[features]\na = { count = [0, 4], constant = \"A\" }\nb = { count = [0, 4], constant = \"B\" }\n"
         "c = { count = [0, 4], constant = \"C\" }\ns = { values = [\"x\", \"y\", \"z\"] }\n"
         "[[rules]]\nforbid = \"s == y && a + b + c > 6\"\nreason = \"too many\"\n"
         "[[rules]]\nwhen = \"a + b == 0\"\ndefault = [\"s\"]\n"
         "[[rules]]\nforbid = \"!(a != 3 || b < 2) || a + a >= 8\"\nreason = \"odd\"\n"},
        {"counts_with_counts",
         "[features]\na = { count = [0, 3], constant = \"A\" }\nb = { count = [0, 4], constant = \"B\" }\n"
         "c = { count = [0, 2], constant = \"C\" }\n"
         "[[rules]]\nwhen = \"a == 0\"\ndefault = [\"b\"]\n"
         "[[rules]]\nforbid = \"b > a || c > a + b\"\nreason = \"more than there are\"\n"},
        {"dialects_and_excluded",
         "[features]\na = { values = [\"x\", \"y\", \"z\"], excluded = [\"z\"] }\nb = { define = \"B\" }\n"
         "[[rules]]\nforbid = \"a == y && b == on\"\nreason = \"no\"\ndialects = [\"330\"]\n"},
        {"nothing_left",
         "[features.a]\nvalues = [\"x\", \"y\"]\n[[rules]]\nforbid = \"a == x || a == y\"\n"
         "reason = \"nothing works\"\n"},
    };
    return families;
}

std::vector<Key> product_of(const Family& family, const std::vector<int>& over) {
    std::vector<Key> keys = {{}};
    for (std::size_t i = 0; i < family.features.size(); ++i) {
        const bool varies = over.empty() || std::count(over.begin(), over.end(), static_cast<int>(i)) > 0;
        const int values = varies ? static_cast<int>(family.features[i].values.size()) : 1;
        std::vector<Key> longer;
        for (const Key& key : keys) {
            for (int value = 0; value < values; ++value) {
                longer.push_back(key);
                longer.back().push_back(value);
            }
        }
        keys = std::move(longer);
    }
    return keys;
}

std::vector<Key> keys_by_trying(const Family& family, std::string_view dialect,
                                const KeySpaceLimits& limits) {
    std::vector<Key> kept;
    for (const Key& key : product_of(family, limits.over)) {
        bool keep =
            canonical(family, key, dialect) == key && forbidding_rule(family, key, dialect) == nullptr;
        for (const Expression& where : limits.where) keep = keep && holds(where, key);
        for (std::size_t i = 0; i < key.size(); ++i) {
            const Feature& feature = family.features[i];
            const std::string& value = feature.values[static_cast<std::size_t>(key[i])];
            const bool is_excluded = std::count(feature.excluded.begin(), feature.excluded.end(), value) > 0;
            const bool varies = limits.over.empty() ||
                                std::count(limits.over.begin(), limits.over.end(), static_cast<int>(i)) > 0;
            keep = keep && (limits.excluded || !is_excluded) && (varies || key[i] == 0);
        }
        if (keep) kept.push_back(key);
    }
    return kept;
}

std::string first_text(const Diagnostics& diagnostics) {
    return diagnostics.empty() ? "" : to_text(diagnostics.front());
}

}  // namespace gobo
