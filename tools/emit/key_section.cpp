#include "emit/key_section.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "emit/cpp_text.hpp"

namespace gobo {
namespace {

std::string_view role_text(const Feature& feature) {
    switch (feature.role) {
        case Role::effect:
            return "effect";
        case Role::quality:
            return feature.default_place == 0 ? "quality, most accurate first"
                                              : "quality, most accurate first behind the default";
        case Role::pipeline:
            return "pipeline";
    }
    return "";
}

std::string enum_text(const Feature& feature, const CppFeature& named) {
    // A quarter thousand values fit in a byte; nobody has more, but an enum must not depend on that.
    const std::string_view type = feature.values.size() < 256 ? "std::uint8_t" : "std::uint16_t";
    return fmt::format("/// {} ({}).\nenum class {} : {} {{ {} }};\n\n", feature.name, role_text(feature),
                       named.type, type, fmt::join(named.enumerators, ", "));
}

std::string member_text(const Feature& feature, const CppFeature& named) {
    std::string comment;
    if (feature.kind == FeatureKind::count)
        comment = fmt::format("  ///< 0 to {}", feature.values.size() - 1);
    return fmt::format("    {} {} = {};{}\n", named.type, named.member, cpp_value(named, feature.kind, 0),
                       comment);
}

std::string range_text(const Feature& feature, const CppFeature& named) {
    const std::size_t count = feature.values.size();
    if (feature.kind == FeatureKind::define) return {};
    if (feature.kind == FeatureKind::choice) {
        return fmt::format("static_cast<unsigned>(key.{}) < {}U", named.member, count);
    }
    return fmt::format("key.{0} >= 0 && key.{0} <= {1}", named.member, count - 1);
}

std::string packed_text(const CppKey& key) {
    std::vector<std::string> words(static_cast<std::size_t>(key.words), "0");
    for (const CppFeature& feature : key.features) {
        if (feature.bits == 0) continue;
        std::string& word = words[static_cast<std::size_t>(feature.word)];
        if (feature.shift == 0) word.clear();
        if (!word.empty()) word += " |\n           ";
        word += fmt::format("static_cast<std::uint64_t>(key.{}) << {}U", feature.member, feature.shift);
    }
    if (words.size() == 1) return words.front();
    return fmt::format("{{{{{}}}}}", fmt::join(words, ",\n           "));
}

std::string unpacked_text(const CppKey& key) {
    std::string text;
    for (const CppFeature& feature : key.features) {
        if (feature.bits == 0) continue;
        const std::string word = key.words == 1 ? "bits" : fmt::format("bits.words[{}]", feature.word);
        text += fmt::format("    key.{} = static_cast<{}>({} >> {}U & {}U);\n", feature.member, feature.type,
                            word, feature.shift, (std::uint64_t{1} << feature.bits) - 1);
    }
    return text;
}

void collect_features(const Expression& condition, std::set<int>& features) {
    features.insert(condition.features.begin(), condition.features.end());
    for (const auto& part : condition.parts) collect_features(*part, features);
}

/// Whether a rule changes what an earlier one, or it itself, looks at: one pass may then not be enough.
bool need_repetition(const std::vector<Rule>& rules) {
    std::set<int> looked_at;
    for (const Rule& rule : rules) {
        if (rule.kind != Rule::Kind::defaults) continue;
        collect_features(rule.when, looked_at);
        const auto is_looked_at = [&looked_at](int feature) { return looked_at.contains(feature); };
        if (std::any_of(rule.defaults.begin(), rule.defaults.end(), is_looked_at)) return true;
    }
    return false;
}

std::string default_rules_text(const Family& family, const std::vector<Rule>& rules, const CppKey& key) {
    const bool repeated = need_repetition(rules);
    const std::string indent(repeated ? 8 : 4, ' ');
    std::string text;
    for (const Rule& rule : rules) {
        if (rule.kind != Rule::Kind::defaults) continue;
        text += fmt::format("{}if ({}) {{\n", indent, cpp_condition(rule.when, family, key));
        for (const int index : rule.defaults) {
            const auto feature = static_cast<std::size_t>(index);
            text += fmt::format("{}    key.{} = {};\n", indent, key.features[feature].member,
                                cpp_value(key.features[feature], family.features[feature].kind, 0));
        }
        text += fmt::format("{}}}\n", indent);
    }
    if (!repeated) return text;
    return fmt::format(
        "    for (bool changed = true; changed;) {{\n        const Key before = key;\n{}"
        "        changed = key != before;\n    }}\n",
        text);
}

std::string forbid_rules_text(const Family& family, const std::vector<Rule>& rules, const CppKey& key) {
    std::string text;
    for (const Rule& rule : rules) {
        if (rule.kind != Rule::Kind::forbid) continue;
        text += fmt::format("    if ({}) return {};\n", cpp_condition(rule.when, family, key),
                            cpp_literal(rule.reason));
    }
    return text;
}

std::string feature_row(const Feature& feature, std::size_t first_name) {
    constexpr std::string_view kinds[] = {"choice", "count", "define"};
    return fmt::format("{{{}, gobo::runtime::FeatureKind::{}, {}, {}}}", cpp_literal(feature.name),
                       kinds[static_cast<std::size_t>(feature.kind)], feature.values.size(), first_name);
}

void describe_tables(const Family& family, TemplateValues& values) {
    std::vector<std::string> rows;
    std::vector<std::string> names;
    for (const Feature& feature : family.features) {
        rows.push_back(feature_row(feature, names.size()));
        if (feature.kind == FeatureKind::count) continue;
        for (const std::string& value : feature.values) names.push_back(cpp_literal(value));
    }
    values["feature_count"] = std::to_string(rows.size());
    values["features"] = cpp_list(rows);
    values["value_name_count"] = std::to_string(names.size());
    values["value_names"] = cpp_list(names);
}

}  // namespace

void describe_key(const Family& family, const std::vector<Rule>& rules, const CppKey& key,
                  TemplateValues& values) {
    std::string& enums = values["enums"];
    std::string& members = values["key_members"];
    std::vector<std::string> equal;
    std::vector<std::string> ranges;
    std::vector<std::string> numbers;
    for (std::size_t index = 0; index < key.features.size(); ++index) {
        const Feature& feature = family.features[index];
        const CppFeature& named = key.features[index];
        if (feature.kind == FeatureKind::choice) enums += enum_text(feature, named);
        members += member_text(feature, named);
        equal.push_back(fmt::format("left.{0} == right.{0}", named.member));
        if (std::string range = range_text(feature, named); !range.empty())
            ranges.push_back(std::move(range));
        numbers.push_back(fmt::format("static_cast<int>(key.{})", named.member));
    }
    const auto all_of = [](const std::vector<std::string>& parts, std::string_view separator) {
        return parts.empty() ? "true" : fmt::format("{}", fmt::join(parts, separator));
    };
    values["key_equality"] = all_of(equal, " &&\n               ");
    values["in_range"] = all_of(ranges, " &&\n           ");
    values["values"] = cpp_list(numbers);
    values["packed_type"] =
        key.words == 1 ? "std::uint64_t" : fmt::format("gobo::runtime::WideKey<{}>", key.words);
    values["packed"] = packed_text(key);
    values["unpacked"] = unpacked_text(key);
    values["default_rules"] = default_rules_text(family, rules, key);
    values["forbid_rules"] = forbid_rules_text(family, rules, key);
    describe_tables(family, values);
}

}  // namespace gobo
