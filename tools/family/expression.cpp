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
        if (!error_) check_kinds(expression.features, expression.comparison);
        if (!error_ && features_[expression.features.front()].kind == FeatureKind::count && next_is_count()) {
            expression.subtracted = sum();
            if (!error_) check_kinds(expression.subtracted, expression.comparison);
        } else if (!error_) {
            expression.value = value(features_[expression.features.front()]);
        }
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

    /// Whether a count's name follows, which is left to be read.
    bool next_is_count() {
        skip_blanks();
        const auto index = index_of(features_, identifier());
        return index && features_[*index].kind == FeatureKind::count;
    }

    /// What follows, up to the next character that no name has.
    [[nodiscard]] std::string_view identifier() const {
        const std::string_view rest = text_.substr(at_);
        const auto end = std::find_if_not(rest.begin(), rest.end(), is_identifier_part);
        return rest.substr(0, static_cast<std::size_t>(end - rest.begin()));
    }

    int feature() {
        const std::string name(word("a feature's name"));
        if (error_) return 0;
        if (const auto index = index_of(features_, name)) return *index;
        error(fmt::format("unknown feature '{}'", name), help_for(features_, name), at_ - name.size());
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

    void check_kinds(const std::vector<int>& summands, Comparison comparison) {
        const bool equality = comparison == Comparison::equal || comparison == Comparison::not_equal;
        for (const int index : summands) {
            const Feature& feature = features_[index];
            if (feature.kind == FeatureKind::count) continue;
            if (summands.size() > 1) {
                error(fmt::format("'{}' is not a count and cannot be added", feature.name),
                      "add counts only");
            } else if (!equality) {
                error(fmt::format("'{}' is not a count and has no order", feature.name),
                      "compare it by == or !=");
            }
        }
    }

    int value(const Feature& feature) {
        const std::string text(word("a value"));
        if (error_) return 0;
        if (feature.kind != FeatureKind::count) {
            if (const auto index = feature.index_of(text)) return *index;
            error(fmt::format("feature '{}' has no value '{}'", feature.name, text), feature.help_for(text),
                  at_ - text.size());
            return 0;
        }
        int number = 0;
        const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (failure == std::errc{} && end == text.data() + text.size()) return number;
        error(fmt::format("'{}' is not a whole number", text), "counts compare with whole numbers",
              at_ - text.size());
        return 0;
    }

    std::string_view word(std::string_view what) {
        skip_blanks();
        const std::string_view found = identifier();
        at_ += found.size();
        if (found.empty())
            error(fmt::format("expected {}", what), "a condition reads like 'fog == linear && point <= 2'");
        return found;
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
            for (const int feature : expression.features) sum += key[feature];
            for (const int feature : expression.subtracted) sum -= key[feature];
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
