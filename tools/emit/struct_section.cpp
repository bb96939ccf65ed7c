// Uniform blocks as C++ structs, and the checks of their ranges.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "emit/sections.hpp"

namespace gobo {
namespace {

/// std140 rounds structs and whole blocks up to the size of a vec4.
constexpr int kStructAlignment = 16;

int rounded_up(int size) {
    return (size + kStructAlignment - 1) / kStructAlignment * kStructAlignment;
}

/// A member as C++ names it, and its members where it is a struct.
struct NamedMember {
    Member member;
    std::string identifier;
    std::vector<NamedMember> members;
};

/// A C++ struct under way: members so far, and where they end.
struct StructText {
    std::string name;
    CppScope scope = {};
    std::string members = {};
    std::string assertions = {};
    std::vector<NamedMember> named = {};
    int end = 0;
    int paddings = 0;

    void pad_to(int offset) {
        if (offset <= end) return;
        const std::string padding = scope.claim(fmt::format("padding{}", paddings++));
        members += fmt::format("    std::byte {}[{}];\n", padding, offset - end);
        end = offset;
    }

    void add(const Member& member, const CppMemberType& type, const std::string& comment,
             std::vector<NamedMember> parts) {
        pad_to(member.offset);
        const std::string identifier = scope.claim(cpp_identifier(member.name));
        members += fmt::format("    {} {}{};{}\n", type.type, identifier, type.extents, comment);
        assertions +=
            fmt::format("static_assert(offsetof({}, {}) == {});\n", name, identifier, member.offset);
        end += type.size;
        named.push_back({member, identifier, std::move(parts)});
    }

    void close(int size) {
        pad_to(size);
        assertions += fmt::format("static_assert(sizeof({}) == {});\n", name, size);
    }
};

/// A struct that was written, by what it mirrors.
struct WrittenStruct {
    std::string glsl_name;
    std::vector<Member> members;
    int size = 0;
    std::string cpp_name;
    std::vector<NamedMember> named;
};

const Domain* domain_of(const std::vector<Domain>& domains, const std::string& path) {
    const auto without_indices = [](std::string_view name) {
        std::string result;
        int depth = 0;
        for (const char character : name) {
            if (character == '[') ++depth;
            if (depth == 0) result += character;
            if (character == ']') --depth;
        }
        return result;
    };
    const std::string wanted = without_indices(path);
    const auto domain = std::find_if(domains.begin(), domains.end(), [&](const Domain& other) {
        return without_indices(other.name) == wanted;
    });
    return domain == domains.end() ? nullptr : &*domain;
}

/// bytes(count), where the block ends in an array: one buffer then serves every extent of it.
std::string bytes_function(const Block& block) {
    if (block.members.empty() || block.members.back().array.empty()) return {};
    const Member& last = block.members.back();
    return fmt::format(
        "\n    /// Bytes of the block with `count` elements in `{}`, from 0: what a shader with that count "
        "needs.\n"
        "    static constexpr std::size_t bytes(int count) {{\n"
        "        return ({} + static_cast<std::size_t>(count) * {} + {}) / {} * {};\n"
        "    }}\n",
        last.name, last.offset, last.array_stride, kStructAlignment - 1, kStructAlignment, kStructAlignment);
}

class StructWriter {
  public:
    StructWriter(const std::vector<Domain>& domains, const TextTemplate& structure, CppScope& scope)
        : domains_(domains), structure_(structure), scope_(scope) {}

    /// Adds the block's struct to text(), behind those of its members.
    Result<StructText> write_block(const Block& block) {
        StructText structure{scope_.claim(cpp_identifier(block.name), "_block")};
        structure.scope = CppScope({structure.name, "binding", "size", "bytes"});
        GOBO_TRY_DO(add_members(structure, block.members, block.name));
        const int size = rounded_up(std::max(structure.end, block.size));
        structure.close(size);
        GOBO_TRY_DO(append(structure, fmt::format("The uniform block {}.", block.name),
                           fmt::format("\n    static constexpr int binding = {};\n"
                                       "    static constexpr std::size_t size = {};\n{}",
                                       block.binding, size, bytes_function(block))));
        return structure;
    }

    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    /// The struct that a member's type is, written now unless it has been.
    Result<WrittenStruct> struct_of(const Member& member, const std::string& path) {
        for (const WrittenStruct& other : written_)
            if (other.glsl_name == member.type && other.members == member.members) return other;
        StructText structure{scope_.claim(cpp_identifier(member.type), "_struct")};
        structure.scope.claim(structure.name);
        GOBO_TRY_DO(add_members(structure, member.members, path));
        // Rounded up as std140 does; a tighter layout shows in the stride of an array.
        int size = rounded_up(structure.end);
        const int stride = element_stride(member);
        if (stride >= structure.end && stride < size) size = stride;
        structure.close(size);
        GOBO_TRY_DO(append(structure, fmt::format("The shaders' struct {}.", member.type), {}));
        return written_.emplace_back(
            WrittenStruct{member.type, member.members, size, structure.name, std::move(structure.named)});
    }

    Result<void> add_members(StructText& structure, const std::vector<Member>& members,
                             const std::string& path) {
        const auto unsupported = [&](const Member& member) {
            return fail(Fault::input,
                        fmt::format("no C++ struct has the layout of '{}.{}'", path, member.name),
                        "declare the block with layout(std140)");
        };
        std::vector<std::pair<CppMemberType, std::vector<NamedMember>>> types;
        for (const Member& member : members) {
            std::optional<CppMemberType> type = cpp_type_of(member);
            std::vector<NamedMember> parts;
            if (!member.members.empty()) {
                GOBO_TRY(WrittenStruct inner, struct_of(member, path + "." + member.name));
                type = cpp_array_of(inner.cpp_name, inner.size, member);
                parts = std::move(inner.named);
            }
            if (!type) return unsupported(member);
            // A member may not have the name of a type that its struct uses.
            structure.scope.claim(type->type);
            types.emplace_back(std::move(*type), std::move(parts));
        }
        for (std::size_t i = 0; i < members.size(); ++i) {
            if (members[i].offset < structure.end) return unsupported(members[i]);
            const std::string domain = domain_text(domains_, path + "." + members[i].name);
            structure.add(members[i], types[i].first, domain.empty() ? "" : "  ///< " + domain,
                          std::move(types[i].second));
        }
        return {};
    }

    Result<void> append(const StructText& structure, const std::string& description,
                        const std::string& constants) {
        GOBO_TRY(const std::string text, fill(structure_, {{"description", description},
                                                           {"name", structure.name},
                                                           {"members", structure.members},
                                                           {"constants", constants},
                                                           {"assertions", structure.assertions}}));
        text_ += text;
        return {};
    }

    const std::vector<Domain>& domains_;
    const TextTemplate& structure_;
    CppScope& scope_;
    std::vector<WrittenStruct> written_;
    std::string text_;
};

/// Where a member stands: for messages, in C++, and within which loops.
struct Spot {
    std::string path;        ///< "PointLights.lights[].color"
    std::string expression;  ///< "block.lights[i0].color"
    std::vector<std::string> indices;

    [[nodiscard]] std::string indent() const { return std::string(4 * (indices.size() + 1), ' '); }
};

/// A call for the member's numbers; nothing where the family declares no range for them.
std::string number_check(const Spot& spot, const std::vector<Domain>& domains) {
    const Domain* domain = domain_of(domains, spot.path);
    if (domain == nullptr) return {};
    const std::string text = (domain->of_length ? "a " : "") + domain_text(domains, spot.path);
    return fmt::format(
        "{0}gobo::runtime::check_member(found, {1}, {{{2}}}, {3},\n{0}                            "
        "{{{4}, {5}, {6}, {{{7}}}, {8}}});\n",
        spot.indent(), cpp_literal(spot.path), fmt::join(spot.indices, ", "), spot.expression, domain->low,
        domain->high, domain->of_length, fmt::join(domain->also, ", "), cpp_literal(text));
}

/// The checks of a member, within a loop for each extent of its array; `count` is the outermost loop's bound
/// where it is given.
std::string member_checks(const NamedMember& named, const Spot& parent, const std::vector<Domain>& domains,
                          const std::string& count) {
    Spot spot{parent.path + "." + named.member.name, parent.expression + "." + named.identifier,
              parent.indices};
    std::string head;
    std::string tail;
    for (std::size_t extent = 0; extent < named.member.array.size(); ++extent) {
        const std::string index = fmt::format("i{}", spot.indices.size());
        const std::string bound =
            extent == 0 && !count.empty() ? count : std::to_string(named.member.array[extent]);
        head += fmt::format("{0}for (int {1} = 0; {1} < {2}; ++{1}) {{\n", spot.indent(), index, bound);
        tail = spot.indent() + "}\n" + tail;
        spot.path += "[]";
        spot.expression += "[" + index + "]";
        spot.indices.push_back(index);
    }
    std::string body = named.members.empty() ? number_check(spot, domains) : "";
    for (const NamedMember& part : named.members) body += member_checks(part, spot, domains, "");
    return body.empty() ? body : head + body + tail;
}

std::string block_check(const Block& block, const StructText& structure, const std::vector<Domain>& domains) {
    const Member* counted =
        block.members.empty() || block.members.back().array.empty() ? nullptr : &block.members.back();
    std::string body;
    for (const NamedMember& named : structure.named) {
        const bool is_counted = counted != nullptr && &named == &structure.named.back();
        body += member_checks(named, {block.name, "block", {}}, domains, is_counted ? "count" : "");
    }
    return fmt::format(
        "/// What of the block {} lies outside its ranges{}; empty where nothing does.\n"
        "[[nodiscard]] inline std::vector<gobo::OutOfRange> check({}const {}& block{}) {{\n"
        "    std::vector<gobo::OutOfRange> found;\n"
        "{}"
        "    return found;\n"
        "}}\n\n",
        block.name,
        counted == nullptr ? "" : fmt::format(", as far as the first `count` of `{}`", counted->name),
        body.empty() ? "[[maybe_unused]] " : "", structure.name,
        counted == nullptr ? "" : fmt::format(", [[maybe_unused]] int count = {}", counted->array.front()),
        body);
}

}  // namespace

std::string domain_text(const std::vector<Domain>& domains, const std::string& path) {
    const Domain* domain = domain_of(domains, path);
    if (domain == nullptr) return {};
    std::string text =
        fmt::format("{}[{}, {}]", domain->of_length ? "length in " : "", domain->low, domain->high);
    for (const double value : domain->also) text += fmt::format(", or {}", value);
    if (!domain->last.empty()) text += fmt::format("; last [{}, {}]", domain->last[0], domain->last[1]);
    return text;
}

Result<void> block_section(const std::vector<Block>& blocks, const std::vector<Domain>& domains,
                           const TextTemplate& structure, CppScope& scope, TemplateValues& values) {
    StructWriter writer(domains, structure, scope);
    std::string& checks = values["checks"] = "";
    for (const Block& block : blocks) {
        GOBO_TRY(const StructText written, writer.write_block(block));
        checks += block_check(block, written, domains);
    }
    values["structs"] = writer.text();
    return {};
}

}  // namespace gobo
