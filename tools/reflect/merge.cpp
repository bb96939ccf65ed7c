#include "reflect/merge.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace gobo {
namespace {

/// Where the stage stands in the pipeline.
std::size_t rank(const std::string& stage) {
    constexpr std::array<std::string_view, 6> pipeline = {"vertex",   "tess_control", "tess_evaluation",
                                                          "geometry", "fragment",     "compute"};
    return static_cast<std::size_t>(std::ranges::find(pipeline, stage) - pipeline.begin());
}

void add_stages(std::vector<std::string>& stages, const std::vector<std::string>& more) {
    for (const std::string& stage : more) {
        if (std::ranges::find(stages, stage) == stages.end()) stages.push_back(stage);
    }
    std::ranges::sort(stages, {}, rank);
}

/// A stage that states no binding or location agrees with one that does.
void settle(int& left, int& right) {
    if (left < 0) left = right;
    if (right < 0) right = left;
}

/// The outermost extent of the array that ends the block, or null where none does.
int* last_extent(Block& block) {
    if (block.members.empty() || block.members.back().array.empty()) return nullptr;
    return &block.members.back().array.front();
}

/// `other` with that array shortened to the extent that `block` has, if that is what sets them apart.
void even_out(Block& block, Block& other) {
    int* const extent = last_extent(block);
    int* const other_extent = last_extent(other);
    if (extent == nullptr || other_extent == nullptr) return;
    Block& smaller = *extent < *other_extent ? block : other;
    const Block& larger = *extent < *other_extent ? other : block;
    *last_extent(smaller) = larger.members.back().array.front();
    smaller.size = larger.size;
}

// reconcile() brings `entry` and `other`, which have the same name, as close as their kind allows; they then
// agree if they are equal. The stages of both are united.
void reconcile(Block& entry, Block& other) {
    settle(entry.binding, other.binding);
    even_out(entry, other);
}
void reconcile(Uniform& entry, Uniform& other) {
    settle(entry.location, other.location);
}
void reconcile(Sampler& entry, Sampler& other) {
    settle(entry.binding, other.binding);
}
void reconcile(Variable& entry, Variable& other) {
    settle(entry.location, other.location);
}

/// What two entries disagree about: the name, with the first member that differs where it is a block.
template <class Entry>
std::string contested(const Entry& entry, const Entry&) {
    return entry.name;
}
std::string contested(const Block& entry, const Block& other) {
    const auto [mine, theirs] = std::ranges::mismatch(entry.members, other.members);
    return mine == entry.members.end() ? entry.name : entry.name + "." + mine->name;
}

template <class Entry>
void unite_stages(Entry& entry, Entry& other) {
    if constexpr (requires { entry.stages; }) {
        add_stages(entry.stages, other.stages);
        other.stages = entry.stages;
    }
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
        reconcile(*place, other);
        unite_stages(*place, other);
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

std::size_t first_rank(const Interface& interface) {
    return interface.stages.empty() ? 0 : rank(interface.stages.front());
}

}  // namespace

Interface merge(std::vector<Interface> stages) {
    if (stages.empty()) return {};
    std::ranges::stable_sort(stages, {}, first_rank);
    Interface program;
    std::vector<std::string> conflicts;  // linking has ruled them out
    for (const Interface& stage : stages) add_resources(program, stage, conflicts);
    program.inputs = std::move(stages.front().inputs);
    program.outputs = std::move(stages.back().outputs);
    return program;
}

Interface merge(const Interface& vertex, const Interface& fragment) {
    return merge(std::vector<Interface>{vertex, fragment});
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
    return sum;
}

}  // namespace gobo
