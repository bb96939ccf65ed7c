#include "validate/block_rules.hpp"

#include <fmt/format.h>

#include "validate/token_check.hpp"

namespace gobo {
namespace {

class BlockCheck : TokenCheck {
  public:
    BlockCheck(StageKind kind, const ActiveText& text, const GlslVersion& version, bool is_shipped)
        : TokenCheck(text), kind_(kind), version_(version), is_shipped_(is_shipped) {}

    Diagnostics run() {
        int depth = 0;  // of braces
        std::size_t begin = 0;
        for (std::size_t i = 0; i < tokens_.size(); ++i) {
            const std::string_view token = at(i);
            if (token == "{" && ++depth == 1 && i > 0 && is_name(i - 1)) check_block(begin, i);
            if (token == "}" && depth > 0) --depth;  // a macro may hold the other
            if (depth != 0) continue;
            if (token == ";") check_default(begin, i);
            if (token == ";" || token == "}") begin = i + 1;
        }
        return std::move(found_);
    }

  private:
    [[nodiscard]] bool has_macro(std::size_t begin, std::size_t end) const {
        while (begin < end && !is_macro(begin)) ++begin;
        return begin < end;
    }
    [[nodiscard]] std::size_t storage(std::size_t begin, std::size_t end) const {
        return find(begin, end, {"in", "out", "uniform", "buffer"});
    }

    /// `layout(std140) uniform;`, or `uniform layout(std140);`, which Mesa's parser does not read.
    void check_default(std::size_t begin, std::size_t end) {
        const std::size_t word = storage(begin, end);
        if (word == end) return;
        const bool is_behind = at(word + 1) == "layout" && closing(word + 2, end) + 1 == end;
        if (!is_behind && word + 1 != end) return;
        const bool may_state_layout = has_macro(begin, end);
        const bool states_std140 = find(begin, end, {"std140"}) < end || may_state_layout;
        if (at(word) == "uniform" && states_std140) is_std140_stated_ = true;
        if (states_std140 || find(begin, end, {"std430"}) < end) has_layout_ = true;
        if (is_shipped_ && is_behind && !may_state_layout)
            refuse(word,
                   fmt::format("'{}' stands before its layout, where not every driver reads it", at(word)),
                   fmt::format("write layout(...) {};", at(word)));
    }

    /// A block whose `{` is at `brace`; its declaration begins at `begin`.
    void check_block(std::size_t begin, std::size_t brace) {
        const std::size_t word = storage(begin, brace);
        if (word == brace || at(word + 1) == "struct") return;
        const std::string_view name = at(brace - 1);
        check_located_array(begin, brace);
        if (is_shipped_ && !has_macro(begin, brace)) check_order(begin, word, brace);
        const std::size_t old = find(brace, closing(brace, tokens_.size()), {"varying", "attribute"});
        if (is_any(at(old), {"varying", "attribute"}) && !is_macro(old))
            refuse(old, fmt::format("a member of a block cannot be '{}'", at(old)), "take it out");
        if (!is_any(at(word), {"uniform", "buffer"})) return;
        const auto is = [&](std::string_view qualifier) { return find(begin, brace, {qualifier}) < brace; };
        const bool is_buffer = at(word) == "buffer";
        const bool may_state_layout = has_macro(begin, brace);
        if (is_shipped_ && !is_buffer && !is("std140") && !is_std140_stated_ && !may_state_layout)
            say(Severity::warning, *tokens_[brace - 1].piece, tokens_[brace - 1].line,
                fmt::format("the uniform block '{}' does not state std140: drivers lay it out as they like",
                            name),
                "write layout(std140) before uniform, or ask the driver for every offset");
        const bool has_layout = has_layout_ || is("std140") || is("std430") || may_state_layout;
        if (is_buffer && is("readonly") && is("writeonly"))
            refuse(brace, fmt::format("the buffer block '{}' is both readonly and writeonly", name),
                   "take one out; a member that only its length is asked of may have both");
        std::size_t end = brace + 1;
        for (; end < tokens_.size() && at(end) != "}"; ++end) {
            if (!has_layout && is_any(at(end), {"offset", "align"}) && at(end + 1) == "=")
                refuse(end,
                       fmt::format("'{}' in the block '{}', which states neither std140 nor std430", at(end),
                                   name),
                       "write layout(std140) before the block");
            check_member(end);
            const bool is_unsized = at(end) == "[" && at(end + 1) == "]";
            if (!is_unsized || !is_buffer) continue;
            const std::size_t last = find(end, tokens_.size(), {";", "}"});
            if (at(last + 1) != "}" && at(last) == ";")
                refuse(end, "only the last member of a buffer block may be an array without a size",
                       "give it a size, or move it to the end");
        }
        if (is_name(end + 1) && at(end + 2) == "[" && at(end + 3) == "]")
            refuse(end + 1, fmt::format("the array of blocks '{}' has no size", at(end + 1)), "give it one");
        if (!version_.es && version_.number == 140 && is_name(end + 1) && !is_macro(end + 1))
            refuse(end + 1,
                   fmt::format("the block's name for its instance, '{}', came with GLSL 1.50", at(end + 1)),
                   "state #version 150, or take it out and name its members alone");
    }

    /// `buffer readonly B {`: GLSL lets qualifiers stand in any order from 4.20 on (4.60, 4.11), but Mesa's
    /// parser reads a block's before the word for its storage alone, and no precision.
    void check_order(std::size_t begin, std::size_t word, std::size_t brace) {
        const std::string_view storage_word = at(word);
        if (word + 2 < brace)
            refuse(word + 1,
                   fmt::format("'{}' stands behind '{}' in the block '{}', where not every driver reads it",
                               at(word + 1), storage_word, at(brace - 1)),
                   fmt::format("write it before '{}'", storage_word));
        const std::size_t precision = find(begin, word, {"highp", "mediump", "lowp"});
        if (precision < word)
            refuse(precision,
                   fmt::format("'{}' stands before the block '{}', which not every driver reads",
                               at(precision), at(brace - 1)),
                   "write it before its members");
    }

    /// `layout(shared) vec4 tint;`: glslang takes it, of those that lay out a block.
    void check_member(std::size_t word) {
        if (at(word) != "layout") return;
        const std::size_t end = closing(word + 1, tokens_.size());
        const std::size_t packing = find(word, end, {"shared", "packed"});
        if (packing < end)
            refuse(packing, fmt::format("a member of a block cannot state '{}'", at(packing)),
                   "state it before the block");
    }

    /// `layout(location = 1) out B { vec4 tint; } b[2];`, but where each vertex has its element: drivers know
    /// no locations of its members.
    void check_located_array(std::size_t begin, std::size_t brace) {
        const bool is_of_program =
            (find(begin, brace, {"out"}) < brace && kind_ != StageKind::tess_control) ||
            (find(begin, brace, {"in"}) < brace && kind_ == StageKind::fragment);
        const std::size_t location = find(begin, brace, {"location"});
        if (!is_of_program || location == brace) return;
        const std::size_t end = find(brace, tokens_.size(), {"}"});
        if (is_name(end + 1) && at(end + 2) == "[")
            refuse(location, fmt::format("the array of blocks '{}' states a location", at(end + 1)),
                   "take it out, or put the array into the block");
    }

    StageKind kind_;
    GlslVersion version_;
    bool is_shipped_;                ///< drivers get the text
    bool has_layout_ = false;        ///< `layout(std430) buffer;` stands above, or what is like it
    bool is_std140_stated_ = false;  ///< `layout(std140) uniform;` stands above
};

}  // namespace

Diagnostics check_blocks(StageKind kind, const ActiveText& text, const GlslVersion& version,
                         bool is_shipped) {
    return BlockCheck(kind, text, version, is_shipped).run();
}

}  // namespace gobo
