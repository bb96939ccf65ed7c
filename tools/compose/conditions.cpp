#include "compose/conditions.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <span>

#include <fmt/format.h>

#include "compose/dialect.hpp"
#include "compose/language_names.hpp"
#include "compose/tokens.hpp"
#include "core/text.hpp"

namespace gobo {
namespace {

/// Real conditions take some dozens; a chain of macros that double one another would take for ever.
constexpr std::size_t kMostTokens = 20'000;
constexpr std::size_t kDeepest = 100;

/// Stands for what only the driver knows.
constexpr std::string_view kUnknown = "?";

using Macros = std::map<std::string, MacroDefinition, std::less<>>;
using Words = std::vector<std::string>;

/// Replaces macros by their definitions.
class Expander {
  public:
    explicit Expander(const Macros& macros) : macros_(macros) {}

    /// Adds the words with their macros replaced to `result`. False where there is no end to it.
    [[nodiscard]] bool expand(std::span<const std::string> words, Words& result) {
        if (++depth_ > kDeepest) return false;
        for (std::size_t i = 0; i < words.size(); ++i) {
            if (++steps_ > kMostTokens) return false;
            const auto found = macros_.find(words[i]);
            const bool is_call = i + 1 < words.size() && words[i + 1] == "(";
            if (found == macros_.end() || has_open(words[i]) || (found->second.is_function && !is_call)) {
                result.push_back(words[i]);
                continue;
            }
            const auto& [name, macro] = *found;
            if (!macro.is_certain) {
                result.emplace_back(kUnknown);
                continue;
            }
            Words body = macro.body;
            if (macro.is_function && !substitute(macro, words, i, body)) return false;
            open_.push_back(name);
            if (!expand(body, result)) return false;
            open_.pop_back();
        }
        --depth_;
        return true;
    }

  private:
    [[nodiscard]] bool has_open(std::string_view name) const {
        return std::ranges::find(open_, name) != open_.end();
    }

    /// Puts the arguments of the call at words[at] in place of the parameters; `at` goes on to its end.
    [[nodiscard]] bool substitute(const MacroDefinition& macro, std::span<const std::string> words,
                                  std::size_t& at, Words& body) {
        std::vector<Words> arguments(1);
        int depth = 0;
        for (++at; at < words.size(); ++at) {
            if (words[at] == "(" && ++depth == 1) continue;
            if (words[at] == ")" && --depth == 0) break;
            if (words[at] == "," && depth == 1)
                arguments.emplace_back();
            else
                arguments.back().push_back(words[at]);
        }
        for (Words& argument : arguments) {
            Words expanded;
            if (!expand(argument, expanded)) return false;
            argument = std::move(expanded);
        }
        body.clear();
        for (const std::string& word : macro.body) {
            const auto index = static_cast<std::size_t>(std::ranges::find(macro.parameters, word) -
                                                        macro.parameters.begin());
            if (index < std::min(macro.parameters.size(), arguments.size()))
                body.insert(body.end(), arguments[index].begin(), arguments[index].end());
            else
                body.push_back(word);
            if (body.size() > kMostTokens) return false;
        }
        return true;
    }

    const Macros& macros_;
    std::vector<std::string_view> open_;  ///< being replaced: none is replaced within itself
    std::size_t steps_ = 0;
    std::size_t depth_ = 0;
};

/// The binary operators, by the order in which they bind, loosest first.
struct Operator {
    std::string_view text;
    int binds;
};
constexpr std::array<Operator, 18> kOperators = {{{"||", 1},
                                                  {"&&", 2},
                                                  {"|", 3},
                                                  {"^", 4},
                                                  {"&", 5},
                                                  {"==", 6},
                                                  {"!=", 6},
                                                  {"<", 7},
                                                  {">", 7},
                                                  {"<=", 7},
                                                  {">=", 7},
                                                  {"<<", 8},
                                                  {">>", 8},
                                                  {"+", 9},
                                                  {"-", 9},
                                                  {"*", 10},
                                                  {"/", 10},
                                                  {"%", 10}}};

std::int64_t wrapped(std::uint64_t value) {
    return static_cast<std::int64_t>(value);
}

Known apply_operator(std::string_view op, Known left, Known right) {
    if (op == "&&" && (left == 0 || right == 0)) return 0;
    if (op == "||" && (left.value_or(0) != 0 || right.value_or(0) != 0)) return 1;
    if (!left || !right) return std::nullopt;
    const std::int64_t a = *left;
    const std::int64_t b = *right;
    const auto x = static_cast<std::uint64_t>(a);
    const auto y = static_cast<std::uint64_t>(b);
    if (op == "||" || op == "|") return op == "|" ? a | b : 0;
    if (op == "&&" || op == "&") return op == "&" ? a & b : 1;
    if (op == "^") return a ^ b;
    if (op == "==") return a == b ? 1 : 0;
    if (op == "!=") return a != b ? 1 : 0;
    if (op == "<") return a < b ? 1 : 0;
    if (op == ">") return a > b ? 1 : 0;
    if (op == "<=") return a <= b ? 1 : 0;
    if (op == ">=") return a >= b ? 1 : 0;
    if (op == "+") return wrapped(x + y);
    if (op == "-") return wrapped(x - y);
    if (op == "*") return wrapped(x * y);
    if (op == "<<" || op == ">>") {
        if (b < 0 || b > 63) return std::nullopt;
        return op == "<<" ? wrapped(x << y) : a >> b;
    }
    if (b == 0) return std::nullopt;
    if (b == -1) return op == "/" ? wrapped(0 - x) : 0;
    return op == "/" ? a / b : a % b;
}

/// Evaluates words whose macros are replaced. What is no expression is unknown: glslang says what is wrong.
class Evaluator {
  public:
    explicit Evaluator(std::span<const std::string> words) : words_(words) {}

    Known run() {
        const Known value = binary(1);
        return is_wrong_ || at_ != words_.size() ? std::nullopt : value;
    }

  private:
    [[nodiscard]] std::string_view next() const {
        return at_ < words_.size() ? words_[at_] : std::string_view();
    }
    Known wrong() {
        is_wrong_ = true;
        return std::nullopt;
    }

    Known binary(int lowest) {
        Known left = unary();
        while (!is_wrong_) {
            const auto* const op = std::ranges::find(kOperators, next(), &Operator::text);
            if (op == kOperators.end() || op->binds < lowest) break;
            ++at_;
            left = apply_operator(op->text, left, binary(op->binds + 1));
        }
        return left;
    }

    Known unary() {
        const std::size_t begin = at_;
        while (next() == "!" || next() == "-" || next() == "+" || next() == "~") ++at_;
        const std::size_t end = at_;
        Known value = primary();
        for (std::size_t i = end; value && i-- > begin;) {
            if (words_[i] == "!") value = *value == 0 ? 1 : 0;
            if (words_[i] == "-") value = wrapped(0 - static_cast<std::uint64_t>(*value));
            if (words_[i] == "~") value = ~*value;
        }
        return value;
    }

    Known primary() {
        const std::string_view word = next();
        if (word.empty()) return wrong();
        ++at_;
        if (word == "(") {
            if (++depth_ > kDeepest) return wrong();
            const Known value = binary(1);
            --depth_;
            if (next() != ")") return wrong();
            ++at_;
            return value;
        }
        if (word == kUnknown) return std::nullopt;
        if (is_identifier(word)) return 0;  // as C has it
        return number(word);
    }

    Known number(std::string_view word) {
        if (word.ends_with('u') || word.ends_with('U')) word.remove_suffix(1);
        int base = 10;
        if (word.starts_with("0x") || word.starts_with("0X")) {
            word.remove_prefix(2);
            base = 16;
        } else if (word.size() > 1 && word.starts_with('0')) {
            base = 8;
        }
        std::int64_t value = 0;
        const char* const end = word.data() + word.size();
        const auto parsed = std::from_chars(word.data(), end, value, base);
        return parsed.ec == std::errc() && parsed.ptr == end ? Known(value) : wrong();
    }

    std::span<const std::string> words_;
    std::size_t at_ = 0;
    std::size_t depth_ = 0;
    bool is_wrong_ = false;
};

Words words_of(std::string_view text) {
    const std::vector<std::string_view> tokens = tokens_of(text);
    return {tokens.begin(), tokens.end()};
}

}  // namespace

std::string_view macro_name(std::string_view text) {
    return {text.begin(), std::ranges::find_if_not(text, is_identifier_part)};
}

Conditions::Conditions(std::string_view prologue, bool is_for_driver) : is_for_driver_(is_for_driver) {
    for (const std::string& macro : version_macros(version_of(prologue))) define(macro);
    for (const std::string& line : split(prologue, '\n'))
        if (line.starts_with("#define ")) define(std::string_view(line).substr(8));
}

/// Whether only the driver knows if a name is a macro: those of extensions.
bool Conditions::is_drivers(std::string_view name) const {
    constexpr std::array<std::string_view, 4> decided = {"GL_ES", "GL_es_profile", "GL_core_profile",
                                                         "GL_compatibility_profile"};
    return name.starts_with("GL_") && std::ranges::find(decided, name) == decided.end() &&
           !(is_for_driver_ && is_foreign_macro(name));
}

Known Conditions::is_defined(std::string_view name) const {
    if (const auto macro = macros_.find(name); macro != macros_.end())
        return macro->second.is_certain ? Known(1) : std::nullopt;
    return is_drivers(name) ? std::nullopt : Known(0);
}

bool Conditions::would_redefine(const Directive& directive) const {
    const auto macro = macros_.find(macro_name(directive.rest));
    if (macro == macros_.end() || !macro->second.is_certain || !is_active() || !is_certain()) return false;
    const MacroDefinition other = definition(directive.rest);
    return other.is_function != macro->second.is_function || other.parameters != macro->second.parameters ||
           other.body != macro->second.body;
}

void Conditions::define(std::string_view text) {
    macros_.insert_or_assign(std::string(macro_name(text)), definition(text));
}

MacroDefinition Conditions::definition(std::string_view text) const {
    MacroDefinition macro;
    macro.is_certain = is_certain();
    text.remove_prefix(macro_name(text).size());
    macro.is_function = text.starts_with('(');
    if (macro.is_function) {
        macro.parameters = split(text.substr(1, text.find(')') - 1), ',');
        text.remove_prefix(std::min(text.find(')'), text.size() - 1) + 1);
    }
    macro.body = words_of(text);
    return macro;
}

Result<Known> Conditions::value_of(const Directive& directive, bool has_variables) const {
    const Words words = words_of(directive.rest);
    if (directive.word == "ifdef" || directive.word == "ifndef") {
        const Known defined = is_defined(words.empty() ? "" : words.front());
        return directive.word == "ifndef" && defined ? Known(1 - *defined) : defined;
    }
    Words asked;  // with `defined NAME` and `defined(NAME)` answered
    for (std::size_t i = 0; i < words.size(); ++i) {
        const bool in_brackets = i + 3 < words.size() && words[i + 1] == "(" && words[i + 3] == ")";
        if (words[i] != "defined" || i + 1 == words.size()) {
            asked.push_back(words[i]);
            continue;
        }
        i += in_brackets ? 2 : 1;
        const Known defined = is_defined(words[i]);
        asked.emplace_back(!defined ? kUnknown : *defined != 0 ? "1" : "0");
        if (in_brackets) ++i;
    }
    Words expanded;
    if (!Expander(macros_).expand(asked, expanded))
        return fail(directive.place, directive.line,
                    fmt::format("the macros of this condition expand to more than {} tokens", kMostTokens),
                    "define them more simply");
    std::ranges::replace_if(
        expanded,
        [&](const std::string& word) {
            return is_drivers(word) || (has_variables && is_identifier_start(word.front()));
        },
        std::string(kUnknown));
    return Evaluator(expanded).run();
}

Result<void> Conditions::apply(const Directive& directive) {
    const std::string& word = directive.word;
    if (word == "pragma" || word == "subroutine") return {};
    if (word == "define" || word == "undef") {
        if (!is_active()) return {};
        if (word == "define")
            define(directive.rest);
        else if (const auto macro = macros_.find(trim(directive.rest)); macro == macros_.end())
            return {};
        else if (is_certain())
            macros_.erase(macro);
        else
            macro->second.is_certain = false;
        return {};
    }
    if (word.starts_with("if"))  // #if, #ifdef, #ifndef
        frames_.push_back({is_active(), false, false, is_certain()});
    if (frames_.empty()) return {};
    Frame& frame = frames_.back();
    if (word == "endif") {
        frames_.pop_back();
        return {};
    }
    frame.is_active = frame.is_reached && !frame.is_done;
    if (!frame.is_active || word == "else") return {};
    GOBO_TRY(const Known value, value_of(directive));
    frame.is_active = value != 0;
    frame.is_done = value.value_or(0) != 0;
    frame.is_certain = frame.is_certain && value;
    return {};
}

}  // namespace gobo
