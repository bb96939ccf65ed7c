#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "program_interface.hpp"

namespace gobo {
namespace {

template <class Item>
const Item* find(const std::vector<Item>& items, const std::string& name) {
    const auto found =
        std::find_if(items.begin(), items.end(), [&](const auto& item) { return item.name == name; });
    return found == items.end() ? nullptr : &*found;
}

/// Collects sentences about one thing ("block Fog", "member Fog.near").
class Differences {
  public:
    template <class Value>
    void expect(const std::string& subject, const char* aspect, const Value& reflected, const Value& driver) {
        if (reflected != driver)
            sentences.push_back(
                fmt::format("{}: {} {} reflected, {} by the driver", subject, aspect, reflected, driver));
    }
    void add(std::string sentence) { sentences.push_back(std::move(sentence)); }

    std::vector<std::string> sentences;
};

void compare_blocks(const std::vector<Block>& reflected, const std::vector<Block>& driver,
                    Differences& result) {
    for (const Block& block : reflected) {
        const std::string subject = "block " + block.name;
        const Block* other = find(driver, block.name);
        if (other == nullptr) {
            result.add(subject + ": unused, or unknown to the driver");
            continue;
        }
        result.expect(subject, "size", block.size, other->size);
        // Drivers that move code between stages, as Mesa does since 24, name both: more stages than the
        // source.
        if (!std::ranges::includes(other->stages, block.stages, std::ranges::greater()))
            result.expect(subject, "stages", fmt::format("{}", fmt::join(block.stages, " and ")),
                          fmt::format("{}", fmt::join(other->stages, " and ")));
        if (block.binding >= 0) result.expect(subject, "binding", block.binding, other->binding);
    }
    for (const Block& block : driver)
        if (find(reflected, block.name) == nullptr)
            result.add(fmt::format("block {}: not reflected", block.name));
}

void compare_leaf(const Leaf& leaf, const Leaf& other, Differences& result) {
    const std::string subject = (leaf.block.empty() ? "uniform " : "member ") + leaf.name;
    result.expect(subject, "type", leaf.type, other.type);
    result.expect(subject, "is an array", leaf.is_array, other.is_array);
    if (leaf.block.empty()) {
        if (other.count > leaf.count) result.expect(subject, "extent", leaf.count, other.count);
        return;
    }
    result.expect(subject, "extent", leaf.count, other.count);
    result.expect(subject, "offset", leaf.offset, other.offset);
    result.expect(subject, "array stride", leaf.array_stride, other.array_stride);
    result.expect(subject, "matrix stride", leaf.matrix_stride, other.matrix_stride);
    result.expect(subject, "row major", leaf.row_major, other.row_major);
}

/// Whether the driver lists any leaf of the plain uniform.
bool is_used(const Uniform& uniform, const std::vector<Leaf>& driver) {
    return std::any_of(driver.begin(), driver.end(), [&](const Leaf& leaf) {
        if (!leaf.block.empty() || !leaf.name.starts_with(uniform.name)) return false;
        const std::size_t end = uniform.name.size();
        return leaf.name.size() == end || leaf.name[end] == '.' || leaf.name[end] == '[';
    });
}

void compare_leaves(const Interface& reflected, const std::vector<Leaf>& driver, Differences& result) {
    const std::vector<Leaf> leaves = leaves_of(reflected);
    for (const Leaf& leaf : leaves) {
        const Leaf* other = find(driver, leaf.name);
        if (other != nullptr) {
            compare_leaf(leaf, *other, result);
        } else if (!leaf.block.empty()) {
            result.add(fmt::format("member {}: unknown to the driver", leaf.name));
        }
    }
    for (const Leaf& leaf : driver)
        if (find(leaves, leaf.name) == nullptr)
            result.add(
                fmt::format("{} {}: not reflected", leaf.block.empty() ? "uniform" : "member", leaf.name));
    for (const Uniform& uniform : reflected.uniforms)
        if (!is_used(uniform, driver)) result.add(fmt::format("uniform {}: unused", uniform.name));
}

template <class Item>
void compare_items(const char* kind, const std::vector<Item>& reflected, const std::vector<Item>& driver,
                   int Item::*number, const char* number_name, Differences& result) {
    for (const Item& item : reflected) {
        const std::string subject = fmt::format("{} {}", kind, item.name);
        const Item* other = find(driver, item.name);
        if (other == nullptr) {
            result.add(subject + ": unused");
            continue;
        }
        result.expect(subject, "type", item.type, other->type);
        result.expect(subject, "is an array", !item.array.empty(), !other->array.empty());
        if (item.*number >= 0) result.expect(subject, number_name, item.*number, other->*number);
    }
    for (const Item& item : driver)
        if (find(reflected, item.name) == nullptr)
            result.add(fmt::format("{} {}: not reflected", kind, item.name));
}

}  // namespace

std::vector<std::string> differences(const Interface& reflected, const ProgramInterface& driver) {
    Differences result;
    compare_blocks(reflected.blocks, driver.blocks, result);
    compare_leaves(reflected, driver.leaves, result);
    compare_items("sampler", reflected.samplers, driver.samplers, &Sampler::binding, "binding", result);
    compare_items("input", reflected.inputs, driver.inputs, &Variable::location, "location", result);
    compare_items("output", reflected.outputs, driver.outputs, &Variable::location, "location", result);
    return result.sentences;
}

}  // namespace gobo
