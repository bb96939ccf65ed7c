#include "validate/stated.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "compose/dialect.hpp"
#include "core/text.hpp"
#include "validate/missing_built_ins.hpp"

namespace gobo {
namespace {

/// Tokens from `begin` to before `end`.
struct Range {
    std::size_t begin;
    std::size_t end;
};

class Statements {
  public:
    Statements(const ActiveText& text, DefaultPrecisions precisions)
        : text_(text), precisions_(std::move(precisions)) {}

    Stated run() {
        std::size_t begin = 0;
        for (std::size_t i = 0; i < text_.tokens.size(); ++i) {
            if (at(i) == "{") {
                const std::size_t end = closing(i);
                const Range head{begin, i};
                if (is_block(head)) add_block(head, {i + 1, end});
                if (i > begin + 1 && at(i - 2) == "struct") {
                    structs_.insert(at(i - 1));
                    add_struct({i + 1, end}, std::string(at(i - 1)));
                }
                if (i > begin && at(i - 1) == ")") {
                    add_reads(head, {i + 1, end});
                    begin = end + 1;  // a function's body ends its statement
                }
                i = end;
            } else if (at(i) == ";") {
                const Range whole{begin, i};
                if (i > begin + 1 && at(begin) == "layout" && at(i - 2) == ")")
                    set_default(at(i - 1), packing_in(whole));
                const bool is_varying = has(whole, "in") || has(whole, "out");
                if (is_varying || has(whole, "varying") || has(whole, "uniform"))
                    add_names(whole, has(whole, "smooth") ? "smooth" : "", "");
                if (is_varying && !has(whole, "location")) add_names(whole, "free", "");
                if (has(whole, "in"))
                    for (const std::size_t name : names_in(whole))
                        inputs_[at(name)].push_back(std::string(at(name)));
                if (is_varying) add_precisions(whole, "");
                if (is_varying) add_arrays_of_structs(whole);
                if (has(whole, "uniform")) add_format(whole);
                if (i == begin + 3 && at(begin) == "precision" && !precisions_.empty())
                    precisions_[at(i - 1)] = at(i - 2);
                begin = i + 1;
            }
        }
        return std::move(stated_);
    }

  private:
    [[nodiscard]] std::string_view at(std::size_t index) const { return text_.at(index); }
    [[nodiscard]] std::size_t find(Range range, std::string_view word) const {
        for (std::size_t i = range.begin; i < range.end; ++i)
            if (at(i) == word) return i;
        return range.end;
    }
    [[nodiscard]] bool has(Range range, std::string_view word) const { return find(range, word) < range.end; }
    /// The `}` of a `{`.
    [[nodiscard]] std::size_t closing(std::size_t brace) const {
        int depth = 0;
        std::size_t i = brace;
        for (; i < text_.tokens.size(); ++i) {
            if (at(i) == "{") ++depth;
            if (at(i) == "}" && --depth == 0) break;
        }
        return i;
    }
    [[nodiscard]] bool is_block(Range head) const {
        return head.end > head.begin && at(head.end - 1) != ")" && !has(head, "struct") &&
               (has(head, "in") || has(head, "out") || has(head, "uniform") || has(head, "buffer"));
    }

    void add(const std::string& path, std::string_view word) {
        if (word.empty()) return;
        std::string& words = stated_[path];
        if (words.find(word) == std::string::npos) words += (words.empty() ? "" : " ") + std::string(word);
    }

    /// The names that a declaration declares: `vec3 a, b[2] = ...;`, not what stands in brackets.
    [[nodiscard]] std::vector<std::size_t> names_in(Range range) const {
        std::vector<std::size_t> names;
        if (has(range, "{")) return names;  // with a struct of its own
        int brackets = 0;
        for (std::size_t i = range.begin; i < range.end; ++i) {
            const std::string_view token = at(i);
            if (text_.is_macro(i)) break;
            if (token == "(" || token == "[") ++brackets;
            if (token == ")" || token == "]") --brackets;
            const std::string_view next = i + 1 < range.end ? at(i + 1) : ";";
            if (brackets == 0 && is_identifier(token) &&
                (next == ";" || next == "," || next == "[" || next == "="))
                names.push_back(i);
        }
        return names;
    }
    [[nodiscard]] std::string path_of(std::size_t name, std::string_view block) const {
        return block.empty() ? std::string(at(name)) : fmt::format("{}.{}", block, at(name));
    }
    void add_names(Range range, std::string_view word, std::string_view block) {
        for (const std::size_t i : names_in(range)) {
            const std::string path = path_of(i, block);
            add(path, word);
            if (at(i + 1) == "[" && at(i + 2) == "]" && at(i + 3) != "=") add(path, "[]");
        }
    }

    /// Marks the inputs that a function mentions, called or not. A name that it declares itself is not one.
    void add_reads(Range head, Range body) {
        if (inputs_.empty()) return;
        std::set<std::string_view> mentioned;
        std::set<std::string_view> own;
        int brackets = 0;
        for (std::size_t i = head.begin; i < body.end; ++i) {
            const std::string_view token = at(i);
            if (token == "(" || token == "[") ++brackets;
            if (token == ")" || token == "]") --brackets;
            if (!inputs_.contains(token) || at(i - 1) == ".") continue;
            const std::string_view before = at(i - 1);
            const bool is_declared = i < body.begin || (is_identifier(before) && before != "return") ||
                                     before == "]" || (before == "," && brackets == 0);
            (is_declared ? own : mentioned).insert(token);
        }
        for (const std::string_view name : mentioned)
            if (!own.contains(name))
                for (const std::string& path : inputs_.find(name)->second) add(path, "read");
    }

    void add_struct(Range body, const std::string& name) {
        std::size_t begin = body.begin;
        for (std::size_t i = body.begin; i < body.end; ++i) {
            if (at(i) != ";") continue;
            const Range member{begin, i};
            add_names(member, precision_in(member), name);
            add_precisions(member, name);
            begin = i + 1;
        }
        const auto first = stated_.lower_bound(name + ".");
        if (first != stated_.end() && first->first.starts_with(name + ".")) precise_.insert(name);
    }
    /// That of a member, by default too; empty where none is stated.
    [[nodiscard]] std::string_view precision_in(Range member) const {
        for (std::size_t i = member.begin; i < member.end; ++i) {
            const std::string_view token = at(i);
            if (token == "highp" || token == "mediump" || token == "lowp") return token;
            const bool is_float = token == "float" || token.starts_with("vec") || token.starts_with("mat");
            const bool is_int =
                token == "int" || token == "uint" || token.starts_with("ivec") || token.starts_with("uvec");
            if (!is_float && !is_int) continue;
            const auto by_default = precisions_.find(is_float ? "float" : "int");
            return by_default == precisions_.end() ? std::string_view() : by_default->second;
        }
        return {};
    }
    void add_format(Range range) {
        for (std::size_t i = range.begin; i < range.end; ++i)
            if (is_image_format(at(i)))
                for (const std::size_t name : names_in(range)) add(std::string(at(name)) + ".format", at(i));
    }
    /// Of what is of a struct, the precisions of its members.
    void add_precisions(Range range, std::string_view block) {
        if (precise_.empty()) return;
        for (std::size_t type = range.begin; type < range.end; ++type) {
            if (!precise_.contains(at(type))) continue;
            const std::string from = std::string(at(type)) + ".";
            for (const std::size_t name : names_in({type + 1, range.end}))
                for (auto of = stated_.lower_bound(from); of != stated_.end() && of->first.starts_with(from);
                     ++of)
                    add(fmt::format("{}.{}", path_of(name, block), of->first.substr(from.size())),
                        of->second);
            return;
        }
    }

    /// Linkers compare the names of structs that arrays are of.
    void add_arrays_of_structs(Range range) {
        for (std::size_t type = range.begin; type < range.end; ++type)
            if (structs_.contains(at(type)))
                for (const std::size_t name : names_in({type + 1, range.end}))
                    if (at(name + 1) == "[") add(std::string(at(name)), fmt::format("struct:{}", at(type)));
    }

    /// The layout that a block states; empty where it states none.
    [[nodiscard]] std::string_view packing_in(Range head) const {
        for (const std::string_view packing : {"std140", "std430", "shared", "packed"})
            if (has(head, packing)) return packing;
        return {};
    }
    /// `layout(std140) uniform;`
    void set_default(std::string_view storage, std::string_view packing) {
        if (!packing.empty() && (storage == "uniform" || storage == "buffer")) defaults_[storage] = packing;
    }
    void add_packing(Range head, const std::string& block) {
        const std::string_view storage = has(head, "uniform") ? "uniform" : "buffer";
        if (!has(head, storage)) return;
        for (std::size_t i = head.begin; i < head.end; ++i)
            if (text_.is_macro(i)) return;
        const std::string_view own = packing_in(head);
        const auto by_default = defaults_.find(storage);
        add(block, !own.empty() ? own : by_default != defaults_.end() ? by_default->second : "shared");
        if (!has(head, "binding")) add(block, "free");
    }

    void add_block(Range head, Range body) {
        const std::string block(at(head.end - 1));
        add_packing(head, block);
        const auto location_in = [&](Range range) {
            const std::size_t word = find(range, "location");
            return word < range.end ? at(word + 2) : std::string_view();
        };
        const std::string_view location = location_in(head);
        const std::string_view instance = at(body.end + 1);
        const bool has_instance = is_identifier(instance);
        std::size_t begin = body.begin;
        for (std::size_t i = body.begin; i < body.end; ++i) {
            if (at(i) != ";") continue;
            const Range member{begin, i};
            const bool is_other = has(member, "flat") || has(member, "noperspective");
            if (has(member, "smooth") || (has(head, "smooth") && !is_other))
                add_names(member, "smooth", block);
            if (has(member, "offset") || has(member, "align") || has(head, "align"))
                add_names(member, "offset", block);
            if (has(head, "in") || has(head, "out")) {
                add_precisions(member, block);
                if (at(body.end + 2) == "[") add_names(member, precision_in(member), block);
            }
            if (has(head, "in"))
                for (const std::size_t name : names_in(member))
                    inputs_[has_instance ? instance : at(name)].push_back(path_of(name, block));
            const std::string_view own = location_in(member);
            if (!own.empty() && location.empty()) add_names(member, "located", block);
            if (begin == body.begin && !location.empty() && !own.empty() && own != location)
                add_names(member, "apart", block);
            begin = i + 1;
        }
    }

    const ActiveText& text_;
    std::map<std::string_view, std::string_view> defaults_;  ///< layouts of "uniform" and "buffer"
    DefaultPrecisions precisions_;
    std::set<std::string_view> structs_;
    std::set<std::string, std::less<>> precise_;  ///< structs of whose members precisions are known
    /// By the name under which a stage mentions them, an input or a block's instance.
    std::map<std::string_view, std::vector<std::string>> inputs_;
    Stated stated_;
};

void set_precisions(const std::string& type, std::vector<Member>& members, const Stated& stated) {
    for (Member& member : members) {
        const auto found = stated.find(fmt::format("{}.{}", type, member.name));
        if (found != stated.end() && member.usage.precision.empty()) member.usage.precision = found->second;
        set_precisions(member.type, member.members, stated);
    }
}

}  // namespace

DefaultPrecisions default_precisions(StageKind kind, std::string_view prologue) {
    if (!version_of(prologue).es || prologue.find("precision ") != std::string_view::npos) return {};
    if (kind == StageKind::fragment) return {{"int", "mediump"}};
    return {{"float", "highp"}, {"int", "highp"}};
}

Stated stated_in(const ActiveText& text, DefaultPrecisions precisions) {
    return Statements(text, std::move(precisions)).run();
}

void set_stated(Interface& interface, const Stated& stated) {
    if (stated.empty()) return;
    const auto set = [&](std::string_view path, Usage& usage, int* place = nullptr) {
        const auto found = stated.find(path);
        if (found == stated.end()) return;
        usage.stated = found->second;
        const std::size_t free = usage.stated.find("free");
        if (free == std::string::npos) return;
        usage.stated.erase(free > 0 ? free - 1 : 0, free > 0 ? 5 : 4);
        if (place != nullptr) *place = -1;
    };
    for (auto* const variables : {&interface.inputs, &interface.outputs})
        for (Variable& variable : *variables) {
            const std::string path = without_indices(variable.name);
            const std::size_t dot = path.find('.');
            const bool is_of_block = variable.whole == Whole::block && dot != std::string::npos;
            const std::size_t member = is_of_block ? path.find('.', dot + 1) : dot;  // of a struct
            set(path.substr(0, member), variable.usage, &variable.location);
            if (const auto found = stated.find(path); found != stated.end() && member != std::string::npos)
                variable.usage.precision = found->second;
        }
    for (auto* const blocks : {&interface.blocks, &interface.storage_blocks})
        for (Block& block : *blocks) {
            set(root_of(block.name), block.usage, &block.binding);
            for (Member& member : block.members)
                set(fmt::format("{}.{}", root_of(block.name), member.name), member.usage);
        }
    for (Uniform& uniform : interface.uniforms) {
        set(uniform.name, uniform.usage);
        set_precisions(uniform.type, uniform.members, stated);
    }
    for (Sampler& sampler : interface.samplers) {
        set(sampler.name, sampler.usage);
        const auto format = stated.find(sampler.name + ".format");
        if (format != stated.end() && sampler.usage.access.empty()) sampler.usage.access = format->second;
    }
}

}  // namespace gobo
