#include "compose/scan_piece.hpp"

#include <algorithm>
#include <optional>
#include <regex>

#include <fmt/format.h>

#include "core/text.hpp"

namespace gobo {
namespace {

/// glslang 12 recurses once per bracket and overflows its stack on hostile input; no real shader comes
/// near.
constexpr int kDeepestNesting = 200;

/// The line that a character of the text stands on.
int line_at(std::string_view text, std::size_t at) {
    return 1 +
           static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

bool is_blank(std::string_view text) {
    return text.find_first_not_of(" \t\r") == std::string_view::npos;
}

/// Whether what stands before a place on its line, or on one that '\\' joins to it, is more than blanks.
bool follows_code(std::string_view text, std::size_t at) {
    const std::size_t start = text.substr(0, at).rfind('\n') + 1;
    return !is_blank(text.substr(start, at - start)) || text.substr(0, start).ends_with("\\\n") ||
           text.substr(0, start).ends_with("\\\r\n");
}

/// The text with blanks for the characters of comments, so that lines and columns stay true. `unclosed` is
/// where a comment without an end starts.
std::string without_comments(std::string_view text, std::size_t& unclosed) {
    std::string bare(text);
    unclosed = std::string::npos;
    const auto blank = [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (bare[i] != '\n') bare[i] = ' ';
        return end;
    };
    for (std::size_t i = 0; i + 1 < bare.size();) {
        if (bare[i] == '/' && bare[i + 1] == '/') {
            i = blank(i, std::min(bare.find_first_of("\r\n", i), bare.size()));
        } else if (bare[i] == '/' && bare[i + 1] == '*') {
            const std::size_t close = bare.find("*/", i + 2);
            if (close == std::string::npos) unclosed = i;
            const std::size_t end = close == std::string::npos ? bare.size() : close + 2;
            const std::string_view rest = std::string_view(bare).substr(end, bare.find('\n', end) - end);
            // A directive goes on behind a comment that spans lines: without one it would end early.
            const bool joins = bare.find('\n', i) < end && follows_code(bare, i) && !is_blank(rest);
            i = joins ? blank(i + 2, end - 2) + 2 : blank(i, end);
        } else {
            ++i;
        }
    }
    return bare;
}

/// Whether readers of GLSL may disagree on what is a comment: since 4.2 and ES 3.0 a '\\' joins two lines
/// even there, and glslang takes what stands in double quotes for a string.
bool are_disputed(std::string_view text, std::string_view bare) {
    if (bare.find('"') != std::string_view::npos) return true;
    for (std::size_t at = text.find('\\'); at < text.size(); at = text.find('\\', at + 1)) {
        const bool joins = text.substr(at + 1).starts_with('\n') || text.substr(at + 1).starts_with("\r\n");
        const bool parts = at > 0 && (text[at - 1] == '/' || text[at - 1] == '*');
        if (joins && (parts || bare[at] != '\\')) return true;
    }
    return false;
}

std::set<std::string, std::less<>> identifiers_of(std::string_view bare) {
    std::set<std::string, std::less<>> found;
    for (auto at = bare.begin(); at != bare.end();) {
        const auto start = std::find_if(at, bare.end(), is_identifier_part);
        at = std::find_if_not(start, bare.end(), is_identifier_part);
        if (start != at && is_identifier_start(*start)) found.emplace(start, at);
    }
    return found;
}

/// The bindings stated by BLOCK(3, Fog) and SAMPLER(2, sampler2D) shadowMap.
std::map<std::string, int> bindings_of(const std::string& bare) {
    static const std::regex block(R"(\bBLOCK\s*\(\s*(\d{1,6})\s*,\s*(\w+)\s*\))");
    static const std::regex sampler(R"(\bSAMPLER\s*\(\s*(\d{1,6})\s*,\s*\w+\s*\)\s*(\w+))");
    std::map<std::string, int> bindings;
    for (const std::regex* pattern : {&block, &sampler}) {
        for (std::sregex_iterator at(bare.begin(), bare.end(), *pattern), end; at != end; ++at)
            bindings[(*at)[2]] = std::stoi((*at)[1]);
    }
    return bindings;
}

/// A warning for each uniform block that states no layout: drivers then choose one, and no offset known
/// before holds.
Diagnostics unstated_layouts(const std::string& bare, std::string_view text, const std::string& path) {
    static const std::regex by_default(R"(layout\s*\([^)]*\bstd140\b[^)]*\)\s*uniform\s*;)");
    static const std::regex block(R"((layout\s*\(([^)]*)\)\s*)?\buniform\s+(\w+)\s*\{)");
    Diagnostics warnings;
    if (std::regex_search(bare, by_default)) return warnings;
    for (std::sregex_iterator at(bare.begin(), bare.end(), block), end; at != end; ++at) {
        if ((*at)[2].str().find("std140") != std::string::npos) continue;
        const int line = line_at(bare, static_cast<std::size_t>(at->position(3)));
        const auto warning =
            fail({path, line, 0}, line_of(text, line),
                 fmt::format("the uniform block '{}' does not state std140: drivers lay it out as they like",
                             (*at)[3].str()),
                 "write layout(std140) before uniform, or ask the driver for every offset");
        warnings.push_back(warning.value().front());
        warnings.back().severity = Severity::warning;
    }
    return warnings;
}

/// "fog" or "guards/unit_vector".
bool is_feature_or_part(std::string_view target) {
    const auto slash = target.find('/');
    return is_identifier(target.substr(0, slash)) &&
           (slash == std::string_view::npos || is_identifier(target.substr(slash + 1)));
}

/// Blanks left where a comment or directive stood would only swell the header. Behind a '\\' one stays: it
/// keeps the next line from being joined to this one.
std::string without_trailing_blanks(std::string_view text) {
    std::string result;
    result.reserve(text.size() + 1);
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        const std::string_view kept = line.substr(0, line.find_last_not_of(" \t\r") + 1);
        const std::string_view rest = line.substr(kept.size());
        result += kept;
        result += kept.ends_with('\\') && !rest.empty() && rest != "\r" ? " \n" : "\n";
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return result;
}

Result<Include> parse_include(std::string_view rest, const Place& place, std::string_view shown) {
    const bool angle = rest.size() > 2 && rest.front() == '<' && rest.back() == '>';
    const bool quote = rest.size() > 2 && rest.front() == '"' && rest.back() == '"';
    const std::string target(angle || quote ? trim(rest.substr(1, rest.size() - 2)) : "");
    if (target.empty() || (angle && !is_feature_or_part(target)))
        return fail(place, shown, "malformed #include",
                    "write #include <feature> or #include \"folder/piece.glsl\"");
    return Include{angle, target, place, std::string(shown)};
}

/// Walks over the lines of one file, collecting into `result`.
class Scanner {
  public:
    Scanner(std::string text, const std::string& path)
        : path_(path), bare_(without_comments(text, unclosed_)) {
        result_.text = std::move(text);
    }

    Result<ScannedPiece> run() {
        if (unclosed_ != std::string::npos) {
            const int line = line_at(result_.text, unclosed_);
            return fail({path_, line, 0}, line_of(result_.text, line), "a comment has no end",
                        "close it with */");
        }
        std::size_t start = 0;
        for (int number = 1; start < bare_.size(); ++number) {
            const std::size_t end = std::min(bare_.find('\n', start), bare_.size());
            GOBO_TRY_DO(scan_line(number, start, end));
            start = end + 1;
        }
        result_.identifiers = identifiers_of(bare_);
        if (bare_.find("BLOCK") != std::string::npos || bare_.find("SAMPLER") != std::string::npos)
            result_.bindings = bindings_of(bare_);
        result_.warnings = unstated_layouts(bare_, result_.text, path_);
        result_.code = without_trailing_blanks(are_disputed(result_.text, bare_) ? result_.text : bare_);
        result_.text = without_trailing_blanks(result_.text);
        return std::move(result_);
    }

  private:
    Result<void> scan_line(int number, std::size_t start, std::size_t end) {
        const std::string_view bare = std::string_view(bare_).substr(start, end - start);
        const std::string shown(line_of(std::string_view(result_.text).substr(start, end - start), 1));
        const std::size_t first = std::min(bare.find_first_not_of(" \t"), bare.size());
        const Place place{path_, number, static_cast<int>(first) + 1};
        std::string_view rest = trim(bare);
        std::string_view directive;  // the word after `#`
        if (rest.starts_with('#')) {
            rest = trim(rest.substr(1));
            directive = {rest.begin(), std::find_if_not(rest.begin(), rest.end(), is_identifier_part)};
            rest = trim(rest.substr(directive.size()));
        }
        for (const char c : bare) {
            if (c == '(' || c == '[' || c == '{') ++depth_;
            if (c == ')' || c == ']' || c == '}') depth_ = std::max(0, depth_ - 1);
            if (depth_ <= kDeepestNesting) continue;
            return fail({path_, number, 0}, shown.substr(0, 80),
                        fmt::format("brackets are nested more than {} deep", kDeepestNesting),
                        "split the expression or the function");
        }
        if (directive == "version") result_.version = rest;
        if (directive == "include") {
            if (seen_code_)
                return fail(place, shown, "#include after code",
                            "includes stand at the top of a piece, after comments only");
            GOBO_TRY(Include include, parse_include(rest, place, shown));
            result_.includes.push_back(std::move(include));
        }
        if (directive == "version" || directive == "include") {
            for (std::size_t i = start; i < end; ++i)
                if (bare_[i] != ' ') result_.text[i] = bare_[i] = ' ';
        } else if (!trim(bare).empty() && directive != "extension") {
            seen_code_ = true;
        }
        return {};
    }

    std::string path_;
    std::size_t unclosed_ = 0;
    std::string bare_;
    ScannedPiece result_;
    bool seen_code_ = false;
    int depth_ = 0;
};

}  // namespace

Result<ScannedPiece> scan_piece(std::string text, const std::string& path) {
    if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
    if (const auto nul = text.find('\0'); nul != std::string::npos)
        return fail({path, line_at(text, nul), 0}, "", "holds a NUL byte and is not text",
                    "name a GLSL file");
    return Scanner(std::move(text), path).run();
}

}  // namespace gobo
