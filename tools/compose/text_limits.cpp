#include "compose/text_limits.hpp"

#include <algorithm>
#include <array>
#include <list>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "compose/tokens.hpp"
#include "core/text.hpp"

namespace gobo {
namespace {

// glslang 12 recurses once per bracket and once per operator, and overflows its stack on hostile input; no
// real shader comes near.
constexpr std::size_t kDeepestNesting = 200;
constexpr int kMostOperators = 2000;
/// Its parser's stack has 10,000 places, of which an `else if` takes seven.
constexpr int kDeepestStatements = 1000;
/// An instruction of SPIR-V has 65,535 words.
constexpr int kMostElements = 65'000;
constexpr double kMostTokens = 1e6;
constexpr double kMostMembers = 1e4;

/// Whether brackets behind the token hold arguments or a subscript.
bool ends_operand(std::string_view token) {
    constexpr std::array<std::string_view, 5> keywords = {"if", "for", "while", "switch", "return"};
    return token == ")" || token == "]" ||
           (is_identifier_start(token.front()) && std::ranges::find(keywords, token) == keywords.end());
}

/// What tokens become.
struct Growth {
    double tokens = 1;         ///< without arguments
    double each_argument = 1;  ///< of a macro: how many tokens one of an argument becomes, at most
};

/// Sums up what macros stand for, each once. All definitions of a name are taken together.
class MacroSizes {
  public:
    explicit MacroSizes(const std::vector<Directive>& directives) {
        for (const Directive& directive : directives) {
            if (directive.word != "define") continue;
            std::span<const std::string_view> rest = kept_.emplace_back(tokens_of(directive.rest));
            if (rest.empty()) continue;
            Macro& macro = macros_[rest.front()];
            const char* const behind = rest.front().data() + rest.front().size();
            const bool is_function = behind < directive.rest.data() + directive.rest.size() && *behind == '(';
            rest = rest.subspan(1);
            for (; is_function && !rest.empty() && rest.front() != ")"; rest = rest.subspan(1))
                if (rest.front() != "(" && rest.front() != ",") macro.parameters.emplace(rest.front(), 0);
            macro.body.insert(macro.body.end(), rest.begin(), rest.end());
        }
    }

    /// Of a name that is no macro, one token.
    Growth of(std::string_view name) {
        const auto macro = macros_.find(name);
        if (macro == macros_.end()) return {};
        const auto [known, is_new] = known_.try_emplace(name);
        if (!is_new || depth_ == kDeepestNesting) return known->second;  // known, or within itself
        ++depth_;
        std::map<std::string_view, double> uses = macro->second.parameters;
        Growth growth{of(macro->second.body, uses), 1};
        for (const auto& [parameter, count] : uses)
            growth.each_argument = std::max(growth.each_argument, count);
        --depth_;
        return known_[name] = growth;
    }

    /// How many tokens these become. Adds to `uses` how often each of its names is there then.
    double of(std::span<const std::string_view> tokens, std::map<std::string_view, double>& uses) {
        double sum = 0;
        std::vector<double> copies = {1};  // of what stands in each bracket
        double of_arguments = 1;           // of the macro that was named last
        for (const std::string_view token : tokens) {
            if (token == "(") copies.push_back(copies.back() * of_arguments);
            if (token == ")" && copies.size() > 1) copies.pop_back();
            const Growth growth = of(token);
            of_arguments = growth.each_argument;
            if (const auto use = uses.find(token); use != uses.end())
                use->second += copies.back();
            else
                sum += copies.back() * growth.tokens;
        }
        return sum;
    }

  private:
    struct Macro {
        std::vector<std::string_view> body;
        std::map<std::string_view, double> parameters;
    };

    std::list<std::vector<std::string_view>> kept_;
    std::map<std::string_view, Macro> macros_;
    std::map<std::string_view, Growth> known_;
    std::size_t depth_ = 0;
};

}  // namespace

/// Statements in statements: `if (a) for (;;) if (b) c; else if (d) e;`
void Nesting::follow_statement(Level& level, std::string_view token) {
    const bool ends_loop = level.is_ended && level.loops > 0 && token == "while";
    if (ends_loop) --level.loops;
    if (level.is_ended && !ends_loop && token != "else") level.statements = level.loops = 0;
    level.is_ended = false;
    if (ends_loop || token == "else") return;
    if (token == "do") ++level.loops;
    const bool holds_another =
        token == "if" || token == "for" || token == "while" || token == "do" || token == "switch";
    if (holds_another) ++level.statements;
    if (token == "case" || token == "default") level.is_label = true;
    const bool ends_label = token == ":" && level.is_label;
    if (ends_label) level.is_label = false;
    if (holds_another || ends_label) level.operators = 0;
}

std::optional<std::string> Nesting::add(std::string_view token) {
    const std::string_view before = std::exchange(before_, token);
    const char first = token.front();
    follow_statement(levels_.back(), token);
    if (first == '(' || first == '[' || first == '{') {
        const bool is_list = first == '{' ? before == "=" || before == "," || before == "{" || before == "("
                                          : ends_operand(before);
        if (first != '{') ++levels_.back().operators;
        levels_.push_back({is_list});
    } else if (first == ')' || first == ']' || first == '}') {
        if (levels_.size() > 1) levels_.pop_back();
        if (first == '}') {
            levels_.back().operators = 0;
            levels_.back().is_ended = true;
        }
    } else if (first == ';' || (first == ',' && levels_.back().is_list)) {
        levels_.back().operators = 0;
        levels_.back().is_ended = first == ';';
        if (first == ',' && ++levels_.back().elements == kMostElements)
            return fmt::format("a list has more than {} elements", kMostElements);
    } else if (token == "." || (!is_identifier_part(first) && first != '.')) {
        ++levels_.back().operators;
    }
    if (levels_.size() > kDeepestNesting + 1)
        return fmt::format("brackets are nested more than {} deep", kDeepestNesting);
    if (levels_.back().statements > kDeepestStatements)
        return fmt::format("statements are nested more than {} deep, each `else if` counted",
                           kDeepestStatements);
    if (levels_.back().operators > kMostOperators)
        return fmt::format("an expression has more than {} operators", kMostOperators);
    return std::nullopt;
}

static bool is_endless(const Growth& growth) {
    return growth.tokens + growth.each_argument > kMostTokens;
}

const Directive* endless_macro(const std::vector<Directive>& directives) {
    MacroSizes sizes(directives);
    const auto found = std::ranges::find_if(directives, [&](const Directive& directive) {
        const std::vector<std::string_view> tokens = tokens_of(directive.rest);
        return directive.word == "define" && !tokens.empty() && is_endless(sizes.of(tokens.front()));
    });
    return found == directives.end() ? nullptr : &*found;
}

bool has_endless_calls(const std::vector<Directive>& directives, std::span<const std::string_view> tokens) {
    std::vector<std::string_view> code;  // without the directives
    bool is_of_directive = false;
    const char* before = nullptr;  // the end of the token before
    for (const std::string_view token : tokens) {
        if (before != nullptr && std::find(before, token.data(), '\n') != token.data())
            is_of_directive = false;
        is_of_directive = is_of_directive || token == "#";
        if (!is_of_directive) code.push_back(token);
        before = token.data() + token.size();
    }
    std::map<std::string_view, double> uses;
    return MacroSizes(directives).of(code, uses) > kMostTokens + static_cast<double>(code.size());
}

std::string_view endless_struct(std::span<const std::string_view> tokens) {
    std::map<std::string_view, double> sizes;
    for (std::size_t i = 0; i + 2 < tokens.size(); ++i) {
        if (tokens[i] != "struct" || tokens[i + 2] != "{") continue;
        const std::string_view name = tokens[i + 1];
        double members = 0;
        double size = 1;  // of the member that is being read
        for (i += 3; i < tokens.size() && tokens[i] != "}"; ++i) {
            if (const auto known = sizes.find(tokens[i]); known != sizes.end()) size = known->second;
            if (tokens[i] == "," || tokens[i] == ";") members += size;
            if (tokens[i] == ";") size = 1;
        }
        if (members > kMostMembers) return name;
        sizes[name] = members;
    }
    return {};
}

}  // namespace gobo
