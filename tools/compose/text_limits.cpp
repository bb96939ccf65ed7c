#include "compose/text_limits.hpp"

#include <algorithm>
#include <array>
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
constexpr double kMostTokens = 1e6;
constexpr double kMostMembers = 1e4;

/// Whether brackets behind the token hold arguments or a subscript.
bool ends_operand(std::string_view token) {
    constexpr std::array<std::string_view, 5> keywords = {"if", "for", "while", "switch", "return"};
    return token == ")" || token == "]" ||
           (is_identifier_start(token.front()) && std::ranges::find(keywords, token) == keywords.end());
}

/// Sums up what macros stand for, each once.
class MacroSizes {
  public:
    explicit MacroSizes(const std::vector<Directive>& directives) {
        for (const Directive& directive : directives) {
            if (directive.word != "define") continue;
            const std::vector<std::string_view> tokens = tokens_of(directive.rest);
            if (tokens.empty()) continue;
            auto& bodies = bodies_[tokens.front()];
            bodies.insert(bodies.end(), tokens.begin() + 1, tokens.end());
        }
    }

    /// How many tokens it becomes; of a name that is no macro, 1. All its definitions are taken together.
    double of(std::string_view name) {
        const auto body = bodies_.find(name);
        if (body == bodies_.end()) return 1;
        const auto [size, is_new] = sizes_.try_emplace(name, 1);
        if (!is_new || depth_ == kDeepestNesting) return size->second;  // known, or within itself
        ++depth_;
        double sum = 0;
        for (const std::string_view token : body->second) sum += of(token);
        --depth_;
        return sizes_[name] = sum;
    }

  private:
    std::map<std::string_view, std::vector<std::string_view>> bodies_;
    std::map<std::string_view, double> sizes_;
    std::size_t depth_ = 0;
};

}  // namespace

std::optional<std::string> Nesting::add(std::string_view token) {
    const std::string_view before = std::exchange(before_, token);
    const char first = token.front();
    if (first == '(' || first == '[' || first == '{') {
        const bool is_list = first == '{' ? before == "=" || before == "," || before == "{" || before == "("
                                          : ends_operand(before);
        if (first != '{') ++levels_.back().operators;
        levels_.push_back({is_list});
    } else if (first == ')' || first == ']' || first == '}') {
        if (levels_.size() > 1) levels_.pop_back();
        if (first == '}') levels_.back().operators = 0;
    } else if (first == ';' || (first == ',' && levels_.back().is_list)) {
        levels_.back().operators = 0;
    } else if (token == "." || (!is_identifier_part(first) && first != '.')) {
        ++levels_.back().operators;
    }
    if (levels_.size() > kDeepestNesting + 1)
        return fmt::format("brackets are nested more than {} deep", kDeepestNesting);
    if (levels_.back().operators > kMostOperators)
        return fmt::format("an expression has more than {} operators", kMostOperators);
    return std::nullopt;
}

const Directive* endless_macro(const std::vector<Directive>& directives) {
    MacroSizes sizes(directives);
    const auto found = std::ranges::find_if(directives, [&](const Directive& directive) {
        const std::vector<std::string_view> tokens = tokens_of(directive.rest);
        return directive.word == "define" && !tokens.empty() && sizes.of(tokens.front()) > kMostTokens;
    });
    return found == directives.end() ? nullptr : &*found;
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
