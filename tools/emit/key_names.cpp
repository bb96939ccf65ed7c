#include "emit/key_names.hpp"

#include <bit>

#include <fmt/format.h>

namespace gobo {
namespace {

constexpr int word_bits = 64;

/// The bits that tell `count` values apart.
int bits_for(std::size_t count) {
    return count < 2 ? 0 : static_cast<int>(std::bit_width(count - 1));
}

std::string type_of(const Feature& feature, CppScope& scope) {
    if (feature.kind == FeatureKind::count) return "int";
    if (feature.kind == FeatureKind::define) return "bool";
    const std::string name = feature.enum_name.empty() ? feature.name : feature.enum_name;
    return scope.claim(cpp_type_name(name));
}

std::vector<std::string> name_values(const Feature& feature) {
    std::vector<std::string> names;
    if (feature.kind != FeatureKind::choice) return names;
    CppScope scope;
    for (const std::string& value : feature.values) names.push_back(scope.claim(cpp_identifier(value)));
    return names;
}

/// No feature straddles two words, so that each is read with one shift.
void place(CppFeature& feature, int bits, int& word, int& used) {
    if (used + bits > word_bits) {
        ++word;
        used = 0;
    }
    feature.word = word;
    feature.shift = used;
    feature.bits = bits;
    used += bits;
}

std::string_view cpp_operator(Expression::Comparison comparison) {
    switch (comparison) {
        case Expression::Comparison::equal:
            return "==";
        case Expression::Comparison::not_equal:
            return "!=";
        case Expression::Comparison::less:
            return "<";
        case Expression::Comparison::less_equal:
            return "<=";
        case Expression::Comparison::greater:
            return ">";
        case Expression::Comparison::greater_equal:
            return ">=";
    }
    return "==";
}

std::string cpp_comparison(const Expression& condition, const Family& family, const CppKey& key) {
    std::string sum;
    for (const int feature : condition.features) {
        if (!sum.empty()) sum += " + ";
        sum += "key." + key.features[static_cast<std::size_t>(feature)].member;
    }
    const auto first = static_cast<std::size_t>(condition.features.front());
    const std::string value = cpp_value(key.features[first], family.features[first].kind, condition.value);
    return fmt::format("{} {} {}", sum, cpp_operator(condition.comparison), value);
}

std::string cpp_list(const Expression& condition, const Family& family, const CppKey& key) {
    const bool all = condition.kind == Expression::Kind::conjunction;
    std::string text;
    for (const auto& part : condition.parts) {
        if (!text.empty()) text += all ? " && " : " || ";
        const bool is_list =
            part->kind == Expression::Kind::conjunction || part->kind == Expression::Kind::disjunction;
        const std::string inner = cpp_condition(*part, family, key);
        text += is_list ? "(" + inner + ")" : inner;
    }
    return text;
}

}  // namespace

CppKey name_key(const Family& family, CppScope& scope) {
    CppKey key;
    CppScope members({"Key"});
    for (const Feature& feature : family.features) {
        CppFeature named;
        named.member = members.claim(cpp_identifier(feature.name));
        // A member may not have the name of a type that Key uses.
        scope.claim(named.member);
        key.features.push_back(std::move(named));
    }
    int word = 0;
    int used = 0;
    for (std::size_t index = 0; index < key.features.size(); ++index) {
        const Feature& feature = family.features[index];
        CppFeature& named = key.features[index];
        named.type = type_of(feature, scope);
        named.enumerators = name_values(feature);
        place(named, bits_for(feature.values.size()), word, used);
    }
    key.words = word + 1;
    return key;
}

std::string cpp_value(const CppFeature& feature, FeatureKind kind, int value) {
    if (kind == FeatureKind::count) return std::to_string(value);
    if (kind == FeatureKind::define) return value == 0 ? "false" : "true";
    return feature.type + "::" + feature.enumerators[static_cast<std::size_t>(value)];
}

std::string cpp_condition(const Expression& condition, const Family& family, const CppKey& key) {
    switch (condition.kind) {
        case Expression::Kind::constant:
            return condition.constant ? "true" : "false";
        case Expression::Kind::compare:
            return cpp_comparison(condition, family, key);
        case Expression::Kind::negation:
            return "!(" + cpp_condition(*condition.parts.front(), family, key) + ")";
        case Expression::Kind::conjunction:
        case Expression::Kind::disjunction:
            return cpp_list(condition, family, key);
    }
    return "true";
}

}  // namespace gobo
