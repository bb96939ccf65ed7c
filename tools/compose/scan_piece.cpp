#include "compose/scan_piece.hpp"

#include <algorithm>
#include <array>
#include <span>

#include <fmt/format.h>

#include "compose/clean_text.hpp"
#include "compose/text_limits.hpp"
#include "compose/tokens.hpp"
#include "core/glsl_version.hpp"
#include "core/text.hpp"

namespace gobo {
namespace {

constexpr int kMostIncludesBelow = 10'000;

using Tokens = std::span<const std::string_view>;

/// The line that a character of the text stands on.
int line_at(std::string_view text, const char* at) {
    return 1 + static_cast<int>(std::count(text.data(), at, '\n'));
}

/// Lines of a text, asked for in their order.
class LineReader {
  public:
    explicit LineReader(std::string_view text) : rest_(text) {}

    /// The line of a number that is no smaller than the last one; empty behind the end.
    std::string_view line(int number) {
        for (; number_ < number && !rest_.empty(); ++number_)
            rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size() - 1) + 1);
        return rest_.substr(0, rest_.find('\n'));
    }

  private:
    std::string_view rest_;
    int number_ = 1;
};

Diagnostic warning(const Place& place, std::string_view quoted_line, std::string message, std::string help) {
    Diagnostic diagnostic = fail(place, quoted_line, std::move(message), std::move(help)).value().front();
    diagnostic.severity = Severity::warning;
    return diagnostic;
}

/// Whether tokens follow one another from a place on; `name` and `number` stand for any.
bool are(Tokens tokens, std::initializer_list<std::string_view> pattern) {
    if (tokens.size() < pattern.size()) return false;
    return std::ranges::equal(
        tokens.first(pattern.size()), pattern, [](std::string_view token, std::string_view wanted) {
            if (wanted == "name") return is_identifier(token);
            if (wanted != "number") return token == wanted;
            return token.size() <= 6 && token.find_first_not_of("0123456789") == std::string_view::npos;
        });
}

/// The bindings stated by BLOCK(3, Fog) and SAMPLER(2, sampler2D) shadowMap.
std::vector<StatedBinding> bindings_of(Tokens tokens) {
    std::vector<StatedBinding> bindings;
    for (; tokens.size() > 4; tokens = tokens.subspan(1)) {
        const bool is_sampler = are(tokens, {"SAMPLER", "(", "number", ",", "name", ")", "name"});
        if (is_sampler || are(tokens, {"BLOCK", "(", "number", ",", "name", ")"}))
            bindings.push_back(
                {std::string(tokens[is_sampler ? 6 : 4]), std::stoi(std::string(tokens[2])), is_sampler});
    }
    return bindings;
}

/// A condition that is open: its first directive, and where its #else stands.
struct Condition {
    Directive begin;
    int else_line = 0;  ///< 0: none yet
};

/// Walks over the lines of one file, collecting into `result`.
class Scanner {
  public:
    Scanner(std::string_view file, const std::string& path, CleanText clean)
        : file_(file), path_(path), clean_(std::move(clean)) {}

    Result<ScannedPiece> run() {
        number_own_lines();
        LineReader lines(file_);
        for (std::size_t start = 0, number = 1; start < clean_.code.size(); ++number) {
            const std::size_t end = clean_.code.find('\n', start);
            line_ = lines.line(static_cast<int>(number));
            if (std::ranges::binary_search(clean_.joined_comments, static_cast<int>(number)))
                result_.warnings.push_back(
                    warning({path_, static_cast<int>(number), 0}, line_,
                            "this comment takes in the next line, since it ends in '\\'",
                            "write something behind the '\\'"));
            GOBO_TRY_DO(scan_line(static_cast<int>(number), start, end));
            start = end + 1;
        }
        if (!open_.empty()) {
            const Directive& begin = open_.back().begin;
            return fail_at(begin, fmt::format("missing #endif: nothing ends this #{}", begin.word),
                           "write #endif in the same file, behind what the condition is for");
        }
        if (!is_guarded_) result_.guard.clear();
        drop_semicolons();
        const std::vector<std::string_view> tokens = tokens_of(clean_.code);
        GOBO_TRY_DO(check_growth(tokens));
        for (StatedBinding& stated : bindings_of(tokens))
            result_.bindings[std::move(stated.name)] = stated.binding;
        result_.code = without_trailing_blanks(clean_.code);
        result_.text = without_trailing_blanks(clean_.text);
        return std::move(result_);
    }

  private:
    static tl::unexpected<Diagnostics> fail_at(const Directive& directive, std::string message,
                                               std::string help) {
        return fail(directive.place, directive.line, std::move(message), std::move(help));
    }

    /// Drivers count the lines of a whole stage, each in its own way: the file's number takes the place of
    /// `__LINE__`, and 0 that of `__FILE__`, as a stage is one text to them. In a macro it would be that of
    /// the definition, and `#line` counts anew.
    void number_own_lines() {
        constexpr std::string_view kOwnLine = "__LINE__";
        constexpr std::string_view kOwnFile = "__FILE__";
        static_assert(kOwnLine.size() == kOwnFile.size());
        if (clean_.code.find(kOwnLine) == std::string::npos &&
            clean_.code.find(kOwnFile) == std::string::npos)
            return;
        std::vector<std::pair<std::size_t, int>> places;
        int number = 0;
        for (std::string_view rest = clean_.code; !rest.empty();) {
            const std::string_view line = rest.substr(0, rest.find('\n'));
            rest.remove_prefix(line.size() + 1);
            ++number;
            const std::vector<std::string_view> tokens = tokens_of(line);
            const std::string_view word = tokens.size() > 1 && tokens[0] == "#" ? tokens[1] : "";
            if (word == "line") return;
            if (word == "define") continue;
            for (const std::string_view token : tokens)
                if (token == kOwnLine || token == kOwnFile)
                    places.emplace_back(static_cast<std::size_t>(token.data() - clean_.code.data()),
                                        token == kOwnLine ? number : 0);
        }
        for (const auto& [place, line] : places)
            for (std::string* const text : {&clean_.text, &clean_.code})
                text->replace(place, kOwnLine.size(), fmt::format("{:<8}", line));
    }

    Result<void> scan_line(int number, std::size_t start, std::size_t end) {
        const std::string_view bare = std::string_view(clean_.code).substr(start, end - start);
        std::string_view rest = trim(bare);
        if (rest.empty()) return {};
        const bool is_outside = open_.empty();
        if (rest.starts_with('#')) {
            const int column = static_cast<int>(bare.find('#')) + 1;
            drop_suffixes(start, end);
            rest = trim(rest.substr(1));
            const std::string_view word = {rest.begin(), std::ranges::find_if_not(rest, is_identifier_part)};
            GOBO_TRY(const bool is_taken, take({std::string(word),
                                                std::string(trim(rest.substr(word.size()))),
                                                {path_, number, column},
                                                std::string(line_)}));
            if (is_taken) return blank(start, end);
            if (word == "else" || word == "endif") drop_words(start, end, word, number);
            if (word == "error" || word == "pragma") close_quotation(start, end, ' ');
        }
        close_quotation(start, end, '\'');
        if (is_outside && seen_code_) is_guarded_ = false;
        seen_code_ = true;
        seen_statement_ = seen_statement_ || !trim(bare).starts_with('#');
        return check_nesting(bare, number);
    }

    /// What the composer must know of a directive. Whether it takes the line out of the text.
    Result<bool> take(Directive directive) {
        const std::string& word = directive.word;
        if (word == "line") return true;  // lines are the file's own
        if (word == "version") return take_version(directive);
        if (word == "pragma") {
            const bool is_once = directive.rest == "once";
            result_.is_once = result_.is_once || is_once;
            if (directive.rest == kUnrollStart || directive.rest == kUnrollEnd)
                result_.directives.push_back(std::move(directive));
            return is_once;
        }
        if (word == "include" && !seen_code_) {
            GOBO_TRY(Include include, read_include(directive));
            result_.includes.push_back(std::move(include));
            return true;
        }
        if (word == "extension" && open_.empty()) return take_extension(directive);
        if (word == "if" || word == "ifdef" || word == "ifndef") {
            if (word == "ifndef" && !seen_code_ && result_.includes.empty()) result_.guard = directive.rest;
            open_.push_back({directive});
        } else if (word == "elif" || word == "else" || word == "endif") {
            GOBO_TRY_DO(go_on(directive));
        } else if (word == "extension") {
            Extensions scratch;
            if (!add_extension(scratch, directive)) return false;
        } else if (word != "define" && word != "undef" && word != "include") {
            return false;
        }
        // Each parts the file, and each part has lines before it.
        if (word == "include" && ++includes_below_ > kMostIncludesBelow)
            return fail_at(
                directive,
                fmt::format("this file has more than {} #includes below its top", kMostIncludesBelow),
                "include files at the top, or from one another");
        const bool is_blanked = word == "include" || word == "extension";
        result_.directives.push_back(std::move(directive));
        return is_blanked;
    }

    /// Of two with no code between them the later one holds, as to a driver; else the stronger, and one that
    /// ends an extension is warned of.
    Result<bool> take_extension(const Directive& directive) {
        Extensions stated;
        if (!add_extension(stated, directive)) return false;
        for (auto& [name, extension] : stated) {
            const auto held = result_.extensions.find(name);
            const bool is_weaker = held != result_.extensions.end() && extension.behavior == "disable" &&
                                   held->second.behavior != "disable";
            if (is_weaker && !seen_code_) {
                held->second = extension;
                continue;
            }
            if (is_weaker) result_.warnings.push_back(ended_extension(name, held->second, extension));
            add_extension(result_.extensions, name, extension);
        }
        return true;
    }

    /// In a condition another one may be left out: where it is not, glslang minds it.
    Result<bool> take_version(const Directive& directive) {
        const std::string version(trim(directive.rest));
        const bool is_other =
            !is_glsl_version(version) || (!result_.version.empty() && result_.version != version);
        if (is_other && !open_.empty()) return false;
        if (!is_glsl_version(version))
            return fail_at(directive, fmt::format("GLSL has no #version '{}'", version),
                           "write a number that GLSL has and the profile alone: 330 core, 450, 300 es");
        if (!result_.version.empty() && result_.version != version)
            return fail_at(directive, fmt::format("a second #version beside {}", result_.version),
                           "state the version once");
        if (seen_statement_ && result_.version.empty())
            return fail_at(directive, "#version stands behind code", "write it in the first line");
        result_.version = version;
        result_.version_line = directive;
        return true;
    }

    /// Of a directive by itself.
    Result<void> check_nesting(std::string_view code, int number) {
        Nesting of_directive;
        Nesting& nesting = trim(code).starts_with('#') ? of_directive : nesting_;
        for (const std::string_view token : tokens_of(code))
            if (const std::optional<std::string> excess = nesting.add(token))
                return fail({path_, number, 0}, line_.substr(0, 80), *excess,
                            "split the expression or the function");
        return {};
    }

    /// What would double at every step.
    Result<void> check_growth(Tokens tokens) const {
        if (const Directive* const macro = endless_macro(result_.directives))
            return fail_at(*macro, "this macro expands to more than a million tokens",
                           "define it more simply");
        if (has_endless_calls(result_.directives, tokens))
            return fail({path_}, {}, "the macros of this file expand to more than a million tokens",
                        "nest fewer of their calls");
        const std::string_view name = endless_struct(tokens);
        if (name.empty()) return {};
        const int line = line_at(clean_.code, name.data());
        return fail(
            {path_, line, 0}, line_of(file_, line),
            fmt::format("the struct '{}' has more than 10000 members, those of its members counted", name),
            "nest fewer structs");
    }

    /// #elif, #else and #endif.
    Result<void> go_on(const Directive& directive) {
        if (open_.empty())
            return fail_at(directive, fmt::format("#{} without #if", directive.word),
                           "begin and end a condition in the same file");
        Condition& condition = open_.back();
        if (directive.word == "endif") {
            open_.pop_back();
            return {};
        }
        if (condition.else_line > 0)
            return fail_at(
                directive,
                fmt::format("#{} behind the #else of line {}", directive.word, condition.else_line),
                "end the condition with #endif first");
        if (directive.word == "else") condition.else_line = directive.place.line;
        if (open_.size() == 1) is_guarded_ = false;
        return {};
    }

    Result<void> blank(std::size_t start, std::size_t end) {
        for (std::string* text : {&clean_.text, &clean_.code})
            for (std::size_t i = start; i < end; ++i)
                if (clean_.code[i] != ' ') (*text)[i] = ' ';
        return {};
    }

    /// To glslang a quotation mark without its end is an error even where nothing compiles it: the end may
    /// have stood in a comment. `instead` takes its place: where something compiles it, that must be as
    /// wrong.
    void close_quotation(std::size_t start, std::size_t end, char instead) {
        for (std::size_t i = start; i < end; ++i) {
            if (clean_.code[i] != '"') continue;
            std::size_t last = i + 1;
            while (last < end && clean_.code[last] != '"') last += clean_.code[last] == '\\' ? 2 : 1;
            if (last < end)
                i = last;
            else
                clean_.text[i] = clean_.code[i] = instead;
        }
    }

    /// Blanks what stands behind #else and #endif: some drivers take it, to others it is an error.
    void drop_words(std::size_t start, std::size_t end, std::string_view word, int number) {
        const std::size_t begin = clean_.code.find(word, start) + word.size();
        if (trim(std::string_view(clean_.code).substr(begin, end - begin)).empty()) return;
        result_.warnings.push_back(
            warning({path_, number, 0}, line_,
                    fmt::format("words behind #{} are left out: to some drivers they are an error", word),
                    "make them a comment"));
        for (std::size_t at = begin; at < end; ++at)
            if (clean_.code[at] != ' ') clean_.text[at] = clean_.code[at] = ' ';
    }

    /// Blanks the `u` of `#if 1u`, which drivers take and glslang does not.
    void drop_suffixes(std::size_t start, std::size_t end) {
        const std::size_t word = clean_.code.find_first_not_of("# \t", start);
        if (word >= end ||
            !(clean_.code.compare(word, 3, "if ") == 0 || clean_.code.compare(word, 5, "elif ") == 0))
            return;
        for (std::size_t at = word; at < end; ++at) {
            const std::size_t first = at;
            while (at < end && is_identifier_part(clean_.code[at])) ++at;
            const bool is_number = at > first && clean_.code[first] >= '0' && clean_.code[first] <= '9';
            if (is_number && (clean_.code[at - 1] == 'u' || clean_.code[at - 1] == 'U'))
                clean_.text[at - 1] = clean_.code[at - 1] = ' ';
        }
    }

    /// Blanks each `;` that stands alone at the top, behind another, a function's body or the #version: every
    /// driver takes it, but GLSL has it from 4.60 on only.
    void drop_semicolons() {
        const std::string code = without_directives(clean_.code);
        const std::vector<std::string_view> tokens = tokens_of(code);
        const auto place_of = [&](std::size_t token) {
            return static_cast<std::size_t>(tokens[token].data() - code.data());
        };
        int depth = 0;  // of braces and brackets
        bool is_function = false;
        std::size_t head = 0;  // where the declaration begins
        for (std::size_t i = 0; i < tokens.size(); ++i) {
            const std::string_view token = tokens[i];
            if (token == "{" && depth == 0)
                is_function = is_function_head(Tokens(tokens).subspan(head, i - head));
            if (token == "{" || token == "(") ++depth;
            if (token == "}" || token == ")") --depth;
            if (depth != 0) continue;
            const bool is_first = i == 0 && !result_.version.empty() && result_.includes.empty();
            const bool is_alone =
                token == ";" &&
                (is_first || (i > 0 && (tokens[i - 1] == ";" || (tokens[i - 1] == "}" && is_function))));
            // What stands behind a directive may be the end of one branch alone.
            const std::size_t at = place_of(i);
            const auto is_behind_directive = [&] {
                const std::size_t before = place_of(i - 1);
                return std::string_view(clean_.code).substr(before, at - before).find('#') !=
                       std::string_view::npos;
            };
            if (is_alone && (is_first || !is_behind_directive())) clean_.text[at] = clean_.code[at] = ' ';
            if (token == ";" || token == "}") head = i + 1;
        }
    }

    static std::string without_directives(std::string code) {
        for (std::size_t start = 0; start < code.size();) {
            const std::size_t end = std::min(code.find('\n', start), code.size());
            if (trim(std::string_view(code).substr(start, end - start)).starts_with('#'))
                std::fill(code.begin() + static_cast<std::ptrdiff_t>(start),
                          code.begin() + static_cast<std::ptrdiff_t>(end), ' ');
            start = end + 1;
        }
        return code;
    }

    /// `void main()`: two names before the bracket, and no block's word. A macro may stand for a block's
    /// head.
    static bool is_function_head(Tokens head) {
        const auto bracket = std::ranges::find(head, "(");
        if (head.empty() || head.back() != ")" || bracket - head.begin() < 2) return false;
        if (!is_identifier(bracket[-1]) || !(is_identifier(bracket[-2]) || bracket[-2] == "]")) return false;
        return std::none_of(head.begin(), bracket, [](std::string_view token) {
            constexpr std::string_view words = " uniform buffer in out layout struct ";
            return words.find(fmt::format(" {} ", token)) != std::string_view::npos;
        });
    }

    std::string_view file_;
    std::string path_;
    CleanText clean_;
    ScannedPiece result_;
    std::vector<Condition> open_;
    std::string_view line_;  ///< of the file, that is being read
    int includes_below_ = 0;
    bool seen_code_ = false;
    bool seen_statement_ = false;  ///< code that is no directive
    bool is_guarded_ = true;
    Nesting nesting_;
};

}  // namespace

Result<Include> read_include(const Directive& directive) {
    const std::string_view rest = directive.rest;
    const bool angle = rest.size() > 2 && rest.front() == '<' && rest.back() == '>';
    const bool quote = rest.size() > 2 && rest.front() == '"' && rest.back() == '"';
    const std::string target(angle || quote ? trim(rest.substr(1, rest.size() - 2)) : "");
    if (target.empty())
        return fail(directive.place, directive.line, "malformed #include",
                    "write #include <feature> or #include \"folder/piece.glsl\"");
    return Include{angle, target, directive.place, directive.line};
}

Diagnostic ended_extension(const std::string& name, const Extension& begun, const Extension& ended) {
    return warning(ended.place, ended.line,
                   fmt::format("'{}' stays on: {}:{} says {}, and a stage says so once, in front of all code",
                               name, begun.place.file, begun.place.line, begun.behavior),
                   "leave one of the two out");
}

bool add_extension(Extensions& extensions, const Directive& directive, bool is_certain) {
    const std::vector<std::string_view> tokens = tokens_of(directive.rest);
    // They ask for what the composer has done.
    constexpr std::array<std::string_view, 3> includes = {"GL_GOOGLE_include_directive",
                                                          "GL_GOOGLE_cpp_style_line_directive",
                                                          "GL_ARB_shading_language_include"};
    if (tokens.size() == 3 && std::ranges::count(includes, tokens[0]) > 0) return true;
    if (tokens.size() != 3 || !are(tokens, {"name", ":", "name"})) return false;
    const bool is_weaker = tokens[2] == "require" && !is_certain;
    return add_extension(extensions, std::string(tokens[0]),
                         {is_weaker ? "enable" : std::string(tokens[2]), directive.place, directive.line});
}

std::vector<StatedBinding> stated_bindings(std::string_view code) {
    return bindings_of(tokens_of(code));
}

std::set<std::string_view> identifiers_of(std::string_view code) {
    std::set<std::string_view> identifiers;
    for (const std::string_view token : tokens_of(code))
        if (is_identifier_start(token.front())) identifiers.insert(token);
    return identifiers;
}

Result<ScannedPiece> scan_piece(const std::string& text, const std::string& path, const std::string& file) {
    GOBO_TRY(CleanText clean, clean_text(text, path));
    const std::string lines = unix_lines(file);
    return Scanner(lines, path, std::move(clean)).run();
}

}  // namespace gobo
