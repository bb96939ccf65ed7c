#include "validate/function_rules.hpp"

#include <fmt/format.h>

#include "compose/tokens.hpp"
#include "validate/token_check.hpp"

namespace gobo {
namespace {

/// Types whose values no variable can hold but a uniform.
bool is_opaque(std::string_view type) {
    for (const std::string_view kind : {"sampler", "image", "texture"})
        for (const std::string_view number : {"", "i", "u"})
            if (type.starts_with(number) && type.substr(number.size()).starts_with(kind)) return true;
    return type == "atomic_uint";
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
                if (depth > 0) check_pragma(text_.directives[directive]);
            const std::string_view token = at(i);
            if (token == "{") ++depth;
            if (token == "}") --depth;
            if (token == "struct" && at(i + 2) == "{") add_struct(i + 1);
            if (depth > 0 && token == "(" && !version_.es && version_.number >= 120) check_prototype(i);
            if (depth != 0) continue;
            if (token == "(" && is_name(i - 1)) check_head(begin, i);
            if (token == ";" || token == "}") begin = i + 1;
        }
        return std::move(found_);
    }

  private:
    /// `#pragma optimize(off)`: before functions or behind them alone (GLSL 4.60, 3.3).
    void check_pragma(const ActiveDirective& directive) {
        const std::vector<std::string_view> words = tokens_of(directive.rest);
        if (directive.word != "pragma" || words.empty() || !is_any(words.front(), {"optimize", "debug"}))
            return;
        say(Severity::error, *directive.piece, directive.line,
            fmt::format("#pragma {} stands within a function", words.front()),
            "write it before the function, or leave it out");
    }

    void add_struct(std::size_t name) {
        const std::size_t end = closing(name + 1, tokens_.size());
        for (std::size_t i = name + 2; i < end; ++i)
            if (is_name(i + 1) && (is_opaque(at(i)) || opaque_structs_.contains(at(i))))
                opaque_structs_.insert(at(name));
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
        for (std::size_t i = bracket + 1; i < end; ++i)
            if (at(i) == "layout" && at(i + 1) == "(")
                refuse(i, fmt::format("a parameter of the function '{}' states a layout", name),
                       "take it out");
        if (!is_bindless_) check_opaque(bracket, end);
    }

    /// Structs with samplers that a function would give back.
    void check_opaque(std::size_t bracket, std::size_t end) {
        const std::string_view name = at(bracket - 1);
        if (bracket > 1 && opaque_structs_.contains(at(bracket - 2)))
            refuse(bracket - 2,
                   fmt::format("the function '{}' returns '{}', which holds a sampler or an image", name,
                               at(bracket - 2)),
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
