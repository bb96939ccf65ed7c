#include "family/expression.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "core/text.hpp"
#include "family/family.hpp"

namespace gobo {
namespace {

using Comparison = Expression::Comparison;

/// Parentheses and negations nested deeper than this are refused rather than followed into a stack overflow.
constexpr int deepest_nesting = 200;

/// Recursive descent over one condition. The first error is thrown, and caught by parse().
class Parser {
  public:
    Parser(std::string_view text, const std::vector<Feature>& features, Place place, Fault fault)
        : text_(text), features_(features), place_(std::move(place)), fault_(fault) {}

    Result<Expression> parse() {
        try {
            Expression expression = disjunction();
            skip_blanks();
            if (at_ < text_.size())
                stop(fmt::format("unexpected '{}'", text_.substr(at_, 1)), "join conditions by && or ||");
            return expression;
        } catch (Diagnostic& error) {
            return fail(std::move(error));
        }
    }

  private:
    Expression disjunction() { return chain("||", Expression::Kind::disjunction, &Parser::conjunction); }
    Expression conjunction() { return chain("&&", Expression::Kind::conjunction, &Parser::negation); }

    Expression chain(std::string_view symbol, Expression::Kind kind, Expression (Parser::*part)()) {
        std::vector<Expression> parts = {(this->*part)()};
        while (accepts(symbol)) parts.push_back((this->*part)());
        if (parts.size() == 1) return std::move(parts.front());
        return {.kind = kind, .parts = std::move(parts)};
    }

    Expression negation() {
        if (++depth_ > deepest_nesting) stop("the condition is nested too deeply", "simplify it");
        Expression expression;
        if (accepts("!")) {
            expression = negated(negation());
        } else if (accepts("(")) {
            expression = disjunction();
            if (!accepts(")")) stop("missing ')'", "close the parenthesis");
        } else {
            expression = compare();
        }
        --depth_;
        return expression;
    }

    Expression compare() {
        Expression expression{.kind = Expression::Kind::compare, .features = sum()};
        expression.comparison = comparison();
        check_kinds(expression.features, expression.comparison);
        const bool is_sum = expression.features.size() > 1;
        const Feature& first = features_[expression.features.front()];
        if ((is_sum || first.kind == FeatureKind::count) && next_is_sum()) {
            expression.subtracted = sum();
            check_kinds(expression.subtracted, expression.comparison);
        } else {
            expression.value = is_sum ? number() : value(first);
            if (fault_ == Fault::usage && (is_sum || first.kind == FeatureKind::count))
                check_range(expression.features, expression.comparison, expression.value);
        }
        for (const int feature : expression.features) expression.value -= features_[feature].lowest;
        for (const int feature : expression.subtracted) expression.value += features_[feature].lowest;
        return expression;
    }

    /// A rule that a family shares with others may say more than its counts allow; who types a condition
    /// errs, but in what always holds, such as 'point < 5' of up to 4.
    void check_range(const std::vector<int>& counts, Comparison comparison, int value) const {
        int least = 0;
        int most = 0;
        std::vector<std::string> names;
        for (const int index : counts) {
            const Feature& feature = features_[index];
            least += feature.lowest;
            most += feature.lowest + static_cast<int>(feature.values.size()) - 1;
            names.push_back(feature.name);
        }
        const bool is_below = comparison == Comparison::less || comparison == Comparison::less_equal;
        const bool is_above = comparison == Comparison::greater || comparison == Comparison::greater_equal;
        if ((value < least && !is_above) || (value > most && !is_below))
            stop(fmt::format("'{}' is never {}", join(names, " + "), value),
                 fmt::format("a whole number from {} to {}", least, most), std::to_string(value).size());
    }

    /// Features joined by "+".
    std::vector<int> sum() {
        std::vector<int> features = {feature()};
        while (accepts("+")) features.push_back(feature());
        return features;
    }

    /// Whether the name of what can be added follows, which is left to be read.
    bool next_is_sum() {
        skip_blanks();
        const auto index = index_of(features_, identifier());
        return index && features_[*index].kind != FeatureKind::choice;
    }

    /// What follows, up to the next character that no name has.
    [[nodiscard]] std::string_view identifier() const {
        const std::string_view rest = text_.substr(at_);
        const auto end = std::ranges::find_if_not(rest, is_identifier_part);
        return rest.substr(0, end - rest.begin());
    }

    int feature() {
        const std::string_view name = word("a feature's name");
        if (const auto index = index_of(features_, name)) return *index;
        stop(fmt::format("unknown feature '{}'", name), help_for(features_, name), name.size());
    }

    Comparison comparison() {
        for (std::size_t i = std::size(kComparisonSymbols); i-- > 0;)  // backwards: "<" begins "<="
            if (accepts(kComparisonSymbols[i])) return static_cast<Comparison>(i);
        stop("expected a comparison", "one of == != < <= > >=");
    }

    void check_kinds(const std::vector<int>& summands, Comparison comparison) {
        const bool equality = comparison == Comparison::equal || comparison == Comparison::not_equal;
        for (const int index : summands) {
            const Feature& feature = features_[index];
            if (feature.kind == FeatureKind::count) continue;
            if (summands.size() > 1 && feature.kind == FeatureKind::define) continue;
            if (summands.size() > 1)
                stop(fmt::format("'{}' is not a count and cannot be added", feature.name),
                     "add counts, and features that are off or on, of which one that is on is 1");
            if (!equality)
                stop(fmt::format("'{}' is not a count and has no order", feature.name),
                     "compare it by == or !=");
        }
    }

    int value(const Feature& feature) {
        if (feature.kind == FeatureKind::count) return number();
        const std::string_view text = word("a value");
        if (const auto index = feature.index_of(text)) return *index;
        stop(fmt::format("feature '{}' has no value '{}'", feature.name, text), feature.help_for(text),
             text.size());
    }

    int number() {
        const std::string_view text = word("a value");
        if (const auto number = number_from<int>(text)) return *number;
        stop(fmt::format("'{}' is not a whole number", text), "counts compare with whole numbers",
             text.size());
    }

    std::string_view word(std::string_view what) {
        skip_blanks();
        const std::string_view found = identifier();
        at_ += found.size();
        if (found.empty())
            stop(fmt::format("expected {}", what), "a condition reads like 'fog == linear && point <= 2'");
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
        while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos)
            ++at_;
    }

    /// The error stands `back` characters before what follows.
    [[noreturn]] void stop(std::string_view message, std::string help, std::size_t back = 0) const {
        const std::string_view before = text_.substr(0, at_ - back);
        const std::size_t last_line = before.find_last_of('\n') + 1;  // 0 where there is one line
        Place place = place_;
        if (place.column > 0) place.line += static_cast<int>(std::ranges::count(before, '\n'));
        if (place.column > 0)
            place.column = (last_line > 0 ? 1 : place.column) + static_cast<int>(before.size() - last_line);
        throw Diagnostic{.fault = fault_,
                         .place = place,
                         .message = fmt::format("{} in the condition '{:.200}'", message, one_line(text_)),
                         .help = std::move(help)};
    }

    std::string_view text_;
    const std::vector<Feature>& features_;
    Place place_;
    Fault fault_;
    std::size_t at_ = 0;
    int depth_ = 0;
};

}  // namespace

bool compare(int left, Expression::Comparison comparison, int right) {
    const std::array holds = {left == right, left != right, left<right, left <= right, left> right,
                              left >= right};
    return holds[static_cast<std::size_t>(comparison)];
}

Expression negated(Expression expression) {
    constexpr std::array opposites = {Comparison::not_equal,     Comparison::equal,
                                      Comparison::greater_equal, Comparison::greater,
                                      Comparison::less_equal,    Comparison::less};
    expression.comparison = opposites[static_cast<std::size_t>(expression.comparison)];
    if (expression.kind == Expression::Kind::compare) return expression;
    const bool was_all = expression.kind == Expression::Kind::conjunction;
    expression.kind = was_all ? Expression::Kind::disjunction : Expression::Kind::conjunction;
    for (Expression& part : expression.parts) part = negated(std::move(part));
    return expression;
}

Result<Expression> parse_expression(std::string_view text, const std::vector<Feature>& features,
                                    const Place& place, Fault fault) {
    return Parser(text, features, place, fault).parse();
}

bool holds(const Expression& expression, const std::vector<int>& key) {
    const auto part_holds = [&](const Expression& part) { return holds(part, key); };
    if (expression.kind == Expression::Kind::conjunction)
        return std::ranges::all_of(expression.parts, part_holds);
    if (expression.kind == Expression::Kind::disjunction)
        return std::ranges::any_of(expression.parts, part_holds);
    int sum = 0;
    for (const int feature : expression.features) sum += key[feature];
    for (const int feature : expression.subtracted) sum -= key[feature];
    return compare(sum, expression.comparison, expression.value);
}

}  // namespace gobo
