#include "reflect/restore_bools.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

namespace gobo {
namespace {

/// GL_BOOL, GL_BOOL_VEC2, GL_BOOL_VEC3, GL_BOOL_VEC4 (OpenGL 4.5, table 7.3).
constexpr int gl_bool = 0x8B56;
constexpr int gl_bool_vec4 = 0x8B59;

/// The name without its array subscripts.
std::string without_subscripts(std::string_view name) {
    std::string result;
    bool inside = false;
    for (const char character : name) {
        if (character == '[') inside = true;
        if (!inside) result += character;
        if (character == ']') inside = false;
    }
    return result;
}

bool is_unsigned(const std::string& type) {
    return type == "uint" || type.starts_with("uvec");
}

std::string boolean(const std::string& type) {
    return type == "uint" ? "bool" : "bvec" + type.substr(4);
}

bool has_unsigned(const Member& member) {
    return is_unsigned(member.type) || std::ranges::any_of(member.members, has_unsigned);
}

bool has_unsigned_member(const Block& block) {
    return std::ranges::any_of(block.members, has_unsigned);
}

/// By name without subscripts: whether the type is a boolean.
using Booleans = std::map<std::string, bool>;

/// `block` is "Block.", `path` ends in a dot or is empty. A block with an instance lists its members below
/// its own name, one without lists them bare.
void restore(Member& member, const std::string& block, const std::string& path, const Booleans& booleans) {
    const std::string name = path + member.name;
    for (Member& inner : member.members) restore(inner, block, name + ".", booleans);
    if (!is_unsigned(member.type)) return;
    auto found = booleans.find(block + name);
    if (found == booleans.end()) found = booleans.find(name);
    if (found != booleans.end() && found->second) member.type = boolean(member.type);
}

void restore(std::vector<Block>& blocks, const Booleans& booleans) {
    for (Block& block : blocks) {
        const std::string name = without_subscripts(block.name) + ".";
        for (Member& member : block.members) restore(member, name, "", booleans);
    }
}

}  // namespace

bool may_hold_bools(const Interface& interface) {
    return std::ranges::any_of(interface.blocks, has_unsigned_member) ||
           std::ranges::any_of(interface.storage_blocks, has_unsigned_member);
}

Interface restore_bools(Interface interface, const GlTypes& types) {
    Booleans booleans;
    for (const auto& [name, type] : types) {
        booleans[without_subscripts(name)] = type >= gl_bool && type <= gl_bool_vec4;
    }
    restore(interface.blocks, booleans);
    restore(interface.storage_blocks, booleans);
    return interface;
}

}  // namespace gobo
