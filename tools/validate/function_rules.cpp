#include "validate/function_rules.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "compose/tokens.hpp"
#include "validate/token_check.hpp"

namespace gobo {
namespace {

/// `isampler2DArray` by "sampler".
bool is_texture(std::string_view type, std::string_view kind) {
    if (type.starts_with('u') || (type.starts_with('i') && !type.starts_with("image"))) type.remove_prefix(1);
    if (!type.starts_with(kind)) return false;
    type.remove_prefix(kind.size());
    for (const std::string_view shape : {"1D", "2D", "3D", "Cube", "Buffer", "External"})
        if (type.starts_with(shape)) return true;
    return false;
}

bool is_image(std::string_view type) {
    return is_texture(type, "image") || type == "atomic_uint";
}

/// Types whose values no variable can hold but a uniform.
bool is_opaque(std::string_view type) {
    return is_texture(type, "sampler") || is_image(type);
}

class FunctionCheck : TokenCheck {
  public:
    FunctionCheck(const ActiveText& text, const std::string& prologue)
        : TokenCheck(text),
          version_(version_of(prologue)),
          is_bindless_(prologue.find("GL_ARB_bindless_texture") != std::string::npos) {}

    Diagnostics run() {
        int depth = 0;  // of braces
        std::size_t begin = 0;
        std::size_t directive = 0;
        for (std::size_t i = 0; i < tokens_.size(); ++i) {
            for (; directive < text_.directives.size() && text_.tokens_before[directive] <= i; ++directive)
                if (depth > 0 || !is_end(i)) check_pragma(text_.directives[directive], depth > 0);
            const std::string_view token = at(i);
            if (token == "{") ++depth;
            if (token == "}") --depth;
            if (token == "struct" && at(i + 2) == "{") check_struct(i + 1);
            if (depth > 0 && token == "(" && !version_.es && version_.number >= 120) check_prototype(i);
            if (depth != 0) continue;
            if (token == "(" && is_name(i - 1)) check_head(begin, i);
            if (token == ";" || token == "}") begin = i + 1;
        }
        return std::move(found_);
    }

  private:
    /// Whether a declaration or a function ends before the token, or a macro, which may hold its end.
    [[nodiscard]] bool is_end(std::size_t index) const {
        if (index == 0 || is_any(at(index - 1), {";", "}"}) || is_macro(index - 1)) return true;
        if (at(index - 1) != ")") return false;
        std::size_t open = index - 1;
        for (int depth = 0; open > 0; --open) {
            if (at(open) == ")") ++depth;
            if (at(open) == "(" && --depth == 0) break;
        }
        return open > 0 && is_macro(open - 1);
    }

    /// `#pragma optimize(off)`: before functions or behind them alone (GLSL 4.60, 3.3), to drivers also that
    /// of invariant outputs.
    void check_pragma(const ActiveDirective& directive, bool is_within) {
        const std::vector<std::string_view> words = tokens_of(directive.rest);
        constexpr std::array<std::string_view, 5> invariant_all = {"STDGL", "invariant", "(", "all", ")"};
        if (directive.word != "pragma" || words.empty() ||
            !(is_any(words.front(), {"optimize", "debug"}) || std::ranges::equal(words, invariant_all)))
            return;
        say(Severity::error, *directive.piece, directive.line,
            fmt::format("#pragma {} stands within a {}", words.front(),
                        is_within ? "function" : "declaration"),
            "write it before, or leave it out");
    }

    /// By the name of a struct, which stands before its members.
    void check_struct(std::size_t name) {
        const std::size_t end = closing(name + 1, tokens_.size());
        for (std::size_t i = name + 2; i < end; ++i) {
            if (!is_name(i + 1)) continue;
            if (is_opaque(at(i)) || opaque_structs_.contains(at(i))) opaque_structs_.insert(at(name));
            if (is_image(at(i)) && !is_bindless_)
                refuse(i, fmt::format("the struct '{}' holds '{}' of type {}", at(name), at(i + 1), at(i)),
                       "declare it outside: only samplers can be members");
            if (at(i + 1).starts_with("gl_") && !tokens_[i].piece->is_shipped)
                refuse(i + 1,
                       fmt::format("the member '{}' begins with gl_, as GLSL's own names do", at(i + 1)),
                       "choose another name");
        }
    }

    /// The `(` of a function's head; its declaration begins at `begin`, behind the `}` of a struct that it is
    /// to return.
    void check_head(std::size_t begin, std::size_t bracket) {
        const std::string_view name = at(bracket - 1);
        const std::size_t end = closing(bracket, tokens_.size());
        for (std::size_t i = bracket; i < end; ++i)
            if (at(i) == "void" && !is_macro(bracket - 1) &&
                (at(i + 1) == "," || (i + 1 == end && i > bracket + 1)))
                refuse(i, fmt::format("'void' stands beside other parameters of '{}'", name), "take it out");
        bool has_struct =
            begin > 0 && at(begin - 1) == "}" && bracket == begin + 1 && name != "layout" && !is_macro(begin);
        for (std::size_t i = bracket; i < end; ++i)
            has_struct = has_struct || (at(i) == "struct" && at(i + 2) == "{");
        if (has_struct)
            refuse(bracket, fmt::format("a struct is declared in the head of the function '{}'", name),
                   "declare it before");
        if (name == "layout" || is_macro(bracket - 1)) return;
        const bool has_type = bracket > 1 && (is_name(bracket - 2) || at(bracket - 2) == "]");
        if (name.starts_with("gl_") && has_type)
            refuse(bracket - 1,
                   fmt::format("the function '{}' begins with gl_, as GLSL's own names do", name),
                   "choose another name");
        std::string_view direction;
        for (std::size_t i = bracket + 1; i < end; ++i) {
            if (at(i) == ",") direction = {};
            if (at(i) == "layout" && at(i + 1) == "(")
                refuse(i, fmt::format("a parameter of the function '{}' states a layout", name),
                       "take it out");
            if (!is_any(at(i), {"in", "out", "inout"})) continue;
            if (!direction.empty())
                refuse(i,
                       fmt::format("a parameter of the function '{}' is both '{}' and '{}'", name, direction,
                                   at(i)),
                       "write inout for both, or one of them");
            direction = at(i);
        }
        if (!is_bindless_) check_opaque(bracket, end);
    }

    /// Samplers, or structs with them, that a function would give back.
    void check_opaque(std::size_t bracket, std::size_t end) {
        const std::string_view name = at(bracket - 1);
        std::size_t type = bracket - 1;  // behind it; then before the sizes of an array
        while (type > 1 && at(type - 1) == "]") {
            while (type > 1 && at(type - 1) != "[") --type;
            --type;
        }
        const std::string_view result = type > 0 ? at(type - 1) : "";
        if (opaque_structs_.contains(result) || is_opaque(result))
            refuse(type - 1,
                   fmt::format("the function '{}' returns '{}', which {} a sampler or an image", name, result,
                               is_opaque(result) ? "is" : "holds"),
                   "return what is read from it");
        for (std::size_t i = bracket + 1; i < end; ++i)
            if (is_any(at(i), {"out", "inout"}) && opaque_structs_.contains(at(i + 1)))
                refuse(i,
                       fmt::format("the function '{}' has '{}' as {}, which holds a sampler or an image",
                                   name, at(i + 1), at(i)),
                       "make it 'in'");
    }

    /// `float f(float x);` within a function, by its `(`.
    void check_prototype(std::size_t bracket) {
        const std::size_t name = bracket - 1;
        if (!is_name(name - 1) || !is_name(name)) return;
        if (is_any(at(name - 1), {"return", "else", "do", "case"}) ||
            is_any(at(name), {"if", "for", "while", "switch", "layout", "return"}) || is_macro(name - 1) ||
            is_macro(name))
            return;
        refuse(name, fmt::format("the function '{}' is declared within another", at(name)),
               "declare it before, outside of any function");
    }

    GlslVersion version_;
    bool is_bindless_;
    std::set<std::string_view> opaque_structs_;
};

}  // namespace

Diagnostics check_functions(const ActiveText& text, const std::string& prologue) {
    return FunctionCheck(text, prologue).run();
}

}  // namespace gobo
