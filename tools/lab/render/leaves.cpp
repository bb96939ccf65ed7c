#include "lab/render/leaves.hpp"

#include <charconv>

#include <fmt/format.h>

namespace gobo {
namespace {

/// What a struct or an outer array dimension adds to the name and the offset of what it holds.
struct Prefix {
    std::string name;
    int offset = 0;
};

class Flattener {
  public:
    Flattener(std::string block, std::vector<Leaf>& leaves) : block_(std::move(block)), leaves_(leaves) {}

    /// `dimension` is the first of the member's array dimensions that the prefix does not spell out yet.
    void add(const Member& member, const Prefix& prefix, std::size_t dimension = 0) {
        const std::size_t left = member.array.size() - dimension;
        if (left > (member.members.empty() ? 1U : 0U)) {
            const int stride = stride_of(member, dimension);
            for (int i = 0; i < member.array[dimension]; ++i)
                add(member, {fmt::format("{}[{}]", prefix.name, i), prefix.offset + i * stride},
                    dimension + 1);
        } else if (member.members.empty()) {
            add_leaf(member, prefix, left == 1);
        } else {
            for (const Member& inner : member.members)
                add(inner, {prefix.name + "." + inner.name, prefix.offset + inner.offset});
        }
    }

  private:
    /// Of an inner dimension: std140 and std430 pack the elements of an array of arrays without a gap.
    static int stride_of(const Member& member, std::size_t dimension) {
        int stride = member.array_stride;
        for (std::size_t i = 1; i <= dimension; ++i) stride /= member.array[i] > 0 ? member.array[i] : 1;
        return stride;
    }

    void add_leaf(const Member& member, const Prefix& prefix, bool is_array) {
        Leaf leaf{prefix.name, block_, member.type};
        leaf.is_array = is_array;
        leaf.offset = prefix.offset;
        leaf.matrix_stride = member.matrix_stride;
        leaf.row_major = member.row_major;
        if (is_array) {
            leaf.count = member.array.back();
            leaf.array_stride = stride_of(member, member.array.size() - 1);
        }
        leaves_.push_back(std::move(leaf));
    }

    std::string block_;
    std::vector<Leaf>& leaves_;
};

}  // namespace

std::vector<Leaf> leaves_of(const Interface& interface) {
    std::vector<Leaf> leaves;
    for (const Block& block : interface.blocks)
        for (const Member& member : block.members)
            Flattener(block.name, leaves).add(member, {block.name + "." + member.name, member.offset});
    for (const Uniform& uniform : interface.uniforms) {
        Member member;
        member.name = uniform.name;
        member.type = uniform.type;
        member.array = uniform.array;
        member.members = uniform.members;
        Flattener("", leaves).add(member, {uniform.name, 0});
    }
    return leaves;
}

std::optional<Leaf> find_leaf(const std::vector<Leaf>& leaves, std::string_view name) {
    for (const Leaf& leaf : leaves)
        if (leaf.name == name) return leaf;
    const std::size_t bracket = name.rfind('[');
    if (bracket == std::string_view::npos || name.back() != ']') return std::nullopt;
    int element = -1;
    std::from_chars(name.data() + bracket + 1, name.data() + name.size() - 1, element);
    for (Leaf leaf : leaves) {
        if (leaf.name != name.substr(0, bracket) || element < 0 || element >= leaf.count) continue;
        leaf.name = name;
        leaf.offset += element * leaf.array_stride;
        leaf.count -= element;
        return leaf;
    }
    return std::nullopt;
}

std::string without_subscripts(std::string_view name) {
    std::string text;
    bool inside = false;
    for (const char character : name) {
        if (character == ']') inside = false;
        if (!inside) text += character;
        if (character == '[') inside = true;
    }
    return text;
}

}  // namespace gobo
