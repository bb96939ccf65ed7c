#include "validate/language_rules.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <set>

#include <fmt/format.h>

#include "compose/language_names.hpp"
#include "compose/tokens.hpp"
#include "core/text.hpp"
#include "validate/block_rules.hpp"
#include "validate/function_rules.hpp"
#include "validate/plain_messages.hpp"
#include "validate/token_check.hpp"

namespace gobo {
namespace {

constexpr std::array<std::string_view, 3> kPrecisions = {"highp", "mediump", "lowp"};
constexpr std::array<std::string_view, 3> kAuxiliary = {"centroid", "sample", "patch"};
constexpr std::array<std::string_view, 3> kMultisampled = {"image2DMS", "iimage2DMS", "uimage2DMS"};
constexpr std::array<std::string_view, 4> kRemoved = {"gl_MaxTextureUnits", "gl_MaxTextureCoords",
                                                      "gl_MaxClipPlanes", "gl_MaxLights"};
constexpr std::array<std::string_view, 9> kPrimitives = {
    "points",     "lines",          "lines_adjacency", "triangles", "triangles_adjacency",
    "line_strip", "triangle_strip", "quads",           "isolines"};
/// Layouts of which drivers let the last count.
constexpr std::array<std::string_view, 7> kRepeatable = {"std140",    "std430",       "shared", "packed",
                                                         "row_major", "column_major", "binding"};
/// What `compatibility = true` makes of gl_FragColor and gl_FragData.
constexpr std::array<std::string_view, 2> kOldOutputs = {"legacy_FragColor", "legacy_FragData"};

/// "4.20", or "ES 3.10".
std::string version_text(int number, bool es) {
    return fmt::format("{}{}.{:02}", es ? "ES " : "", number / 100, number % 100);
}

class LanguageCheck : TokenCheck {
  public:
    LanguageCheck(StageKind kind, const std::vector<const Piece*>& pieces, const ActiveText& text,
                  Dialect dialect)
        : TokenCheck(text),
          kind_(kind),
          is_shipped_(!is_spirv(dialect)),
          pieces_(pieces),
          prologue_(pieces.front()->text),
          version_(version_of(prologue_)) {}

    Diagnostics run() {
        check_extensions();
        for (const ActiveDirective& directive : text_.directives) check_directive(directive);
        for (std::size_t i = 0; i < tokens_.size(); ++i) {
            if (tokens_[i].is_noted) check_token(i);
        }
        if (version_.number >= 130 && old_outputs_.size() > 1)  // before, glslang minds it
            found_.push_back(color_and_data_message(pieces_));
        check_declarations();
        append(found_, check_functions(text_, prologue_));
        append(found_, check_blocks(kind_, text_, version_, is_shipped_));
        return std::move(found_);
    }

  private:
    void refuse(const Piece& piece, int line, std::string message, std::string help) {
        say(Severity::error, piece, line, std::move(message), std::move(help));
    }
    void warn(const Piece& piece, int line, std::string message, std::string help) {
        say(Severity::warning, piece, line, std::move(message), std::move(help));
    }
    using TokenCheck::refuse;

    [[nodiscard]] bool is_before(int desktop) const { return !version_.es && version_.number < desktop; }
    /// Whether the prologue states an extension; of `_geometry_shader`, any that ends so.
    [[nodiscard]] bool has_extension(std::string_view name) const {
        const std::string wanted = fmt::format("{}{} :", name.starts_with('_') ? "" : "#extension ", name);
        return prologue_.find(wanted) != std::string::npos;
    }

    /// Each `#extension NAME : require` of the prologue.
    void check_extensions() {
        int line = 0;
        for (const std::string& text : split(prologue_, '\n')) {
            ++line;
            if (text.find("require") == std::string::npos) continue;
            const std::vector<std::string_view> tokens = tokens_of(text);
            if (tokens.size() != 5 || tokens[1] != "extension" || tokens[4] != "require") continue;
            const ExtensionOf owner = owner_of_extension(tokens[2]);
            const bool is_other = owner == (version_.es ? ExtensionOf::desktop : ExtensionOf::es);
            if (owner == ExtensionOf::vulkan || owner == ExtensionOf::tools || is_other)
                refuse(
                    *pieces_.front(), line,
                    fmt::format("no OpenGL{} has {}: it is {}", version_.es ? " ES" : "", tokens[2],
                                is_other                       ? version_.es ? "OpenGL's" : "OpenGL ES's"
                                : owner == ExtensionOf::vulkan ? "Vulkan's"
                                                               : "for tools"),
                    "leave it out, or state it where its macro is defined: #ifdef " + std::string(tokens[2]));
            else if (may_be_lacking(tokens[2]))
                warn(*pieces_.front(), line,
                     fmt::format("not every driver has {}, and none that lacks it compiles this stage",
                                 tokens[2]),
                     fmt::format("use it where its macro is defined: #ifdef {0} and #extension {0} : enable",
                                 tokens[2]));
        }
    }

    void check_directive(const ActiveDirective& directive) {
        const auto& [word, rest, at, number] = directive;
        const Piece& piece = *at;
        if (word == "define" || word == "undef") {
            const std::string_view name = macro_name(rest);
            if (is_any(name, {"__LINE__", "__FILE__", "__VERSION__", "defined"}))
                refuse(piece, number, fmt::format("'{}' is GLSL's own", name), "choose another name");
            if (std::ranges::count(tokens_of(rest), "#") > 0)
                refuse(piece, number,
                       fmt::format("the macro '{}' makes a string by '#', which GLSL has not", name),
                       "take the '#' out: GLSL has no strings, only ## to join names");
        }
        const std::vector<std::string_view> tokens = tokens_of(rest);
        if (is_any(word, {"define", "if", "elif"}))
            for (const std::string_view token : tokens) check_own_line(token, piece, number);
        constexpr std::array<std::string_view, 5> invariant_all = {"STDGL", "invariant", "(", "all", ")"};
        if (word == "pragma" && kind_ == StageKind::fragment &&
            version_.number >= (version_.es ? 300 : 120) && std::ranges::equal(tokens, invariant_all))
            refuse(piece, number, "a fragment stage cannot state #pragma STDGL invariant(all)",
                   "state it in the vertex stage alone");
    }

    /// Pieces are joined before a driver counts their lines.
    void check_own_line(std::string_view token, const Piece& piece, int line) {
        if (is_shipped_ && token == "__LINE__")
            warn(piece, line, "'__LINE__' is another number to each driver",
                 "write the number itself: files are joined, and drivers count the lines in their own ways");
    }

    void check_token(std::size_t index) {
        const Token& token = tokens_[index];
        if (is_any(token.text, kOldOutputs) && !token.piece->is_shipped) old_outputs_.insert(token.text);
        if (token.text == "struct") {
            structs_.insert(at(index + 1));
            if (at(index + 1).starts_with("gl_"))
                refuse(token,
                       fmt::format("the struct '{}' begins with gl_, as GLSL's own names do", at(index + 1)),
                       "choose another name");
        }
        check_own_line(token.text, *token.piece, token.line);
        if (token.text == "layout" && at(index + 1) == "(") return check_layout(index + 2);
        // A member may be called so.
        if (const NameSince* since = name_since(token.text); since != nullptr && at(index - 1) != ".")
            check_since(token, *since, fmt::format("'{}'", token.text));
        if (is_any(token.text, kPrecisions)) check_precision(index);
        if (is_any(token.text, kAuxiliary)) check_auxiliary(index);
        // No words of the language's own (GLSL 4.60, 3.6), but Mesa's parser keeps them.
        const bool is_kept = token.text == "packed"      ? version_.number >= (version_.es ? 300 : 140)
                             : token.text == "row_major" ? !version_.es && version_.number >= 130
                                                         : is_before(420) && version_.number >= 130 &&
                                                               is_any(token.text, kMultisampled);
        if (is_kept && index > 0 && is_name(index - 1) && !is_macro(index - 1) && !is_macro(index))
            refuse(token,
                   fmt::format("'{}' is no name to every driver: some keep it for the language", token.text),
                   "choose another name");
        if (token.text == "attribute" && is_before(120) && !is_macro(index)) check_attribute(index);
        const bool is_removed = is_any(token.text, kRemoved);
        if (is_removed && version_.number >= 140 && version_.profile != "compatibility")
            refuse(token,
                   fmt::format("'{}' went with GLSL 1.40, but for the compatibility profile", token.text),
                   "take it out");
    }

    /// `attribute ivec4 bones;`: GLSL has it from 1.30 on (4.3.4), drivers from 1.20 on.
    void check_attribute(std::size_t index) {
        const std::string_view type = at(index + (is_any(at(index + 1), kPrecisions) ? 2 : 1));
        if (type == "int" || type.starts_with("ivec"))
            refuse(index, fmt::format("a vertex input of type {} came with GLSL 1.20", type),
                   "make it a float, or state #version 120");
    }

    void check_since(const Token& token, const NameSince& since, const std::string& what) {
        const int first = version_.es ? since.es : since.desktop;
        if (version_.number >= first) return;
        if (first == kVulkan)
            return refuse(token, fmt::format("OpenGL's GLSL has no {}: it is Vulkan's", what),
                          "write it as OpenGL has it, or take it out");
        std::string wanted;
        for (const std::string& extension : split(since.extensions, ' ')) {
            if (extension.empty()) continue;
            if (has_extension(extension)) return;
            const bool is_of_es = extension.starts_with('_') || !extension.starts_with("GL_ARB_");
            const bool fits = extension.starts_with('_') || is_of_es == version_.es;
            if (fits && wanted.empty())
                wanted = fmt::format("#extension {}{} : require",
                                     !extension.starts_with('_') ? ""
                                     : version_.es               ? "GL_EXT"
                                                                 : "GL_ARB",
                                     extension);
        }
        std::string help =
            first < kNever ? fmt::format("state #version {}{}", first, version_.es ? " es" : "") : "";
        if (!wanted.empty()) help += (help.empty() ? "state " : ", or ") + wanted;
        if (help.empty()) help = "take it out";
        refuse(token,
               first < kNever ? fmt::format("{} came with GLSL {}", what, version_text(first, version_.es))
                              : fmt::format("GLSL {}has no {}", version_.es ? "ES " : "", what),
               std::move(help));
    }

    /// The qualifiers of a layout(...), which begin at the token.
    void check_layout(std::size_t begin) {
        const bool has_order = is_before(420) && !has_extension("GL_ARB_shading_language_420pack");
        if (begin > 2 && has_order && is_any(at(begin - 3), {"in", "out", "uniform"}))
            refuse(tokens_[begin - 2],
                   fmt::format("'{}' stands before 'layout', which came with GLSL 4.20", at(begin - 3)),
                   fmt::format("write layout(...) {}", at(begin - 3)));
        std::size_t end = begin;
        for (int depth = 1; end < tokens_.size(); ++end) {
            if (at(end) == "(") ++depth;
            if (at(end) == ")" && --depth == 0) break;
        }
        bool counts_atomically = false;  // there `offset` is as old as the counter
        for (std::size_t i = end; i < tokens_.size() && !is_any(at(i), {";", "{"}); ++i)
            counts_atomically = counts_atomically || at(i) == "atomic_uint";
        const auto value = [&](std::string_view qualifier) {
            for (std::size_t i = begin; i + 2 < end; ++i)
                if (at(i) == qualifier && at(i + 1) == "=") return at(i + 2);
            return std::string_view();
        };
        int stream = 0;
        std::from_chars(value("stream").data(), value("stream").data() + value("stream").size(), stream);
        if (stream > 3)
            refuse(tokens_[begin],
                   fmt::format("stream {}: OpenGL guarantees only 4, from 0 (MAX_VERTEX_STREAMS)", stream),
                   "state a stream from 0 to 3");
        if (value("index") == "1" && !is_any(value("location"), {"", "0"}))
            refuse(tokens_[begin],
                   "an output of index 1 stands at location 0 alone (MAX_DUAL_SOURCE_DRAW_BUFFERS)",
                   "blend by two sources in the first output");
        check_repeated(begin, end);
        for (std::size_t i = begin; i < end; ++i) {
            const bool is_qualifier = i == begin || at(i - 1) == ",";
            const NameSince* since = is_qualifier ? layout_since(at(i)) : nullptr;
            if (since != nullptr && !(at(i) == "offset" && counts_atomically))
                check_since(tokens_[i], *since, fmt::format("layout({})", at(i)));
        }
    }

    /// `layout(points, triangles) in;` and, before GLSL 4.40, `layout(location = 1, location = 2)`.
    void check_repeated(std::size_t begin, std::size_t end) {
        std::string_view primitive;
        std::set<std::string_view> stated;
        const bool may_repeat =
            (!version_.es && version_.number >= 440) || has_extension("GL_ARB_enhanced_layouts");
        for (std::size_t i = begin; i < end; ++i) {
            if (!is_name(i) || (i != begin && at(i - 1) != ",")) continue;
            if (is_any(at(i), kPrimitives) && is_any(primitive, kPrimitives) && primitive != at(i))
                refuse(tokens_[i], fmt::format("layout states both {} and {}", primitive, at(i)),
                       "state one of them");
            if (is_any(at(i), kPrimitives)) primitive = at(i);
            if (!stated.insert(at(i)).second && !may_repeat && !is_any(at(i), kRepeatable))
                refuse(tokens_[i], fmt::format("layout states '{}' twice", at(i)), "state it once");
        }
        const bool may_follow =
            version_.es ? version_.number >= 310
                        : version_.number >= 420 || has_extension("GL_ARB_shading_language_420pack");
        if (at(end + 1) == "layout" && !may_follow)
            refuse(tokens_[end + 1],
                   fmt::format("one layout stands behind another, which came with GLSL {}",
                               version_text(version_.es ? 310 : 420, version_.es)),
                   "write them as one");
    }

    void check_precision(std::size_t index) {
        const std::string_view next = at(index + 1);
        if (is_any(next, kPrecisions) && !is_macro(index) && !is_macro(index + 1))
            refuse(tokens_[index + 1], fmt::format("'{}' stands behind '{}'", next, at(index)),
                   "state one precision");
        if (is_any(next, {"bool", "bvec2", "bvec3", "bvec4", "double"}) || next.starts_with("dvec") ||
            next.starts_with("dmat"))
            refuse(tokens_[index], fmt::format("'{}' before {}, which has no precision", at(index), next),
                   fmt::format("take '{}' out", at(index)));
        const bool is_storage = is_any(
            next, {"const", "in", "out", "inout", "uniform", "varying", "attribute", "centroid", "flat"});
        if (is_storage && is_before(420) && !has_extension("GL_ARB_shading_language_420pack"))
            refuse(tokens_[index],
                   fmt::format("'{}' stands before '{}', which came with GLSL 4.20", at(index), next),
                   fmt::format("write {} {}", next, at(index)));
    }

    /// `centroid layout(location = 0) out`: their order was fixed before GLSL 4.20.
    void check_auxiliary(std::size_t index) {
        const std::string_view next = at(index + 1);
        if (is_before(420) && !has_extension("GL_ARB_shading_language_420pack") &&
            is_any(next,
                   {"layout", "flat", "smooth", "noperspective", "invariant", "highp", "mediump", "lowp"}))
            refuse(tokens_[index],
                   fmt::format("'{}' stands before '{}', which came with GLSL 4.20", at(index), next),
                   fmt::format("write {} right before in or out", at(index)));
    }

    /// What is declared at the top and within functions.
    void check_declarations() {
        int depth = 0;  // of braces
        std::size_t begin = 0;
        for (std::size_t i = 0; i < tokens_.size(); ++i) {
            if (is_name(i) && version_.number >= 130) continue;  // names matter to the oldest alone
            const std::string_view token = at(i);
            const char mark = token.size() == 1 ? token.front() : ' ';
            if (mark == '{') ++depth;
            if (mark == '}') --depth;
            if (is_before(120)) check_constant(i);
            if (is_before(130) && token == "invariant" && at(i + 1).starts_with("gl_Frag"))
                refuse(tokens_[i], fmt::format("'{}' cannot be invariant before GLSL 1.30", at(i + 1)),
                       "take it out: what a vertex stage writes can be invariant");
            if (depth != 0) continue;
            if (mark == '[') check_distances(i);
            if (mark == ';') check_statement(begin, i);
            if (mark == ';' || mark == '}') begin = i + 1;
        }
    }

    /// What ends with a `;` outside of functions and blocks.
    void check_statement(std::size_t begin, std::size_t end) {
        check_local_size(begin, end);
        check_old_qualifier(begin, end);
        check_counter(begin, end);
        if (version_.es) check_image(begin, end);
        check_interpolation(begin, end);
        if (end == begin + 1) check_lone(begin);
    }

    /// `in;` alone: only a layout(...) makes a default of it (GLSL 4.60, 4.4).
    void check_lone(std::size_t qualifier) {
        if (is_any(at(qualifier), {"in", "out", "uniform", "buffer", "shared"}))
            refuse(tokens_[qualifier], fmt::format("'{};' declares nothing", at(qualifier)),
                   "take it out, or write a layout before it or a declaration behind it");
    }

    /// What calls a function is no constant in GLSL 1.10: `const float k = sin(0.5);` and `float
    /// a[int(sin(0.5))];`.
    void check_constant(std::size_t index) {
        const bool is_size =
            at(index) == "[" && is_name(index - 1) && index > 1 && is_constructor(at(index - 2));
        if (at(index) != "const" && !is_size) return;
        bool is_value = is_size;
        for (std::size_t i = index; i < tokens_.size() && !is_any(at(i), {";", "{", is_size ? "]" : ";"});
             ++i) {
            is_value = is_value || at(i) == "=";
            if (!is_value || !is_name(i) || at(i + 1) != "(" || is_constructor(at(i)) || is_macro(i) ||
                structs_.contains(at(i)))
                continue;
            return refuse(tokens_[i], fmt::format("'{}()' gives no constant before GLSL 1.20", at(i)),
                          "state #version 120, or write its value");
        }
    }
    static bool is_constructor(std::string_view type) {
        return is_any(type, {"float", "int", "bool"}) || type.starts_with("vec") || type.starts_with("mat") ||
               type.starts_with("ivec") || type.starts_with("bvec");
    }

    /// `layout(local_size_x = 8) in;`, of which all that there are agree (GLSL 4.60, 4.4.1.4).
    void check_local_size(std::size_t begin, std::size_t end) {
        if (kind_ != StageKind::compute || at(begin) != "layout" || at(end - 1) != "in") return;
        std::array<std::string_view, 3> size = {"1", "1", "1"};
        bool states_size = false;
        for (std::size_t i = begin; i + 2 < end; ++i)
            for (std::size_t axis = 0; axis < size.size(); ++axis)
                if (at(i) == fmt::format("local_size_{}", "xyz"[axis]) && at(i + 1) == "=") {
                    // The value of a macro or of a sum is glslang's to compare.
                    const bool is_number =
                        at(i + 2).find_first_not_of("0123456789") == std::string_view::npos;
                    if (!is_number || !is_any(at(i + 3), {",", ")"})) return;
                    size[axis] = at(i + 2);
                    states_size = true;
                }
        if (!states_size) return;
        if (!local_size_.front().empty() && local_size_ != size)
            refuse(tokens_[begin],
                   fmt::format("the local size is {} x {} x {} here, but {} x {} x {} above", size[0],
                               size[1], size[2], local_size_[0], local_size_[1], local_size_[2]),
                   "state all of it once");
        local_size_ = size;
    }

    /// `layout(location = 0) attribute vec3 position;`
    void check_old_qualifier(std::size_t begin, std::size_t end) {
        if (at(begin) != "layout") return;
        for (std::size_t i = begin; i < end; ++i)
            if (is_any(at(i), {"attribute", "varying"}) && !is_macro(i) &&
                version_.profile != "compatibility")
                refuse(
                    tokens_[begin], fmt::format("layout() stands before '{}', which takes none", at(i)),
                    fmt::format("write {} for it", kind_ == StageKind::vertex && at(i) == "attribute" ? "in"
                                                   : kind_ == StageKind::vertex                       ? "out"
                                                                                : "in"));
    }

    /// `flat vec3 v;`, which is neither in nor out.
    void check_interpolation(std::size_t begin, std::size_t end) {
        std::size_t qualifier = end;
        int brackets = 0;
        for (std::size_t i = begin; i < end; ++i) {
            if (at(i) == "(") ++brackets;
            if (at(i) == ")") --brackets;
            if (brackets == 0 && (at(i) == "{" || at(i) == "=")) break;
            if (is_macro(i)) return;  // it may stand for what is looked for
            if (is_any(at(i), {"in", "out", "varying", "invariant", "precise"})) return;
            if (is_any(at(i), {"flat", "smooth", "noperspective", "centroid"}) && i + 2 < end &&
                is_name(i + 1))
                qualifier = std::min(qualifier, i);
        }
        if (qualifier < end && version_.number >= 130)
            refuse(tokens_[qualifier],
                   fmt::format("'{}' stands before what is neither an input nor an output", at(qualifier)),
                   "write in or out behind it, or take it out");
    }

    /// In OpenGL ES each image states its format (GLSL ES 3.10, 4.4.7).
    void check_image(std::size_t begin, std::size_t end) {
        bool is_uniform = false;
        for (std::size_t i = begin; i < end; ++i) {
            const std::string_view token = at(i);
            const bool is_format =
                token.size() > 1 && token[0] == 'r' && token.find_first_of("0123456789") < 5;
            if (is_format || is_macro(i)) return;
            is_uniform = is_uniform || token == "uniform";
            const bool is_image =
                token.starts_with("image") || token.starts_with("iimage") || token.starts_with("uimage");
            if (is_uniform && is_image && is_name(i + 1))
                return refuse(tokens_[i], fmt::format("the image '{}' states no format", at(i + 1)),
                              "write it, as in layout(rgba8)");
        }
    }

    /// `float gl_ClipDistance[6]` beside `float gl_CullDistance[6]`: together they have a limit.
    void check_distances(std::size_t bracket) {
        if (bracket < 2 || at(bracket - 2) != "float" || at(bracket + 2) != "]" ||
            !is_any(at(bracket - 1), {"gl_ClipDistance", "gl_CullDistance"}))
            return;
        int size = 0;
        std::from_chars(at(bracket + 1).data(), at(bracket + 1).data() + at(bracket + 1).size(), size);
        distances_[at(bracket - 1)] = std::min(size, 100);
        int all = 0;
        for (const auto& [name, count] : distances_) all += count;
        constexpr int kGuaranteed = 8;
        if (all > kGuaranteed)
            refuse(tokens_[bracket],
                   fmt::format("clip and cull distances: {}, OpenGL guarantees only {} "
                               "(MAX_COMBINED_CLIP_AND_CULL_DISTANCES)",
                               all, kGuaranteed),
                   "declare fewer");
    }

    /// `uniform atomic_uint NAME;` from one token to another.
    void check_counter(std::size_t begin, std::size_t end) {
        bool is_uniform = false;
        for (std::size_t i = begin; i < end; ++i) {
            if (at(i) == "binding" || is_macro(i)) return;
            is_uniform = is_uniform || at(i) == "uniform";
            if (at(i) == "atomic_uint" && is_uniform && is_name(i + 1))
                refuse(tokens_[i], fmt::format("the atomic counter '{}' states no binding", at(i + 1)),
                       "write layout(binding = 0) before uniform");
        }
    }

    StageKind kind_;
    bool is_shipped_;  ///< drivers get the text
    const std::vector<const Piece*>& pieces_;
    const std::string& prologue_;
    GlslVersion version_;
    std::map<std::string_view, int> distances_;  ///< sizes of gl_ClipDistance and gl_CullDistance
    std::set<std::string_view> structs_;
    std::set<std::string_view> old_outputs_;
    std::array<std::string_view, 3> local_size_;  ///< that stands above
};

}  // namespace

bool is_noted(std::string_view name) {
    return is_any(name, {"layout", "packed", "row_major", "struct", "__LINE__", "attribute"}) ||
           is_any(name, kPrecisions) || is_any(name, kAuxiliary) || is_any(name, kMultisampled) ||
           is_any(name, kRemoved) || is_any(name, kOldOutputs) || name_since(name) != nullptr;
}

Diagnostics check_language(StageKind kind, const std::vector<const Piece*>& pieces, const ActiveText& text,
                           Dialect dialect) {
    return LanguageCheck(kind, pieces, text, dialect).run();
}

}  // namespace gobo
