#include <algorithm>
#include <array>
#include <bit>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/text.hpp"
#include "emit/sections.hpp"

namespace gobo {
namespace {

constexpr int kWordBits = 64;

/// The C++ of a condition over a key named `key`.
std::string cpp_condition(const Expression& condition, const CppKey& key) {
    using Kind = Expression::Kind;
    const auto sum = [&](const std::vector<int>& features) {
        std::vector<std::string> terms;
        for (const int feature : features) terms.push_back("key." + key[feature].member);
        return join(terms, " + ");
    };
    const auto value = [&] {
        const std::vector<int>& features = condition.features;
        int number = condition.value;  // less than what the family says by where the counts begin
        for (std::size_t i = 1; i < features.size(); ++i) number += key[features[i]].feature->lowest;
        return key[features.front()].value(number);
    };
    if (condition.kind == Kind::compare)
        return fmt::format("{} {} {}", sum(condition.features),
                           kComparisonSymbols[static_cast<std::size_t>(condition.comparison)],
                           condition.subtracted.empty() ? value() : sum(condition.subtracted));
    std::vector<std::string> parts;
    for (const Expression& part : condition.parts) {
        const std::string text = cpp_condition(part, key);
        parts.push_back(part.kind == Kind::compare ? text : "(" + text + ")");
    }
    return join(parts, condition.kind == Kind::conjunction ? " && " : " || ");
}

std::string enum_text(const CppFeature& named) {
    const Feature& feature = *named.feature;
    std::string_view order;
    if (feature.role == Role::quality)
        order =
            feature.default_place == 0 ? ", most accurate first" : ", most accurate first behind the default";
    // A quarter thousand values fit in a byte; nobody has more, but an enum must not depend on that.
    const std::string_view type = feature.values.size() < 256 ? "std::uint8_t" : "std::uint16_t";
    return fmt::format("/// {} ({}{}).\nenum class {} : {} {{ {} }};\n\n", cpp_comment(feature.name),
                       name_of(feature.role), order, named.type, type, fmt::join(named.enumerators, ", "));
}

/// The number of the value that a key holds: of a count, by how much it is above its least.
std::string index_text(const CppFeature& named) {
    const int lowest = named.feature->lowest;
    return fmt::format("key.{}{}", named.member, lowest == 0 ? "" : fmt::format(" - {}", lowest));
}

std::string packed_text(const CppKey& key) {
    std::vector<std::string> words(static_cast<std::size_t>(key.words), "0");
    for (const CppFeature& feature : key.features) {
        if (feature.bits == 0) continue;
        std::string& word = words[static_cast<std::size_t>(feature.word)];
        const std::string shifted =
            fmt::format("static_cast<std::uint64_t>({}) << {}U", index_text(feature), feature.shift);
        word = feature.shift == 0 ? shifted : word + " |\n           " + shifted;
    }
    if (words.size() == 1) return words.front();
    return fmt::format("{{{{{}}}}}", fmt::join(words, ",\n           "));
}

/// Whether a rule changes what an earlier one, or it itself, looks at: one pass may then not be enough.
bool need_repetition(const std::vector<Rule>& rules) {
    std::set<int> looked_at;
    const auto look = [&](const auto& self, const Expression& condition) -> void {
        looked_at.insert(condition.features.begin(), condition.features.end());
        looked_at.insert(condition.subtracted.begin(), condition.subtracted.end());
        for (const Expression& part : condition.parts) self(self, part);
    };
    return std::ranges::any_of(rules, [&](const Rule& rule) {
        if (rule.kind != Rule::Kind::defaults) return false;
        look(look, rule.when);
        return std::ranges::any_of(rule.defaults, [&](int feature) { return looked_at.contains(feature); });
    });
}

std::string default_rules_text(const std::vector<Rule>& rules, const CppKey& key) {
    const bool repeated = need_repetition(rules);
    const std::string indent(repeated ? 8 : 4, ' ');
    std::string text;
    for (const Rule& rule : rules) {
        if (rule.kind != Rule::Kind::defaults) continue;
        text += fmt::format("{}if ({}) {{\n", indent, cpp_condition(rule.when, key));
        for (const int feature : rule.defaults)
            text += fmt::format("{}    key.{} = {};\n", indent, key[feature].member, key[feature].value(0));
        text += fmt::format("{}}}\n", indent);
    }
    if (!repeated) return text;
    return fmt::format(
        "    for (bool changed = true; changed;) {{\n        const Key before = key;\n{}"
        "        changed = key != before;\n    }}\n",
        text);
}

}  // namespace

std::string_view name_of(Role role) {
    return std::array{"effect", "quality", "pipeline"}[static_cast<std::size_t>(role)];
}

std::string_view name_of(FeatureKind kind) {
    return std::array{"choice", "count", "define"}[static_cast<std::size_t>(kind)];
}

std::string CppFeature::value(int number) const {
    if (feature->kind == FeatureKind::count) return std::to_string(feature->lowest + number);
    if (feature->kind == FeatureKind::define) return number == 0 ? "false" : "true";
    return type + "::" + enumerators[static_cast<std::size_t>(number)];
}

CppKey name_key(const Family& family, CppScope& scope) {
    CppKey key;
    CppScope members({"Key"});
    for (const Feature& feature : family.features) {
        key.features.push_back({&feature, members.claim(cpp_identifier(feature.name)), {}, {}});
        // A member may not have the name of a type that Key uses.
        scope.claim(key.features.back().member);
    }
    int used = 0;
    for (CppFeature& named : key.features) {
        const Feature& feature = *named.feature;
        named.type = feature.kind == FeatureKind::count ? "int" : "bool";
        if (feature.kind == FeatureKind::choice) {
            const std::string& name = feature.enum_name.empty() ? feature.name : feature.enum_name;
            named.type = scope.claim(cpp_type_name(name));
            CppScope enumerators;
            for (const std::string& value : feature.values)
                named.enumerators.push_back(enumerators.claim(cpp_identifier(value)));
        }
        const std::size_t count = feature.values.size();
        named.bits = count < 2 ? 0 : static_cast<int>(std::bit_width(count - 1));
        // No feature straddles two words, so that each is read with one shift.
        if (used + named.bits > kWordBits) {
            ++key.words;
            used = 0;
        }
        named.word = key.words - 1;
        named.shift = used;
        used += named.bits;
    }
    return key;
}

Result<void> key_section(const std::vector<Rule>& rules, const CppKey& key, const HeaderTemplates& templates,
                         TemplateValues& values) {
    for (const char* part : {"enums", "key_members", "unpacked", "forbid_rules", "state_members",
                             "state_takers", "state_taken", "state_takes_any"})
        values[part].clear();
    std::vector<std::string> equal;
    std::vector<std::string> ranges;
    std::vector<std::string> numbers;
    std::vector<std::string> rows;
    std::vector<std::string> names;
    for (const CppFeature& named : key.features) {
        const Feature& feature = *named.feature;
        const std::size_t count = feature.values.size();
        const bool is_count = feature.kind == FeatureKind::count;
        const std::string& member = named.member;
        const std::string declaration = fmt::format("    {} {} = {};", named.type, member, named.value(0));
        const std::string least = named.value(0);
        const std::string most = is_count ? feature.values.back() : "";
        values["key_members"] +=
            declaration + (is_count ? fmt::format("  ///< {} to {}\n", least, most) : "\n");
        equal.push_back(fmt::format("left.{0} == right.{0}", member));
        numbers.push_back(fmt::format("static_cast<int>({})", index_text(named)));
        if (is_count) ranges.push_back(fmt::format("key.{0} >= {1} && key.{0} <= {2}", member, least, most));
        if (feature.kind == FeatureKind::choice) {
            values["enums"] += enum_text(named);
            ranges.push_back(fmt::format("static_cast<unsigned>(key.{}) < {}U", member, count));
        }
        rows.push_back(fmt::format("{{{}, gobo::runtime::FeatureKind::{}, {}, {}{}}}",
                                   cpp_literal(feature.name), name_of(feature.kind), count, names.size(),
                                   feature.lowest == 0 ? "" : fmt::format(", {}", feature.lowest)));
        if (!is_count) std::ranges::transform(feature.values, std::back_inserter(names), cpp_literal);
        if (named.bits > 0)
            values["unpacked"] +=
                fmt::format("    key.{} = static_cast<{}>({} >> {}U & {}U){};\n", member, named.type,
                            key.words == 1 ? "bits" : fmt::format("bits.words[{}]", named.word), named.shift,
                            (std::uint64_t{1} << named.bits) - 1,
                            feature.lowest == 0 ? "" : fmt::format(" + {}", feature.lowest));
        if (feature.role == Role::effect) values["state_members"] += declaration + "\n";
        // A state that has no member of the feature's name leaves its value alone.
        GOBO_TRY(const std::string taker,
                 fill(templates.at("taker"), {{"member", member}, {"type", named.type}}));
        values["state_takers"] += taker;
        values["state_taken"] += fmt::format("    take_{}(state, key, 0);\n", member);
        values["state_takes_any"] += fmt::format(" || decltype(take_{}(state, key, 0))::value", member);
    }
    values["key_equality"] = equal.empty() ? "true" : join(equal, " &&\n               ");
    values["in_range"] = ranges.empty() ? "true" : join(ranges, " &&\n           ");
    values["values"] = cpp_list(numbers);
    values["packed_type"] =
        key.words == 1 ? "std::uint64_t" : fmt::format("gobo::runtime::WideKey<{}>", key.words);
    values["packed"] = packed_text(key);
    values["default_rules"] = default_rules_text(rules, key);
    for (const Rule& rule : rules)
        if (rule.kind == Rule::Kind::forbid)
            values["forbid_rules"] += fmt::format("    if ({}) return {};\n", cpp_condition(rule.when, key),
                                                  cpp_literal(rule.reason));
    add_table(values, "feature", rows);
    add_table(values, "value_name", names);
    return {};
}

}  // namespace gobo
