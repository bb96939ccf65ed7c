// Uniform and storage blocks as C++ structs.
#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/numbers.hpp"
#include "emit/sections.hpp"
#include "reflect/reflect.hpp"
#include "spirv/glsl_type.hpp"

namespace gobo {
namespace {

/// std140 rounds structs and whole blocks up to the size of a vec4.
constexpr int kStructAlignment = 16;

/// In the order of Scalar. C++17 has no float of 16 bits: its bits, as glm::packHalf1x16() makes them.
constexpr std::string_view kNumbers[] = {"float",        "std::int32_t",  "std::uint32_t", "std140::Bool32",
                                         "double",       "std::uint16_t", "std::int8_t",   "std::uint8_t",
                                         "std::int16_t", "std::uint16_t", "std::int64_t",  "std::uint64_t"};

/// That of a scalar, vector or matrix that is no array.
std::optional<CppMemberType> element_type(const GlslType& glsl, const Member& member) {
    const std::string_view number = kNumbers[static_cast<std::size_t>(glsl.scalar)];
    const bool has_name = glsl.scalar <= Scalar::float64;  // in std140, such as std140::uvec2
    CppMemberType result{glsl.rows == 1 ? std::string(number)
                         : has_name     ? "std140::" + glsl.name()
                                        : fmt::format("std140::Vector<{}, {}>", glsl.rows, number),
                         {},
                         glsl.column_size()};
    if (!glsl.is_matrix()) return result;
    const int lines = member.row_major ? glsl.rows : glsl.columns;
    const int line_size = (member.row_major ? glsl.columns : glsl.rows) * glsl.scalar_size();
    if (member.matrix_stride < line_size) return std::nullopt;
    result.size = lines * member.matrix_stride;
    const std::string shape = fmt::format("<{}, {}, {}", glsl.columns, glsl.rows, number);
    if (member.row_major)
        result.type = fmt::format("std140::RowMajorMatrix{}, {}>", shape, member.matrix_stride);
    else if (member.matrix_stride > line_size)
        result.type = fmt::format("std140::Matrix{}, {}>", shape, member.matrix_stride);
    else
        result.type = fmt::format("std140::PlainMatrix{}>", shape);
    if (result.type == "std140::Matrix<2, 2, float, 16>") result.type = "std140::Mat2";
    if (result.type == "std140::Matrix<3, 3, float, 16>") result.type = "std140::Mat3";
    if (result.type == "std140::PlainMatrix<4, 4, float>") result.type = "std140::mat4";
    return result;
}

/// Bytes from one innermost element of an array to the next; 0 where the member is no array.
int element_stride(const Member& member) {
    if (member.array.empty()) return 0;
    const int inner = element_count({member.array.begin() + 1, member.array.end()});
    return inner > 0 ? member.array_stride / inner : 0;
}

/// An array of `element`, whose size is `element_size`, with the extents and the stride of `member`;
/// `element` itself where the member is no array. Nothing where the stride is less than the element's size.
std::optional<CppMemberType> cpp_array_of(const std::string& element, int element_size,
                                          const Member& member) {
    CppMemberType result{element, {}, element_size};
    if (member.array.empty()) return result;
    const int stride = element_stride(member);
    if (stride < element_size) return std::nullopt;
    if (stride > element_size) result.type = fmt::format("std140::Padded<{}, {}>", element, stride);
    result.size = stride;
    for (const int extent : member.array) {
        result.extents += fmt::format("[{}]", extent);
        result.size *= extent;
    }
    return result;
}

/// A C++ struct under way: members so far, and where they end.
struct StructText {
    std::string name;
    CppScope scope = {};
    std::string members = {};
    std::string assertions = {};
    std::vector<CppMember> named = {};
    int end = 0;
    int paddings = 0;

    void pad_to(int offset) {
        if (offset <= end) return;
        const std::string padding = scope.claim(fmt::format("padding{}", paddings++));
        members += fmt::format("    std::byte {}[{}];\n", padding, offset - end);
        end = offset;
    }

    void add(const Member& member, const CppMemberType& type, const std::string& comment,
             std::vector<CppMember> parts) {
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

/// A block, or an array of blocks with one layout.
struct NamedBlock {
    std::string name;  ///< without the array's indices
    Block layout;      ///< that of the first, with members by offset
    bool is_storage = false;
    int count = 0;  ///< of the array; 0 where it is none
};

/// The array that ends the block, if one does: one buffer then serves every extent of it.
const Member* last_array(const Block& block) {
    return block.members.empty() || block.members.back().array.empty() ? nullptr : &block.members.back();
}

/// C++ places members in the order in which they are declared: by offset, which the source may state
/// otherwise.
void sort_by_offset(std::vector<Member>& members) {
    std::ranges::stable_sort(members, {}, &Member::offset);
    for (Member& member : members) sort_by_offset(member.members);
}

class StructWriter {
  public:
    StructWriter(const std::vector<Domain>& domains, const HeaderTemplates& templates, CppScope& scope)
        : domains_(domains), templates_(templates), scope_(scope) {}

    /// Adds the block's struct to text(), behind those of its members. `count` is that of the blocks with
    /// this layout, where they are an array. `number`: which of the block's layouts it is, from 1; `users`
    /// says who has it where others have another.
    Result<StructText> write_block(const NamedBlock& block, int number, const std::string& users) {
        std::string identifier = cpp_identifier(block.name);
        if (number > 1) identifier += fmt::format("_{}", number);
        StructText structure{scope_.claim(identifier, "_block")};
        structure.scope = CppScope({structure.name, "binding", "size", "bytes"});
        const bool is_pushed = block.layout.binding < 0;  // push constants: all others have a place by now
        if (block.layout.set >= 0) structure.scope.claim("set");
        if (block.count > 0) structure.scope.claim("count");
        std::vector<Member> members = block.layout.members;
        std::optional<Member> tail;
        if (!members.empty() && !members.back().array.empty() && members.back().array.front() == 0) {
            tail = std::move(members.back());
            members.pop_back();
        }
        GOBO_TRY_DO(add_members(structure, members, block.name, block.is_storage));
        int size = is_pushed ? block.layout.size
                   : block.is_storage
                       ? rounded_up(structure.end, alignment_of(members))
                       : rounded_up(std::max(structure.end, block.layout.size), kStructAlignment);
        if (tail) {
            size = tail->offset;
            structure.pad_to(size);
        } else {
            structure.close(size);
        }
        std::string constants = "\n";
        if (block.layout.set >= 0)
            constants += fmt::format("    static constexpr int set = {};\n", block.layout.set);
        if (!is_pushed)
            constants += fmt::format("    static constexpr int binding = {};\n", block.layout.binding);
        if (block.count > 0)
            constants += fmt::format(
                "    static constexpr int count = {};  ///< blocks in the array, at {}\n", block.count,
                block.layout.set >= 0 ? "that binding" : "bindings from that one on");
        constants += fmt::format("    static constexpr std::size_t size = {};\n", size);
        if (const Member* last = last_array(block.layout)) {
            GOBO_TRY(const std::string bytes,
                     fill(templates_.at("bytes"), {{"array", cpp_comment(last->name)},
                                                   {"offset", std::to_string(last->offset)},
                                                   {"stride", std::to_string(last->array_stride)},
                                                   {"rounding", block.is_storage ? "" : " + 15) / 16 * 16"},
                                                   {"open", block.is_storage ? "" : "("}}));
            constants += bytes;
        }
        if (tail) {
            GOBO_TRY(const std::string elements, elements_of(structure, *tail, block));
            constants += elements;
        }
        const std::string_view kind = is_pushed ? "push constant" : block.is_storage ? "storage" : "uniform";
        GOBO_TRY_DO(append(structure, fmt::format("The {} block {}{}.", kind, cpp_comment(block.name), users),
                           constants));
        return structure;
    }

    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    /// The struct that a member's type is, written now unless it has been.
    Result<StructText> struct_of(const Member& member, const std::string& path, bool is_storage) {
        const int alignment = is_storage ? alignment_of(member.members) : kStructAlignment;
        const auto size_of = [&](int end) {
            const int stride = element_stride(member);
            return stride >= end ? stride : rounded_up(end, alignment);
        };
        for (const auto& [mirrored, structure, end] : written_)
            if (mirrored.type == member.type && mirrored.members == member.members &&
                structure.end == size_of(end))
                return structure;
        StructText structure{scope_.claim(cpp_identifier(member.type), "_struct")};
        structure.scope.claim(structure.name);
        GOBO_TRY_DO(add_members(structure, member.members, path, is_storage));
        const int end = structure.end;
        structure.close(size_of(end));
        GOBO_TRY_DO(append(structure, fmt::format("The shaders' struct {}.", cpp_comment(member.type)), {}));
        return written_.emplace_back(Written{member, std::move(structure), end}).structure;
    }

    /// The C++ type of a member. `parts` becomes what it holds, where it is a struct.
    Result<CppMemberType> type_of(const Member& member, const std::string& path, bool is_storage,
                                  std::vector<CppMember>& parts) {
        std::optional<CppMemberType> type = cpp_type_of(member);
        if (!member.members.empty()) {
            GOBO_TRY(StructText inner, struct_of(member, path + "." + member.name, is_storage));
            type = cpp_array_of(inner.name, inner.end, member);
            parts = std::move(inner.named);
        }
        if (!type)
            return fail(
                Fault::input,
                fmt::format("no C++ type has the layout of '{}.{}', a {}", path, member.name, member.type),
                fmt::format("declare the block with layout({}), of numbers of 32 or 64 bits",
                            is_storage ? "std430" : "std140"));
        return *type;
    }

    Result<void> add_members(StructText& structure, const std::vector<Member>& members,
                             const std::string& path, bool is_storage) {
        std::vector<std::pair<CppMemberType, std::vector<CppMember>>> types;
        for (const Member& member : members) {
            std::vector<CppMember> parts;
            GOBO_TRY(CppMemberType type, type_of(member, path, is_storage, parts));
            // A member may not have the name of a type that its struct uses.
            structure.scope.claim(type.type);
            types.emplace_back(std::move(type), std::move(parts));
        }
        for (std::size_t i = 0; i < members.size(); ++i) {
            if (members[i].offset < structure.end)
                return fail(
                    Fault::input,
                    fmt::format("'{}.{}' at offset {} overlaps '{}', which ends at {}", path, members[i].name,
                                members[i].offset, members[i - 1].name, structure.end),
                    fmt::format("state other offsets, or none: layout({}) gives them",
                                is_storage ? "std430" : "std140"));
            const std::string domain = domain_text(domains_, path + "." + members[i].name);
            structure.add(members[i], types[i].first, domain.empty() ? "" : "  ///< " + domain,
                          std::move(types[i].second));
        }
        return {};
    }

    /// A function of the block's struct that gives the elements of its array without a size.
    Result<std::string> elements_of(StructText& structure, Member tail, const NamedBlock& block) {
        tail.array.front() = 1;
        std::vector<CppMember> parts;
        GOBO_TRY(const CppMemberType type, type_of(tail, block.name, block.is_storage, parts));
        structure.scope.claim(type.type);
        return fill(templates_.at("elements"),
                    {{"array", cpp_comment(tail.name)},
                     {"type", type.type + type.extents.substr(std::string_view("[1]").size())},
                     {"name", structure.scope.claim(cpp_function_name(tail.name))},
                     {"offset", std::to_string(tail.offset)}});
    }

    Result<void> append(const StructText& structure, const std::string& description,
                        const std::string& constants) {
        GOBO_TRY(const std::string text,
                 fill(templates_.at("struct"), {{"description", cpp_comment(description)},
                                                {"name", structure.name},
                                                {"members", structure.members},
                                                {"constants", constants},
                                                {"assertions", structure.assertions}}));
        text_ += text;
        return {};
    }

    const std::vector<Domain>& domains_;
    const HeaderTemplates& templates_;
    CppScope& scope_;
    struct Written {
        Member mirrored;  ///< the member that it was written for
        StructText structure;
        int end;  ///< of its last member
    };
    std::vector<Written> written_;
    std::string text_;
};

}  // namespace

std::optional<CppMemberType> cpp_type_of(const Member& member) {
    const std::optional<GlslType> glsl = glsl_type(member.type);
    if (!glsl) return std::nullopt;
    const auto element = element_type(*glsl, member);
    return element ? cpp_array_of(element->type, element->size, member) : std::nullopt;
}

namespace {

/// Adds the structs of a list of blocks. The elements of an array of blocks share a struct
/// where they have one layout.
Result<void> add_blocks(const std::vector<Block>& blocks, std::string_view kind,
                        const Declarations& declarations, StructWriter& writer,
                        std::vector<CppBlock>& written) {
    struct Layout {
        NamedBlock block;
        std::string users;
        std::set<std::string> elements;
    };
    std::map<std::string, std::vector<Layout>> by_name;
    for (const Block& block : blocks) {
        const std::string name = block.name.substr(0, block.name.find('['));
        const bool is_array = name.size() < block.name.size();
        Block sorted = block;
        sort_by_offset(sorted.members);
        std::vector<Layout>& layouts = by_name[name];
        auto layout = std::ranges::find_if(layouts, [&](const Layout& other) {
            return is_array && other.block.layout.members == sorted.members;
        });
        if (layout == layouts.end()) {
            int number = 1;
            for (const Block* same = &block; same != blocks.data() && same[-1].name == block.name; --same)
                ++number;
            const auto differing = declarations.find(kind, block.name);
            std::string users =
                differing ? " as declared by " + cpp_comment(declarations.example(*differing, number)) : "";
            if (!differing && std::ranges::count(blocks, block.name, &Block::name) > 1)
                users = fmt::format(" of stage {}", fmt::join(block.stages, ", "));
            layout = layouts.insert(layout, {{name, std::move(sorted), kind != "uniform block"}, users, {}});
        }
        layout->elements.insert(block.name);
        if (is_array) layout->block.count = static_cast<int>(layout->elements.size());
        layout->block.layout.binding = std::min(layout->block.layout.binding, block.binding);
    }
    for (const auto& [name, layouts] : by_name)
        for (std::size_t i = 0; i < layouts.size(); ++i) {
            const Layout& layout = layouts[i];
            GOBO_TRY(StructText structure,
                     writer.write_block(layout.block, static_cast<int>(i) + 1, layout.users));
            const Member* const last = last_array(layout.block.layout);
            written.push_back({name, structure.name, std::move(structure.named),
                               last != nullptr && last->array.front() != 0 ? last->name : ""});
        }
    return {};
}

}  // namespace

Result<std::vector<CppBlock>> block_section(const Interface& interface, const std::vector<Domain>& domains,
                                            const Declarations& declarations,
                                            const HeaderTemplates& templates, CppScope& scope,
                                            TemplateValues& values) {
    StructWriter writer(domains, templates, scope);
    std::vector<CppBlock> written;
    GOBO_TRY_DO(add_blocks(interface.blocks, "uniform block", declarations, writer, written));
    GOBO_TRY_DO(add_blocks(interface.storage_blocks, "storage block", declarations, writer, written));
    GOBO_TRY_DO(add_blocks(interface.push_constants, "push constant block", declarations, writer, written));
    values["structs"] = writer.text();
    return written;
}

}  // namespace gobo
