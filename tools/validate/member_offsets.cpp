#include "validate/member_offsets.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <optional>

#include <fmt/format.h>

#include "compose/tokens.hpp"
#include "reflect/reflect.hpp"
#include "validate/declaration.hpp"
#include "validate/glslang_log.hpp"

namespace gobo {
namespace {

/// Whether any array's size is computed from specialisation constants.
bool computes_sizes(const spirv::Module& module) {
    return std::ranges::any_of(module.instructions, [&](const spirv::Instruction& array) {
        const spirv::Instruction* const size =
            array.opcode == spv::OpTypeArray ? module.definition(array.id(3)) : nullptr;
        return size != nullptr && size->opcode == spv::OpSpecConstantOp;
    });
}

/// No member lies before the end of the one that stands before it (GLSL 4.60, 4.4.5); in Vulkan they may
/// stand in any order, but not overlap.
std::optional<Diagnostic> overlapping_member(const spirv::Module& module, const Block& block,
                                             const std::vector<const Piece*>& pieces, bool is_vulkan) {
    for (std::size_t i = 1; i < block.members.size(); ++i) {
        const Member& member = block.members[i];
        for (std::size_t j = is_vulkan ? 0 : i - 1; j < i; ++j) {
            const Member& before = block.members[j];
            if (member.offset >= before.offset + size_of(before)) continue;
            if (is_vulkan && member.offset + size_of(member) <= before.offset) continue;
            const char* const where = member.offset < before.offset ? "before that" : "within that";
            return diagnostic_at(
                declaration_of_member(root_of(block.name), member.name, pieces), Severity::error,
                fmt::format("'{}' has offset {}, {} of '{}', which stands above it", member.name,
                            member.offset, where, before.name),
                !before.array.empty() && computes_sizes(module)
                    ? "state its offset: glslang counts an array whose size is computed from "
                      "specialisation constants as one element"
                    : "order members by their offsets, each behind the end of the one before");
        }
    }
    return std::nullopt;
}

/// In a block that leaves its layout to Vulkan, glslang moves a member whose offset its type does not allow.
std::optional<Diagnostic> moved_member(const Block& block, const std::vector<const Piece*>& pieces) {
    for (const Member& member : block.members) {
        const Declaration at = declaration_of_member(root_of(block.name), member.name, pieces);
        const std::vector<std::string_view> tokens = tokens_of(at.quoted_line);
        const auto name = std::ranges::find(tokens, std::string_view(member.name));
        const auto begin =
            std::find_if(std::reverse_iterator(name), tokens.rend(), [](std::string_view token) {
                return token == ";" || token == "{";
            }).base();
        const auto offset = std::find(begin, name, "offset");
        if (name - offset < 3) continue;
        int stated = member.offset;  // what is no plain number is taken as it came
        std::from_chars(offset[2].data(), offset[2].data() + offset[2].size(), stated);
        if (stated == member.offset || (offset[3] != ")" && offset[3] != ",")) continue;
        return diagnostic_at(at, Severity::error,
                             unaligned_text(offset[2], member.array.empty() ? member.type : ""), "");
    }
    return std::nullopt;
}

/// The first that is found in one of the blocks.
template <typename Check>
void find_first(std::initializer_list<const std::vector<Block>*> lists, const Check& check,
                Diagnostics& found) {
    for (const auto* const blocks : lists)
        for (const Block& block : *blocks)
            if (auto misplaced = check(block)) return found.push_back(*std::move(misplaced));
}

}  // namespace

Diagnostics check_member_offsets(const spirv::Module& module, const Interface& interface,
                                 const std::vector<const Piece*>& pieces, Dialect dialect) {
    const bool is_vulkan = dialect == Dialect::vulkan;
    Diagnostics found;
    find_first(
        {&interface.blocks, &interface.storage_blocks, &interface.push_constants},
        [&](const Block& block) { return overlapping_member(module, block, pieces, is_vulkan); }, found);
    if (is_vulkan)
        find_first(
            {&interface.blocks, &interface.storage_blocks},
            [&](const Block& block) { return moved_member(block, pieces); }, found);
    return found;
}

}  // namespace gobo
