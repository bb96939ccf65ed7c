#include "family/expression.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/text.hpp"
#include "family/family.hpp"

namespace gobo {
namespace {

using Comparison = Expression::Comparison;

/// Parentheses and negations nested deeper than this are refused rather than followed into a stack overflow.
constexpr int deepest_nesting = 200;

/// Recursive descent over one condition. The first error is kept; parsing then runs to its end without
/// effect.
class Parser {
  public:
    Parser(std::string_view text, const std::vector<Feature>& features, Place place, Fault fault)
        : text_(text), features_(features), place_(std::move(place)), fault_(fault) {}

    Result<Expression> parse() {
        Expression expression = disjunction();
        skip_blanks();
        if (at_ < text_.size())
            error(fmt::format("unexpected '{}'", text_.substr(at_, 1)), "join conditions by && or ||");
        if (error_) return fail(*error_);
        return expression;
    }

  private:
    Expression disjunction() { return chain("||", Expression::Kind::disjunction, &Parser::conjunction); }
    Expression conjunction() { return chain("&&", Expression::Kind::conjunction, &Parser::negation); }

    Expression chain(std::string_view symbol, Expression::Kind kind, Expression (Parser::*part)()) {
        Expression first = (this->*part)();
        if (!accepts(symbol)) return first;
        Expression whole;
        whole.kind = kind;
        whole.parts.push_back(std::make_shared<const Expression>(std::move(first)));
        do {
            whole.parts.push_back(std::make_shared<const Expression>((this->*part)()));
        } while (accepts(symbol));
        return whole;
    }

    Expression negation() {
        if (error_) return {};
        if (++depth_ > deepest_nesting) error("the condition is nested too deeply", "simplify it");
        Expression expression;
        if (!error_ && accepts("!")) {
            expression.kind = Expression::Kind::negation;
            expression.parts.push_back(std::make_shared<const Expression>(negation()));
        } else if (!error_ && accepts("(")) {
            expression = disjunction();
            if (!accepts(")")) error("missing ')'", "close the parenthesis");
        } else if (!error_) {
            expression = compare();
        }
        --depth_;
        return expression;
    }

    Expression compare() {
        Expression expression;
        expression.kind = Expression::Kind::compare;
        expression.features = sum();
        expression.comparison = comparison();
        if (!error_) check_kinds(expression);
        if (!error_ && is_count(expression.features.front()) && next_is_count()) {
            return compare_sums(expression, sum());
        }
        if (!error_) expression.value = value(expression);
        return expression;
    }

    /// Features joined by "+".
    std::vector<int> sum() {
        std::vector<int> features;
        do {
            features.push_back(feature());
        } while (!error_ && accepts("+"));
        return features;
    }

    [[nodiscard]] bool is_count(int feature) const {
        return features_[static_cast<std::size_t>(feature)].kind == FeatureKind::count;
    }

    /// Whether a count's name follows, which is left to be read.
    bool next_is_count() {
        skip_blanks();
        std::size_t end = at_;
        while (end < text_.size() && is_identifier_part(text_[end])) ++end;
        const std::string_view name = text_.substr(at_, end - at_);
        return std::any_of(features_.begin(), features_.end(),
                           [&](const Feature& f) { return f.kind == FeatureKind::count && f.name == name; });
    }

    /// `left op right` as what it is for each value of the right sum: right == v && left op v, for some v.
    Expression compare_sums(Expression left, std::vector<int> right) {
        Expression equals;
        equals.kind = Expression::Kind::compare;
        equals.features = std::move(right);
        if (!error_) check_kinds(equals);
        Expression any;
        any.kind = Expression::Kind::disjunction;
        int largest = 0;
        for (const int index : equals.features)
            largest += static_cast<int>(features_[static_cast<std::size_t>(index)].values.size()) - 1;
        for (int value = 0; value <= largest; ++value) {
            equals.value = left.value = value;
            Expression both;
            both.kind = Expression::Kind::conjunction;
            both.parts = {std::make_shared<const Expression>(equals),
                          std::make_shared<const Expression>(left)};
            any.parts.push_back(std::make_shared<const Expression>(std::move(both)));
        }
        return any;
    }

    int feature() {
        const std::string name(word("a feature's name"));
        if (error_) return 0;
        const auto found = std::find_if(features_.begin(), features_.end(),
                                        [&](const Feature& f) { return f.name == name; });
        if (found != features_.end()) return static_cast<int>(found - features_.begin());
        std::vector<std::string> names;
        for (const Feature& known : features_) names.push_back(known.name);
        error(fmt::format("unknown feature '{}'", name), suggestion(name, names), at_ - name.size());
        return 0;
    }

    Comparison comparison() {
        constexpr std::pair<std::string_view, Comparison> symbols[] = {
            {"==", Comparison::equal},         {"!=", Comparison::not_equal}, {"<=", Comparison::less_equal},
            {">=", Comparison::greater_equal}, {"<", Comparison::less},       {">", Comparison::greater}};
        for (const auto& [symbol, meaning] : symbols) {
            if (accepts(symbol)) return meaning;
        }
        error("expected a comparison", "one of == != < <= > >=");
        return Comparison::equal;
    }

    void check_kinds(const Expression& expression) {
        const bool equality =
            expression.comparison == Comparison::equal || expression.comparison == Comparison::not_equal;
        for (const int index : expression.features) {
            const Feature& feature = features_[static_cast<std::size_t>(index)];
            if (feature.kind == FeatureKind::count) continue;
            if (expression.features.size() > 1) {
                error(fmt::format("'{}' is no count and cannot be added", feature.name), "add counts only");
            } else if (!equality) {
                error(fmt::format("'{}' is no count and has no order", feature.name),
                      "compare it by == or !=");
            }
        }
    }

    int value(const Expression& expression) {
        const Feature& feature = features_[static_cast<std::size_t>(expression.features.front())];
        const std::string text(word("a value"));
        if (error_) return 0;
        if (feature.kind != FeatureKind::count) {
            if (const auto index = feature.index_of(text)) return *index;
            error(fmt::format("feature '{}' has no value '{}'", feature.name, text),
                  suggestion(text, feature.values), at_ - text.size());
            return 0;
        }
        int number = 0;
        const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (failure == std::errc{} && end == text.data() + text.size()) return number;
        error(fmt::format("'{}' is no whole number", text), "counts compare with whole numbers",
              at_ - text.size());
        return 0;
    }

    std::string_view word(std::string_view what) {
        skip_blanks();
        const std::size_t start = at_;
        while (at_ < text_.size() && is_identifier_part(text_[at_])) ++at_;
        if (at_ == start)
            error(fmt::format("expected {}", what), "a condition reads like 'fog == linear && point <= 2'");
        return text_.substr(start, at_ - start);
    }

    bool accepts(std::string_view symbol) {
        skip_blanks();
        const bool found =
            text_.substr(at_).starts_with(symbol) && !(symbol == "!" && text_.substr(at_).starts_with("!="));
        if (found) at_ += symbol.size();
        return found;
    }

    void skip_blanks() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n')) ++at_;
    }

    void error(std::string message, std::string help, std::size_t at = std::string_view::npos) {
        if (error_) return;
        Diagnostic diagnostic;
        diagnostic.fault = fault_;
        diagnostic.place = place_;
        const std::size_t offset = std::min(at == std::string_view::npos ? at_ : at, text_.size());
        if (place_.column > 0) diagnostic.place.column += static_cast<int>(offset);
        diagnostic.message = fmt::format("{} in the condition '{}'", message, text_);
        diagnostic.help = std::move(help);
        error_ = std::move(diagnostic);
    }

    std::string_view text_;
    const std::vector<Feature>& features_;
    Place place_;
    Fault fault_;
    std::size_t at_ = 0;
    int depth_ = 0;
    std::optional<Diagnostic> error_;
};

}  // namespace

bool compare(int left, Expression::Comparison comparison, int right) {
    switch (comparison) {
        case Comparison::equal:
            return left == right;
        case Comparison::not_equal:
            return left != right;
        case Comparison::less:
            return left < right;
        case Comparison::less_equal:
            return left <= right;
        case Comparison::greater:
            return left > right;
        case Comparison::greater_equal:
            return left >= right;
    }
    return false;
}

Result<Expression> parse_expression(std::string_view text, const std::vector<Feature>& features,
                                    const Place& place, Fault fault) {
    return Parser(text, features, place, fault).parse();
}

bool holds(const Expression& expression, const std::vector<int>& key) {
    const auto part_holds = [&](const auto& part) { return holds(*part, key); };
    switch (expression.kind) {
        case Expression::Kind::constant:
            return expression.constant;
        case Expression::Kind::compare: {
            int sum = 0;
            for (const int feature : expression.features) sum += key[static_cast<std::size_t>(feature)];
            return compare(sum, expression.comparison, expression.value);
        }
        case Expression::Kind::conjunction:
            return std::all_of(expression.parts.begin(), expression.parts.end(), part_holds);
        case Expression::Kind::disjunction:
            return std::any_of(expression.parts.begin(), expression.parts.end(), part_holds);
        case Expression::Kind::negation:
            return !holds(*expression.parts.front(), key);
    }
    return false;
}

}  // namespace gobo
