// Constant expressions, by how tightly their operators bind.
#include <algorithm>
#include <array>
#include <map>

#include "lab/sanitize/constant_reader.hpp"

namespace gobo::sanitize {
namespace {

/// How tightly a binary operator binds; 0 for what is none.
int precedence_of(std::string_view text) {
    static const std::map<std::string_view, int> kPrecedences = {
        {"*", 11}, {"/", 11}, {"%", 11}, {"+", 10}, {"-", 10}, {"<<", 9}, {">>", 9},
        {"<", 8},  {">", 8},  {"<=", 8}, {">=", 8}, {"==", 7}, {"!=", 7}, {"&", 6},
        {"^", 5},  {"|", 4},  {"&&", 3}, {"^^", 2}, {"||", 1}};
    const auto found = kPrecedences.find(text);
    return found == kPrecedences.end() ? 0 : found->second;
}

bool is_assignment(std::string_view text) {
    constexpr std::array<std::string_view, 11> kAssignments = {
        "=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>="};
    return std::ranges::find(kAssignments, text) != kAssignments.end();
}

}  // namespace

Constant ConstantReader::expression() {
    Constant value = assignment();
    while (take(",")) value = assignment();
    return value;
}

Constant ConstantReader::assignment() {
    Constant value = choice();
    if (!is_assignment(peek().text)) return value;
    ++at_;
    assignment();
    return std::nullopt;
}

Constant ConstantReader::choice() {
    const Constant condition = binary(1);
    if (!take("?")) return condition;
    const std::optional<bool> holds = truth_of(condition);
    Constant first = muted_unless(holds != false, [&] { return expression(); });
    take(":");
    Constant second = muted_unless(holds != true, [&] { return assignment(); });
    if (!holds) return std::nullopt;
    return *holds ? first : second;
}

template <class Read>
Constant ConstantReader::muted_unless(bool is_live, const Read& read) {
    muted_ += is_live ? 0 : 1;
    Constant value = read();
    muted_ -= is_live ? 0 : 1;
    return value;
}

Constant ConstantReader::binary(int least) {
    Constant left = unary();
    while (true) {
        const Token operation = peek();
        const int precedence = precedence_of(operation.text);
        if (precedence < least || precedence == 0) return left;
        ++at_;
        const std::optional<bool> known = truth_of(left);
        const bool is_decided =
            (operation.text == "&&" && known == false) || (operation.text == "||" && known == true);
        const Constant right = muted_unless(!is_decided, [&] { return binary(precedence + 1); });
        line_ = operation.line;
        if (!is_decided) left = folded_binary(operation.text, left, right, reporter());
    }
}

Constant ConstantReader::unary() {
    for (const std::string_view operation : {"-", "+", "!", "~"})
        if (take(operation)) return folded_unary(operation, unary());
    if (take("++") || take("--")) {
        unary();
        return std::nullopt;
    }
    return postfix(primary());
}

Constant ConstantReader::postfix(Constant value) {
    while (true) {
        if (take("++") || take("--")) {
            value = std::nullopt;
        } else if (take("[")) {
            const Constant index = expression();
            take("]");
            value = element_of(value, index);
        } else if (take(".")) {
            const std::string_view member = peek().text;
            ++at_;
            if (sees("(")) {  // .length()
                skip_brackets();
                value = std::nullopt;
            } else if (value && value->elements == ConstantValue::kStructure) {
                value = member_of(*value, member);
            } else {
                value = components_of(value, member);
            }
        } else {
            return value;
        }
    }
}

Constant ConstantReader::primary() {
    const Token token = peek();
    if (token.text.empty() || std::string_view(";)],}:").find(token.text.front()) != std::string_view::npos)
        return std::nullopt;
    ++at_;
    if (token.text == "(") {
        Constant value = expression();
        take(")");
        return value;
    }
    if (token.text == "{") {
        const std::vector<Constant> elements = arguments("}");
        return array_of(elements);
    }
    if (is_number(token.text)) return literal(token.text);
    if (token.text == "true" || token.text == "false")
        return ConstantValue{{Scalar::boolean, 1, 1}, 0, {token.text == "true" ? 1.0 : 0.0}};
    if (!token.is_name()) return std::nullopt;
    const std::optional<GlslType> type = glsl_type(token.text);
    if (type && sees("[")) {
        skip_brackets();
        return take("(") ? array_of(arguments(")")) : std::nullopt;
    }
    if (take("(")) return call(token, type);
    const Constant* const known = find(token.text);
    return known != nullptr ? *known : std::nullopt;
}

Constant ConstantReader::call(const Token& name, const std::optional<GlslType>& type) {
    const std::vector<Constant> given = arguments(")");
    line_ = name.line;
    if (type) return constructed(*type, given, reporter());
    if (structures_.contains(name.text)) return structure_of(name.text, given);
    calls_[function_].insert(name.text);
    if (functions_.contains(name.text)) return std::nullopt;
    return folded_call(name.text, given, reporter());
}

std::vector<Constant> ConstantReader::arguments(std::string_view close) {
    std::vector<Constant> all;
    while (!at_end() && !sees(close)) {
        const std::size_t before = at_;
        all.push_back(assignment());
        if (!take(",") && !sees(close) && at_ == before) ++at_;
    }
    take(close);
    return all;
}

}  // namespace gobo::sanitize
