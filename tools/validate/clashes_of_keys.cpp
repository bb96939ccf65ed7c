// What keys that are each fine cannot share: the tables of one header.
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "family/key.hpp"
#include "reflect/descriptor_kind.hpp"
#include "validate/batch.hpp"
#include "validate/declaration.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

class ClashesOfKeys {
  public:
    ClashesOfKeys(const Family& family, const Composition& composition, const Validated& validated)
        : family_(family), composition_(composition), validated_(validated) {}

    Diagnostics run() {
        std::set<int> seen;
        for (const Permutation& permutation : composition_.permutations)
            for (const int stage : permutation.stages.values) {
                if (stage < 0 || !seen.insert(stage).second) continue;
                const Interface& interface = validated_.stage(stage).interface;
                if (composition_.dialect == Dialect::vulkan) {
                    for (const Block& block : interface.blocks)
                        add(permutation, stage, "uniform block", block, "uniform block");
                    for (const Block& block : interface.storage_blocks)
                        add(permutation, stage, "storage block", block, "storage block");
                    for (const Sampler& sampler : interface.samplers)
                        add(permutation, stage, "sampler", sampler, descriptor_kind(sampler.type));
                }
                for (const SpecializationConstant& constant : interface.specialization_constants)
                    add(permutation, stage, constant);
            }
        return std::move(found_);
    }

  private:
    /// What took a place first.
    struct First {
        std::string name;
        int stage;
        const Key* key;
        std::string_view kind = {};  ///< of the descriptor: names are each stage's own
    };

    template <class Resource>
    void add(const Permutation& permutation, int stage, const char* kind, const Resource& resource,
             std::string_view descriptor) {
        const std::string name(root_of(resource.name));  // the elements of an array of blocks share a place
        const auto place = std::pair(resource.set, resource.binding);
        const auto [at, is_new] =
            places_.try_emplace(place, First{name, stage, &permutation.key, descriptor});
        if (is_new || at->second.name == name || at->second.kind == descriptor) return;
        refuse(permutation, declared(name, "", stage), at->second, name,
               fmt::format("the {} '{}' is at set {}, binding {}, where {} binds '{}' for the key '{}'", kind,
                           name, resource.set, resource.binding,
                           declared(at->second.name, "", at->second.stage).text(), at->second.name,
                           key_text(family_, *at->second.key)),
               "all keys share a layout of descriptor sets: list both under [[descriptor_sets]] in the "
               "family, or state other numbers");
    }

    void add(const Permutation& permutation, int stage, const SpecializationConstant& constant) {
        const auto [at, is_new] = constants_.try_emplace(
            constant.id, std::pair(&constant, First{constant.name, stage, &permutation.key}));
        const auto& [known, first] = at->second;
        if (is_new || *known == constant) return;
        const std::string where =
            fmt::format("at {} for the key '{}'", declared(known->name, "constant_id", first.stage).text(),
                        key_text(family_, *first.key));
        refuse(permutation, declared(constant.name, "constant_id", stage), first, constant.name,
               known->name == constant.name && known->type == constant.type
                   ? fmt::format("the default of '{}' with constant_id {} is another {}", constant.name,
                                 constant.id, where)
                   : fmt::format("constant_id {} is the {} '{}', and {} the {} '{}'", constant.id,
                                 constant.type, constant.name, where, known->type, known->name),
               "all keys share a table of constants: declare it alike in all, or give one of them another "
               "constant_id");
    }

    [[nodiscard]] Declaration declared(const std::string& name, std::string_view type, int stage) const {
        return declaration_of(name, type, pieces_of(composition_, stage));
    }

    /// Once for each two names.
    void refuse(const Permutation& permutation, const Declaration& at, const First& first,
                const std::string& name, std::string message, std::string help) {
        if (!told_.emplace(first.name, name).second) return;
        found_.push_back(diagnostic_at(at, Severity::error, std::move(message), std::move(help)));
        found_.back().subject = key_text(family_, permutation.key);
    }

    const Family& family_;
    const Composition& composition_;
    const Validated& validated_;
    std::map<std::pair<int, int>, First> places_;
    std::map<int, std::pair<const SpecializationConstant*, First>> constants_;  ///< by constant_id
    std::set<std::pair<std::string, std::string>> told_;
    Diagnostics found_;
};

}  // namespace

Diagnostics clashes_of_keys(const Family& family, const Composition& composition,
                            const Validated& validated) {
    if (!is_spirv(composition.dialect)) return {};
    return ClashesOfKeys(family, composition, validated).run();
}

}  // namespace gobo
