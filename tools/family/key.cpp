#include "family/key.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/text.hpp"

namespace gobo {
std::optional<int> Feature::index_of(std::string_view value) const {
    const auto found = std::ranges::find(values, value);
    if (found == values.end()) return std::nullopt;
    return static_cast<int>(found - values.begin());
}

std::string Feature::help_for(std::string_view value) const {
    if (const auto now = old_values.find(std::string(value)); now != old_values.end())
        return fmt::format("'{}' is now '{}'", value, now->second);
    if (kind == FeatureKind::count) return fmt::format("a whole number from {} to {}", lowest, values.back());
    return suggestion(value, values);
}

std::optional<std::string> Feature::text_of(int index) const {
    const std::string& value = values[static_cast<std::size_t>(index)];
    if (const auto stated = texts.find(value); stated != texts.end()) return stated->second;
    if (kind != FeatureKind::define) return value;
    return index == 0 ? std::nullopt : std::optional<std::string>("1");
}

const Templates& Family::templates_of(const Key& key) const {
    const auto chosen = programs.size() > 1 ? index_of("program") : std::nullopt;
    return programs[chosen ? static_cast<std::size_t>(key[static_cast<std::size_t>(*chosen)]) : 0];
}

std::optional<int> index_of(const std::vector<Feature>& features, std::string_view name) {
    const auto found = std::ranges::find(features, name, &Feature::name);
    if (found == features.end()) return std::nullopt;
    return static_cast<int>(found - features.begin());
}

std::string help_for(const std::vector<Feature>& features, std::string_view name) {
    std::vector<std::string> names;
    for (const Feature& feature : features) {
        names.push_back(feature.name);
        if (std::ranges::count(feature.old_names, name) > 0)
            return fmt::format("'{}' is now '{}'", name, feature.name);
    }
    return suggestion(name, names);
}

Key default_key(const Family& family) {
    return Key(family.features.size(), 0);
}

std::string key_text(const Family& family, const Key& key) {
    std::vector<std::string> words;
    for (std::size_t i = 0; i < key.size(); ++i)
        if (key[i] != 0) words.push_back(family.features[i].name + '=' + family.features[i].values[key[i]]);
    return words.empty() ? "default" : join(words, " ");
}

Result<Key> parse_key(const Family& family, std::string_view text, const Place& place) {
    const auto refuse = [&](std::string message, std::string help) {
        return fail({.fault = Fault::usage,
                     .place = place,
                     .message = std::move(message),
                     .quoted_line = std::string(place.file.empty() ? "" : text),
                     .help = std::move(help)});
    };
    Key key = default_key(family);
    std::vector<bool> named(key.size(), false);
    std::string blanks_folded(trim(text));
    for (char& character : blanks_folded)
        if (character == '\t' || character == '\r') character = ' ';
    if (blanks_folded == "default") return key;
    for (const std::string& word : split(blanks_folded, ' ')) {
        const auto equals = word.find('=');
        if (equals == std::string::npos) {
            Key example = default_key(family);
            if (!key.empty() && family.features.front().values.size() > 1) example.front() = 1;
            return refuse(fmt::format("'{}' is not of the form feature=value", word),
                          fmt::format("write a key like '{}'", key_text(family, example)));
        }
        const std::string name = word.substr(0, equals), value = word.substr(equals + 1);
        const auto index = family.index_of(name);
        if (!index)
            return refuse(fmt::format("family '{}' has no feature '{}'", family.name, name),
                          help_for(family.features, name));
        const Feature& feature = family.features[*index];
        const auto found = feature.index_of(value);
        if (!found)
            return refuse(fmt::format("feature '{}' has no value '{}'", name, value),
                          feature.help_for(value));
        if (named[*index])
            return refuse(fmt::format("feature '{}' is named twice", name), "name each feature once");
        named[*index] = true;
        key[*index] = *found;
    }
    return key;
}

bool applies_in(const Rule& rule, std::string_view dialect) {
    return rule.dialects.empty() || std::ranges::count(rule.dialects, dialect) > 0;
}

Key canonical(const Family& family, Key key, std::string_view dialect) {
    for (bool changed = true; changed;) {
        changed = false;
        for (const Rule& rule : family.rules) {
            if (rule.kind != Rule::Kind::defaults || !applies_in(rule, dialect) || !holds(rule.when, key))
                continue;
            for (const int feature : rule.defaults) changed |= std::exchange(key[feature], 0) != 0;
        }
    }
    return key;
}

const Rule* forbidding_rule(const Family& family, const Key& key, std::string_view dialect) {
    for (const Rule& rule : family.rules)
        if (rule.kind == Rule::Kind::forbid && applies_in(rule, dialect) && holds(rule.when, key))
            return &rule;
    return nullptr;
}

namespace {

/// The text with a '#' for each number outside quotes: a cause that has another size in each key is one
/// cause.
std::string without_numbers(std::string_view text) {
    std::string result;
    bool is_quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        is_quoted = is_quoted != (text[i] == '\'');
        const bool is_digit = text[i] >= '0' && text[i] <= '9';
        const bool begins = i == 0 || !is_identifier_part(text[i - 1]);
        if (is_quoted || !is_digit || !begins) {
            result += text[i];
            continue;
        }
        while (i + 1 < text.size() && text[i + 1] >= '0' && text[i + 1] <= '9') ++i;
        result += '#';
    }
    return result;
}

}  // namespace

void DiagnosticGroups::add(const Diagnostic& diagnostic, const Key& key) {
    const auto identity =
        std::tuple(diagnostic.place.file, diagnostic.place.line, without_numbers(diagnostic.message));
    const auto [position, is_new] = positions_.try_emplace(identity, groups_.size());
    if (is_new) groups_.push_back({diagnostic, &key, nullptr, 0});
    Group& group = groups_[position->second];
    if (std::exchange(group.last, &key) != &key) ++group.keys;
}

Diagnostics DiagnosticGroups::result() const {
    Diagnostics diagnostics;
    for (const Group& group : groups_) {
        diagnostics.push_back(group.diagnostic);
        diagnostics.back().subject = key_text(family_, *group.first);
        diagnostics.back().more_keys = group.keys - 1;
    }
    return diagnostics;
}

}  // namespace gobo
