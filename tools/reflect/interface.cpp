#include "reflect/interface.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/stage.hpp"

namespace gobo {
namespace {

/// Where the stage stands in the pipeline.
std::size_t rank(const std::string& stage) {
    return static_cast<std::size_t>(std::ranges::find(kStages, stage, &StageNames::name) - kStages.begin());
}

void add_stages(std::vector<std::string>& stages, const std::vector<std::string>& more) {
    for (const std::string& stage : more)
        if (std::ranges::find(stages, stage) == stages.end()) stages.push_back(stage);
    std::ranges::sort(stages, {}, rank);
}

/// Whether stages that declare a name declare one thing: to OpenGL always, to Vulkan at one place.
template <class Entry>
bool is_same_thing(const Entry& one, const Entry& other) {
    if constexpr (requires { one.set; }) {
        if (one.set < 0) return true;
        if (one.set != other.set || one.binding != other.binding) return false;
        if constexpr (requires { one.members; })
            return one.members == other.members;
        else
            return one.type == other.type;
    }
    return true;
}

/// Adds what a later stage declares to `list`, both sorted by name.
template <class Entry>
void add_entries(std::vector<Entry>& list, const std::vector<Entry>& more) {
    for (const Entry& other : more) {
        const auto first = std::ranges::lower_bound(list, other.name, {}, &Entry::name);
        const auto last = std::ranges::upper_bound(list, other.name, {}, &Entry::name);
        const auto place =
            std::find_if(first, last, [&](const Entry& entry) { return is_same_thing(entry, other); });
        if (place == last) {
            list.insert(last, other);
            continue;
        }
        if (place_of(*place) < 0) place_of(*place) = place_of(other);
        add_stages(place->stages, other.stages);
        place->usage.unused = place->usage.unused && other.usage.unused;
    }
}

/// Makes the outermost extent of an array the larger one; whether nothing else about the arrays differs.
bool extend(std::vector<int>& array, const std::vector<int>& other) {
    if (array.size() != other.size() ||
        !std::equal(array.begin() + !array.empty(), array.end(), other.begin() + !other.empty()))
        return false;
    if (!array.empty()) array.front() = std::max(array.front(), other.front());
    return true;
}

bool absorb(Block& block, const Block& other) {
    if (block.members == other.members) return true;
    if (block.members.empty() || block.members.size() != other.members.size()) return false;
    // The array that ends both may have another extent.
    Block wider = block;
    Member& last = wider.members.back();
    const Member& other_last = other.members.back();
    if (last.array.empty() || last.array.front() == 0 || !extend(last.array, other_last.array)) return false;
    const bool is_wider = last.array.front() != block.members.back().array.front();
    Member same = other_last;
    same.array = last.array;
    const auto is_behind = [&](const Member& member) { return member.offset > last.offset; };
    if (last != same || std::ranges::any_of(wider.members, is_behind) ||
        !std::equal(wider.members.begin(), wider.members.end() - 1, other.members.begin()))
        return false;
    if (is_wider) wider.size = other.size;
    block = std::move(wider);
    return true;
}

/// Adds what structs of uniforms lack of each other.
bool absorb_members(std::vector<Member>& members, const std::vector<Member>& others) {
    for (const Member& other : others) {
        const auto member = std::ranges::find(members, other.name, &Member::name);
        if (member == members.end())
            members.push_back(other);
        else if (member->type != other.type || !extend(member->array, other.array) ||
                 !absorb_members(member->members, other.members))
            return false;
    }
    return true;
}

bool absorb(Uniform& uniform, const Uniform& other) {
    if (uniform.type != other.type) return false;
    Uniform wider = uniform;
    if (!extend(wider.array, other.array) || !absorb_members(wider.members, other.members)) return false;
    // Where the location is stated, those of the elements follow from the members.
    const bool is_stated = uniform.location >= 0 || other.location >= 0;
    if (is_stated && (wider.members != uniform.members || wider.members != other.members)) return false;
    uniform = std::move(wider);
    return true;
}

bool absorb(Sampler& sampler, const Sampler& other) {
    return sampler.type == other.type && extend(sampler.array, other.array);
}

bool absorb(Variable& variable, const Variable& other) {
    return variable.type == other.type && variable.array == other.array;
}

/// Makes the entry serve a program that declares `other`, where one declaration can serve both.
template <class Entry>
bool serve_both(Entry& entry, const Entry& other) {
    const int place = place_of(entry);
    const int other_place = place_of(other);
    if (place >= 0 && other_place >= 0 && place != other_place) return false;
    if constexpr (requires { entry.set; })
        if (entry.set != other.set) return false;
    if (!absorb(entry, other)) return false;
    place_of(entry) = std::max(place, other_place);
    entry.usage.unused = entry.usage.unused && other.usage.unused;
    if constexpr (requires { entry.stages; }) add_stages(entry.stages, other.stages);
    return true;
}

/// Adds the constants that a list lacks.
void add_constants(std::vector<SpecializationConstant>& list,
                   const std::vector<SpecializationConstant>& more) {
    for (const SpecializationConstant& constant : more)
        if (std::ranges::find(list, constant) == list.end()) list.push_back(constant);
    std::ranges::sort(list, {}, [](const auto& constant) { return std::pair(constant.name, constant.id); });
}

/// Unites one list of all programs.
template <class Entry>
void unite_list(const std::string& kind, std::vector<Entry> Interface::*list,
                const std::vector<Interface>& programs, United& united) {
    struct Declarations {
        std::vector<Entry> entries;
        std::map<std::size_t, int> declared;  ///< by program
        bool differ_by_stage = false;         ///< of Vulkan's a program may have several by one name
    };
    std::map<std::string, Declarations> names;
    const auto add = [&names](std::size_t program, const Entry& entry) {
        auto& [entries, declared, differ_by_stage] = names[entry.name];
        const auto serves = [&](Entry& other) { return serve_both(other, entry); };
        auto place = std::ranges::find_if(entries, serves);
        if (place == entries.end()) place = entries.insert(place, entry);
        const int number = static_cast<int>(place - entries.begin()) + 1;
        const auto [known, is_new] = declared.try_emplace(program, number);
        differ_by_stage = differ_by_stage || (!is_new && known->second != number);
    };
    // Those that state a place come first: one that states none joins them, whatever the order of the
    // programs.
    for (const bool is_stated : {true, false})
        for (std::size_t program = 0; program < programs.size(); ++program)
            for (const Entry& entry : programs[program].*list) {
                // A sampler that no stage reads takes no unit.
                if (std::is_same_v<Entry, Sampler> && entry.usage.unused) continue;
                if ((place_of(entry) >= 0) == is_stated) add(program, entry);
            }
    for (auto& [name, declarations] : names) {
        if (declarations.entries.size() > 1 && !declarations.differ_by_stage) {
            Differing& differing =
                united.differing.emplace_back(Differing{kind, name, std::vector<int>(programs.size())});
            for (const auto& [program, number] : declarations.declared) differing.declared[program] = number;
        }
        std::ranges::move(declarations.entries, std::back_inserter(united.interface.*list));
    }
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

namespace {

/// Each stage may view the one memory of push constants by a block of its own, whatever its name.
void add_push_constants(std::vector<Block>& list, const std::vector<Block>& more) {
    for (const Block& other : more) {
        const auto first = std::ranges::lower_bound(list, other.name, {}, &Block::name);
        const auto last = std::ranges::upper_bound(list, other.name, {}, &Block::name);
        const auto same = std::ranges::find(first, last, other.members, &Block::members);
        if (same == last) {
            list.insert(last, other);
            continue;
        }
        add_stages(same->stages, other.stages);
        same->usage.unused = same->usage.unused && other.usage.unused;
    }
}

}  // namespace

Interface merge(std::vector<Interface> stages) {
    if (stages.empty()) return {};
    std::ranges::stable_sort(stages, {}, [](const Interface& stage) {
        return stage.stages.empty() ? 0 : rank(stage.stages.front());
    });
    Interface program;
    for (const Interface& stage : stages) {
        add_stages(program.stages, stage.stages);
        add_entries(program.blocks, stage.blocks);
        add_entries(program.storage_blocks, stage.storage_blocks);
        add_entries(program.uniforms, stage.uniforms);
        add_entries(program.samplers, stage.samplers);
        add_push_constants(program.push_constants, stage.push_constants);
        add_constants(program.specialization_constants, stage.specialization_constants);
    }
    program.inputs = std::move(stages.front().inputs);
    program.outputs = std::move(stages.back().outputs);
    return program;
}

United unite(const std::vector<Interface>& programs) {
    United united;
    for (const Interface& program : programs) {
        add_stages(united.interface.stages, program.stages);
        add_constants(united.interface.specialization_constants, program.specialization_constants);
    }
    unite_list("uniform block", &Interface::blocks, programs, united);
    unite_list("storage block", &Interface::storage_blocks, programs, united);
    unite_list("uniform", &Interface::uniforms, programs, united);
    unite_list("sampler", &Interface::samplers, programs, united);
    unite_list("input", &Interface::inputs, programs, united);
    unite_list("output", &Interface::outputs, programs, united);
    unite_list("push constant block", &Interface::push_constants, programs, united);
    return united;
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
