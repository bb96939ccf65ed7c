#include "emit/struct_section.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "emit/std140_type.hpp"

namespace gobo {
namespace {

/// std140 rounds structs and whole blocks up to the size of a vec4.
constexpr int struct_alignment = 16;

int rounded_up(int size) {
    return (size + struct_alignment - 1) / struct_alignment * struct_alignment;
}

std::string without_indices(std::string_view path) {
    std::string result;
    int depth = 0;
    for (const char character : path) {
        if (character == '[') ++depth;
        if (depth == 0) result += character;
        if (character == ']') --depth;
    }
    return result;
}

/// A C++ struct under way: members so far, and where they end.
struct StructText {
    std::string name;
    std::string members;
    std::string assertions;
    CppScope scope;
    std::vector<NamedMember> named;
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

class StructWriter {
  public:
    StructWriter(const std::vector<Domain>& domains, const TextTemplate& structure, CppScope& scope)
        : domains_(domains), structure_(structure), scope_(scope) {}

    Result<void> write_block(const Block& block);
    [[nodiscard]] StructSection section() && { return {std::move(text_), std::move(blocks_)}; }

  private:
    Result<CppMemberType> type_of(const Member& member, const std::string& path);
    [[nodiscard]] const WrittenStruct* written(const Member& member) const;
    Result<WrittenStruct> write_struct(const Member& member, const std::string& path);
    Result<void> add_members(StructText& structure, const std::vector<Member>& members,
                             const std::string& path);
    Result<void> append(const StructText& structure, const std::string& description,
                        const std::string& constants);
    [[nodiscard]] std::string comment_of(const Member& member, const std::string& path) const;

    const std::vector<Domain>& domains_;
    const TextTemplate& structure_;
    CppScope& scope_;
    std::vector<WrittenStruct> written_;
    std::vector<NamedBlock> blocks_;
    std::string text_;
};

tl::unexpected<Diagnostics> unsupported(const std::string& path) {
    return fail(Fault::input, fmt::format("no C++ struct has the layout of '{}'", path),
                "declare the block with layout(std140)");
}

Result<CppMemberType> StructWriter::type_of(const Member& member, const std::string& path) {
    if (member.members.empty()) {
        auto type = cpp_type_of(member);
        if (!type) return unsupported(path);
        return *type;
    }
    const Result<WrittenStruct> structure = write_struct(member, path);
    if (!structure) return tl::make_unexpected(structure.error());
    auto type = cpp_array_of(structure->cpp_name, structure->size, member);
    if (!type) return unsupported(path);
    return *type;
}

Result<void> StructWriter::add_members(StructText& structure, const std::vector<Member>& members,
                                       const std::string& path) {
    std::vector<CppMemberType> types;
    for (const Member& member : members) {
        Result<CppMemberType> type = type_of(member, path + "." + member.name);
        if (!type) return tl::make_unexpected(std::move(type.error()));
        // A member may not have the name of a type that its struct uses.
        structure.scope.claim(type->type);
        types.push_back(std::move(*type));
    }
    for (std::size_t index = 0; index < members.size(); ++index) {
        if (members[index].offset < structure.end) return unsupported(path + "." + members[index].name);
        const WrittenStruct* inner = written(members[index]);
        structure.add(members[index], types[index], comment_of(members[index], path),
                      inner == nullptr ? std::vector<NamedMember>{} : inner->named);
    }
    return {};
}

const WrittenStruct* StructWriter::written(const Member& member) const {
    if (member.members.empty()) return nullptr;
    const auto found = std::find_if(written_.begin(), written_.end(), [&member](const WrittenStruct& other) {
        return other.glsl_name == member.type && other.members == member.members;
    });
    return found == written_.end() ? nullptr : &*found;
}

Result<WrittenStruct> StructWriter::write_struct(const Member& member, const std::string& path) {
    if (const WrittenStruct* found = written(member)) return *found;

    StructText structure;
    structure.name = scope_.claim(cpp_identifier(member.type), "_struct");
    structure.scope.claim(structure.name);
    if (const auto added = add_members(structure, member.members, path); !added) {
        return tl::make_unexpected(added.error());
    }
    // Rounded up as std140 does; a tighter layout shows in the stride of an array.
    int size = rounded_up(structure.end);
    const int stride = element_stride(member);
    if (stride >= structure.end && stride < size) size = stride;
    structure.close(size);
    const auto appended = append(structure, fmt::format("The shaders' struct {}.", member.type), {});
    if (!appended) return tl::make_unexpected(appended.error());
    written_.push_back({member.type, member.members, size, structure.name, std::move(structure.named)});
    return written_.back();
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
        last.name, last.offset, last.array_stride, struct_alignment - 1, struct_alignment, struct_alignment);
}

Result<void> StructWriter::write_block(const Block& block) {
    StructText structure;
    structure.name = scope_.claim(cpp_identifier(block.name), "_block");
    structure.scope = CppScope({structure.name, "binding", "size", "bytes"});
    if (const auto added = add_members(structure, block.members, block.name); !added) return added;
    const int size = rounded_up(std::max(structure.end, block.size));
    structure.close(size);
    std::string constants = fmt::format("\n    static constexpr int binding = {};\n", block.binding);
    constants += fmt::format("    static constexpr std::size_t size = {};\n", size);
    constants += bytes_function(block);
    blocks_.push_back({block.name, structure.name, structure.named});
    return append(structure, fmt::format("The uniform block {}.", block.name), constants);
}

Result<void> StructWriter::append(const StructText& structure, const std::string& description,
                                  const std::string& constants) {
    const Result<std::string> text = fill(structure_, {{"description", description},
                                                       {"name", structure.name},
                                                       {"members", structure.members},
                                                       {"constants", constants},
                                                       {"assertions", structure.assertions}});
    if (!text) return tl::make_unexpected(text.error());
    text_ += *text;
    return {};
}

std::string StructWriter::comment_of(const Member& member, const std::string& path) const {
    const std::string domain = domain_text(domains_, path + "." + member.name);
    return domain.empty() ? domain : "  ///< " + domain;
}

}  // namespace

const Domain* domain_of(const std::vector<Domain>& domains, const std::string& path) {
    const std::string wanted = without_indices(path);
    const auto names_it = [&wanted](const Domain& domain) { return without_indices(domain.name) == wanted; };
    const auto domain = std::find_if(domains.begin(), domains.end(), names_it);
    return domain == domains.end() ? nullptr : &*domain;
}

std::string domain_text(const std::vector<Domain>& domains, const std::string& path) {
    const Domain* domain = domain_of(domains, path);
    if (domain == nullptr) return {};
    std::string text =
        fmt::format("{}[{}, {}]", domain->of_length ? "length in " : "", domain->low, domain->high);
    for (const double value : domain->also) text += fmt::format(", or {}", value);
    if (!domain->last.empty()) text += fmt::format("; last [{}, {}]", domain->last[0], domain->last[1]);
    return text;
}

Result<StructSection> struct_section(const std::vector<Block>& blocks, const std::vector<Domain>& domains,
                                     const TextTemplate& structure, CppScope& scope) {
    StructWriter writer(domains, structure, scope);
    for (const Block& block : blocks) {
        const auto written = writer.write_block(block);
        if (!written) return tl::make_unexpected(written.error());
    }
    return std::move(writer).section();
}

}  // namespace gobo
