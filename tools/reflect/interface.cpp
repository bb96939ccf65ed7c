#include "reflect/interface.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace gobo {
namespace {

/// Where the stage stands in the pipeline.
std::size_t rank(const std::string& stage) {
    return static_cast<std::size_t>(std::ranges::find(kStages, stage) - kStages.begin());
}

void add_stages(std::vector<std::string>& stages, const std::vector<std::string>& more) {
    for (const std::string& stage : more)
        if (std::ranges::find(stages, stage) == stages.end()) stages.push_back(stage);
    std::ranges::sort(stages, {}, rank);
}

/// The outermost extent of the array that ends the block, or null where none does.
int* last_extent(Block& block) {
    if (block.members.empty() || block.members.back().array.empty()) return nullptr;
    return &block.members.back().array.front();
}

/// Gives the array that ends both blocks the larger of their extents.
void extend_last_array(Block& block, Block& other) {
    int* const extent = last_extent(block);
    int* const other_extent = last_extent(other);
    if (extent == nullptr || other_extent == nullptr) return;
    block.size = other.size = *extent < *other_extent ? other.size : block.size;
    *extent = *other_extent = std::max(*extent, *other_extent);
}

/// What two entries disagree about: the name, with the first member that differs where it is a block.
template <class Entry>
std::string contested(const Entry& entry, const Entry& other) {
    if constexpr (std::is_same_v<Entry, Block>) {
        const auto [mine, theirs] = std::ranges::mismatch(entry.members, other.members);
        if (mine != entry.members.end()) return entry.name + "." + mine->name;
    }
    return entry.name;
}

/// Adds `more` to `list`, both sorted by name. What they disagree about goes to `conflicts`.
template <class Entry>
void add_entries(std::vector<Entry>& list, const std::vector<Entry>& more,
                 std::vector<std::string>& conflicts) {
    for (Entry other : more) {
        const auto place = std::ranges::lower_bound(list, other.name, {}, &Entry::name);
        if (place == list.end() || place->name != other.name) {
            list.insert(place, std::move(other));
            continue;
        }
        // One that states no binding or location agrees with one that does.
        int& number = place_of(*place);
        int& other_number = place_of(other);
        if (number < 0) number = other_number;
        if (other_number < 0) other_number = number;
        if constexpr (std::is_same_v<Entry, Block>) extend_last_array(*place, other);
        if constexpr (requires { place->stages; }) {
            add_stages(place->stages, other.stages);
            other.stages = place->stages;
        }
        place->usage.unused = place->usage.unused && other.usage.unused;
        if (*place != other) conflicts.push_back(contested(*place, other));
    }
}

/// Everything but inputs and outputs.
void add_resources(Interface& sum, const Interface& more, std::vector<std::string>& conflicts) {
    add_stages(sum.stages, more.stages);
    add_entries(sum.blocks, more.blocks, conflicts);
    add_entries(sum.storage_blocks, more.storage_blocks, conflicts);
    add_entries(sum.uniforms, more.uniforms, conflicts);
    add_entries(sum.samplers, more.samplers, conflicts);
}

bool is_unsigned(const std::string& type) {
    return type == "uint" || type.starts_with("uvec");
}

bool has_unsigned(const Member& member) {
    return is_unsigned(member.type) || std::ranges::any_of(member.members, has_unsigned);
}

/// By name without indices: whether the type is a boolean.
using Booleans = std::map<std::string, bool>;

/// `block` is "Block.", `path` ends in a dot or is empty. A block with an instance lists its members below
/// its own name, one without lists them bare.
void restore(Member& member, const std::string& block, const std::string& path, const Booleans& booleans) {
    const std::string name = path + member.name;
    for (Member& inner : member.members) restore(inner, block, name + ".", booleans);
    if (!is_unsigned(member.type)) return;
    auto found = booleans.find(block + name);
    if (found == booleans.end()) found = booleans.find(name);
    if (found != booleans.end() && found->second)
        member.type = member.type == "uint" ? "bool" : "bvec" + member.type.substr(4);
}

}  // namespace

std::string_view root_of(std::string_view name) {
    return name.substr(0, name.find_first_of(".["));
}

std::string without_indices(std::string_view name) {
    std::string result;
    bool is_inside = false;
    for (const char character : name) {
        is_inside = is_inside || character == '[';
        if (!is_inside) result += character;
        is_inside = is_inside && character != ']';
    }
    return result;
}

Interface merge(std::vector<Interface> stages) {
    if (stages.empty()) return {};
    std::ranges::stable_sort(stages, {}, [](const Interface& stage) {
        return stage.stages.empty() ? 0 : rank(stage.stages.front());
    });
    Interface program;
    std::vector<std::string> conflicts;  // linking has ruled them out
    for (const Interface& stage : stages) add_resources(program, stage, conflicts);
    program.inputs = std::move(stages.front().inputs);
    program.outputs = std::move(stages.back().outputs);
    return program;
}

Result<Interface> unite(const std::vector<Interface>& programs) {
    Interface sum;
    std::vector<std::string> conflicts;
    for (const Interface& program : programs) {
        add_resources(sum, program, conflicts);
        add_entries(sum.inputs, program.inputs, conflicts);
        add_entries(sum.outputs, program.outputs, conflicts);
        if (conflicts.empty()) continue;
        return fail(Fault::input,
                    fmt::format("'{}' is declared differently in different permutations", conflicts.front()),
                    "give it one declaration in a piece that every user includes, or two names");
    }
    std::erase_if(sum.samplers, [](const Sampler& sampler) { return sampler.usage.unused; });
    return sum;
}

bool may_hold_bools(const Interface& interface) {
    const auto has_unsigned_member = [](const Block& block) {
        return std::ranges::any_of(block.members, has_unsigned);
    };
    return std::ranges::any_of(interface.blocks, has_unsigned_member) ||
           std::ranges::any_of(interface.storage_blocks, has_unsigned_member);
}

Interface restore_bools(Interface interface, const GlTypes& types) {
    // GL_BOOL, GL_BOOL_VEC2, GL_BOOL_VEC3, GL_BOOL_VEC4 (OpenGL 4.5, table 7.3).
    constexpr int kGlBool = 0x8B56;
    constexpr int kGlBoolVec4 = 0x8B59;
    Booleans booleans;
    for (const auto& [name, type] : types)
        booleans[without_indices(name)] = type >= kGlBool && type <= kGlBoolVec4;
    for (std::vector<Block>* const blocks : {&interface.blocks, &interface.storage_blocks})
        for (Block& block : *blocks)
            for (Member& member : block.members)
                restore(member, without_indices(block.name) + ".", "", booleans);
    return interface;
}

}  // namespace gobo
