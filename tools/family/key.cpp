#include "family/key.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

#include <fmt/format.h>

#include "core/text.hpp"

namespace gobo {
namespace {

std::vector<std::string> feature_names(const Family& family) {
    std::vector<std::string> names;
    for (const Feature& feature : family.features) names.push_back(feature.name);
    return names;
}

tl::unexpected<Diagnostics> key_error(const Place& place, std::string_view text, std::string message,
                                      std::string help) {
    Diagnostic diagnostic;
    diagnostic.fault = Fault::usage;
    diagnostic.place = place;
    if (!place.file.empty()) diagnostic.quoted_line = text;
    diagnostic.message = std::move(message);
    diagnostic.help = std::move(help);
    return fail(std::move(diagnostic));
}

std::string values_help(const Feature& feature, std::string_view value) {
    if (feature.kind == FeatureKind::count)
        return fmt::format("a whole number from 0 to {}", feature.values.back());
    return suggestion(value, feature.values);
}

/// A value that is not the default where there is one.
std::string example_of(const Feature& feature) {
    return feature.name + "=" + feature.values[std::min<std::size_t>(1, feature.values.size() - 1)];
}

}  // namespace

std::optional<int> Feature::index_of(std::string_view value) const {
    const auto found = std::find(values.begin(), values.end(), value);
    if (found == values.end()) return std::nullopt;
    return static_cast<int>(found - values.begin());
}

std::vector<int> Feature::listed() const {
    std::vector<int> order(values.size());
    std::iota(order.begin(), order.end(), 0);
    const auto last = order.begin() + std::min<std::ptrdiff_t>(default_place + 1, std::ssize(order));
    if (default_place > 0) std::rotate(order.begin(), order.begin() + 1, last);
    return order;
}

std::optional<int> Family::index_of(std::string_view feature) const {
    const auto found =
        std::find_if(features.begin(), features.end(), [&](const Feature& f) { return f.name == feature; });
    if (found == features.end()) return std::nullopt;
    return static_cast<int>(found - features.begin());
}

Key default_key(const Family& family) {
    return Key(family.features.size(), 0);
}

std::string key_text(const Family& family, const Key& key) {
    std::string text;
    for (std::size_t i = 0; i < key.size(); ++i) {
        if (key[i] == 0) continue;
        const Feature& feature = family.features[i];
        if (!text.empty()) text += ' ';
        text += feature.name + '=' + feature.values[static_cast<std::size_t>(key[i])];
    }
    return text.empty() ? "default" : text;
}

Result<Key> parse_key(const Family& family, std::string_view text, const Place& place) {
    Key key = default_key(family);
    std::vector<bool> named(key.size(), false);
    std::string blanks_folded(trim(text));
    std::replace_if(
        blanks_folded.begin(), blanks_folded.end(), [](char c) { return c == '\t' || c == '\r'; }, ' ');
    if (blanks_folded == "default") return key;
    for (const std::string& word : split(blanks_folded, ' ')) {
        const auto equals = word.find('=');
        if (equals == std::string::npos) {
            return key_error(
                place, text, fmt::format("'{}' is not of the form feature=value", word),
                fmt::format("write a key like '{}'",
                            family.features.empty() ? "default" : example_of(family.features[0])));
        }
        const std::string name = word.substr(0, equals);
        const std::string value = word.substr(equals + 1);
        const auto index = family.index_of(name);
        if (!index) {
            return key_error(place, text, fmt::format("family '{}' has no feature '{}'", family.name, name),
                             suggestion(name, feature_names(family)));
        }
        const Feature& feature = family.features[static_cast<std::size_t>(*index)];
        const auto found = feature.index_of(value);
        if (!found) {
            return key_error(place, text, fmt::format("feature '{}' has no value '{}'", name, value),
                             values_help(feature, value));
        }
        const auto at = static_cast<std::size_t>(*index);
        if (named[at]) {
            return key_error(place, text, fmt::format("feature '{}' is named twice", name),
                             "name each feature once");
        }
        named[at] = true;
        key[at] = *found;
    }
    return key;
}

bool applies_in(const Rule& rule, std::string_view dialect) {
    return rule.dialects.empty() ||
           std::find(rule.dialects.begin(), rule.dialects.end(), dialect) != rule.dialects.end();
}

Key canonical(const Family& family, Key key, std::string_view dialect) {
    bool changed = true;
    while (changed) {
        changed = false;
        for (const Rule& rule : family.rules) {
            if (rule.kind != Rule::Kind::defaults || !applies_in(rule, dialect) || !holds(rule.when, key))
                continue;
            for (const int feature : rule.defaults) {
                int& value = key[static_cast<std::size_t>(feature)];
                changed = changed || value != 0;
                value = 0;
            }
        }
    }
    return key;
}

const Rule* forbidding_rule(const Family& family, const Key& key, std::string_view dialect) {
    for (const Rule& rule : family.rules) {
        if (rule.kind == Rule::Kind::forbid && applies_in(rule, dialect) && holds(rule.when, key))
            return &rule;
    }
    return nullptr;
}

}  // namespace gobo
