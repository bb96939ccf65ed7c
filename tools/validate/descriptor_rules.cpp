// Where Vulkan binds the resources of a program: each place holds one.
#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "compose/dialect.hpp"
#include "reflect/descriptor_kind.hpp"
#include "spirv/glsl_type.hpp"
#include "validate/declaration.hpp"
#include "validate/glslang_log.hpp"
#include "validate/link_rules.hpp"

namespace gobo {
namespace {

/// What every device binds at least (Vulkan 1.0, table 53).
constexpr int kGuaranteedSets = 4;
constexpr int kGuaranteedPushConstants = 128;
constexpr const char* kCountedTogether =
    "Vulkan counts blocks and samplers together: list them under [[descriptor_sets]] in the family, or state "
    "other numbers";

class DescriptorCheck {
  public:
    DescriptorCheck(const std::vector<StageView>& stages, const Family& family)
        : stages_(stages), family_(family) {}

    Diagnostics run() {
        for (const StageView& stage : stages_) {
            add_blocks(stage, "uniform block", stage.interface.blocks);
            add_blocks(stage, "storage block", stage.interface.storage_blocks);
            for (const Sampler& sampler : stage.interface.samplers)
                add(stage, "sampler", sampler,
                    {descriptor_kind(sampler.type), with_extents(sampler.type, sampler.array), nullptr});
            for (const Block& block : stage.interface.push_constants) {
                if (const DescriptorSet* const set = set_with(block.name))
                    refuse(stage, block.name,
                           fmt::format("'{}' are push constants, which no set holds, but {} lists them",
                                       block.name, text_of(*set)),
                           fmt::format("take '{}' out of the set", block.name));
                if (block.size > kGuaranteedPushConstants)
                    add_warning(
                        stage, block.name,
                        fmt::format("the push constants '{}' take {} bytes", block.name, block.size),
                        fmt::format("Vulkan guarantees {}: put some into a block", kGuaranteedPushConstants));
            }
        }
        return std::move(found_);
    }

  private:
    /// What stages that bind it must agree about.
    struct Bound {
        std::string_view kind;
        std::string type;    ///< of a sampler; of a block its extents
        const Block* block;  ///< null of a sampler
    };

    struct Taken {
        std::string name;
        const StageView* stage;
        Bound bound;
    };

    void add_blocks(const StageView& stage, const char* kind, const std::vector<Block>& blocks) {
        for (const Block& block : blocks) {
            const auto elements = std::ranges::count(blocks, root_of(block.name),
                                                     [](const Block& one) { return root_of(one.name); });
            add(stage, kind, block,
                {kind, elements > 1 ? fmt::format("block[{}]", elements) : "block", &block});
        }
    }

    template <class Resource>
    void add(const StageView& stage, const char* kind, const Resource& resource, const Bound& bound) {
        const std::string name(root_of(resource.name));  // the elements of an array of blocks share a place
        const auto place = std::pair(resource.set, resource.binding);
        const auto [at, is_new] = taken_.try_emplace(place, Taken{name, &stage, bound});
        if (!is_new)
            compare(stage,
                    fmt::format("the {} '{}' is at set {}, binding {}", kind, name, resource.set,
                                resource.binding),
                    name, bound, at->second);
        const DescriptorSet* const set = set_with(name);
        const DescriptorPlace listed = descriptor_place(family_, name, resource.binding, false);
        if (set != nullptr && place != std::pair(listed.set, listed.binding))
            refuse(stage, name,
                   fmt::format("the {} '{}' is at set {}, binding {}, but {} lists it, at set {}, binding {}",
                               kind, name, resource.set, resource.binding, text_of(*set), listed.set,
                               listed.binding),
                   "declare it by BLOCK or SAMPLER, state the place that the family gives it, or take it out "
                   "of the set");
        if (resource.set >= kGuaranteedSets && is_new)
            add_warning(
                stage, name, fmt::format("'{}' is in set {}", name, resource.set),
                fmt::format("Vulkan guarantees {} sets, 0 to {}", kGuaranteedSets, kGuaranteedSets - 1));
    }

    /// Stages may call what is bound there by two names, or view a buffer by two blocks.
    void compare(const StageView& stage, const std::string& here, const std::string& name, const Bound& bound,
                 const Taken& taken) {
        const bool is_same_stage = taken.stage == &stage;
        if (is_same_stage && taken.name == name) return;
        const std::string where = declaration_of(taken.name, "", taken.stage->pieces).text();
        if (is_same_stage || bound.kind != taken.bound.kind)
            return refuse(stage, name, fmt::format("{}, where {} binds '{}'", here, where, taken.name),
                          kCountedTogether);
        if (bound.type != taken.bound.type)
            return refuse(stage, name,
                          fmt::format("{}, as {}, where {} binds '{}' as {}", here, bound.type, where,
                                      taken.name, taken.bound.type),
                          "stages that bind one thing declare it with one type and size; for another state "
                          "another place");
        if (bound.block == nullptr || taken.name != name) return;
        const auto [mine, theirs] = std::ranges::mismatch(bound.block->members, taken.bound.block->members);
        if (mine != bound.block->members.end() && theirs != taken.bound.block->members.end())
            add_warning(
                stage, name,
                fmt::format("{}, with other members than in {}: both read the same buffer", here, where),
                "declare the block once, in a piece that both stages include");
    }

    /// The set of the family's that lists a block or sampler; null where none does.
    [[nodiscard]] const DescriptorSet* set_with(const std::string& name) const {
        for (const DescriptorSet& set : family_.descriptor_sets)
            if (std::ranges::find(set.holds, name) != set.holds.end()) return &set;
        return nullptr;
    }
    static std::string text_of(const DescriptorSet& set) {
        return fmt::format("the set '{}' ({}:{})", set.name, set.holds_place.file, set.holds_place.line);
    }

    void refuse(const StageView& stage, const std::string& name, std::string message, std::string help) {
        found_.push_back(diagnostic_at(declaration_of(name, "", stage.pieces), Severity::error,
                                       std::move(message), std::move(help)));
    }

    void add_warning(const StageView& stage, const std::string& name, std::string message, std::string help) {
        found_.push_back(diagnostic_at(declaration_of(name, "", stage.pieces), Severity::warning,
                                       std::move(message), std::move(help)));
    }

    const std::vector<StageView>& stages_;
    const Family& family_;
    std::map<std::pair<int, int>, Taken> taken_;
    Diagnostics found_;
};

}  // namespace

Diagnostics check_descriptors(const std::vector<StageView>& stages, const Family& family) {
    return DescriptorCheck(stages, family).run();
}

Diagnostics check_constants(const std::vector<StageView>& stages) {
    Diagnostics found;
    std::map<int, std::pair<const SpecializationConstant*, const StageView*>> known;  // by constant_id
    for (const StageView& stage : stages)
        for (const SpecializationConstant& constant : stage.interface.specialization_constants) {
            const auto [at, is_new] = known.try_emplace(constant.id, &constant, &stage);
            const auto& [first, in_stage] = at->second;
            if (is_new || *first == constant) continue;
            const bool is_count = declaration_of(constant.name, "constant_id", stage.pieces).place.file ==
                                  stage.pieces.front()->path;
            if (is_count || declaration_of(first->name, "constant_id", in_stage->pieces).place.file ==
                                in_stage->pieces.front()->path) {
                const auto& [own, own_stage] = is_count ? at->second : std::pair(&constant, &stage);
                const std::string& count = is_count ? constant.name : first->name;
                found.push_back(diagnostic_at(declaration_of(own->name, "constant_id", own_stage->pieces),
                                              Severity::error, id_of_count(constant.id, count),
                                              std::string(kIdsOfCounts)));
                continue;
            }
            const std::string where = declaration_of(first->name, "constant_id", in_stage->pieces).text();
            found.push_back(diagnostic_at(
                declaration_of(constant.name, "constant_id", stage.pieces), Severity::error,
                first->name == constant.name && first->type == constant.type
                    ? fmt::format("the default of '{}' with constant_id {} is another at {}", constant.name,
                                  constant.id, where)
                    : fmt::format("constant_id {} is the {} '{}', and at {} the {} '{}'", constant.id,
                                  constant.type, constant.name, where, first->type, first->name),
                "declare it alike in all stages, or give one of them another constant_id"));
        }
    return found;
}

}  // namespace gobo
