// Bindings, texture units, locations and places of counters that two names of a program share.
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "spirv/glsl_type.hpp"
#include "validate/declaration.hpp"
#include "validate/link_rules.hpp"

namespace gobo {
namespace {

class SharedPlaces {
  public:
    explicit SharedPlaces(const std::vector<StageView>& stages) : stages_(stages) {}

    Diagnostics run() {
        check_bindings();
        check_units();
        check_uniform_locations();
        check_counters();
        check_attributes();
        return std::move(found_);
    }

  private:
    void add(const Declaration& at, Severity severity, std::string message, std::string help) {
        found_.push_back(diagnostic_at(at, severity, std::move(message), std::move(help)));
    }

    /// A binding or unit range that one name takes in one of the stages.
    struct Taken {
        std::string_view name;
        std::string type;
        std::int64_t first;
        std::int64_t count;
        const StageView* stage;
    };

    template <class Say>
    void for_each_overlap(const std::vector<Taken>& places, const Say& say) {
        std::set<std::pair<std::string_view, std::string_view>> told;
        for (auto one = places.begin(); one != places.end(); ++one)
            for (auto other = places.begin(); other != one; ++other) {
                if (one->first >= other->first + other->count || other->first >= one->first + one->count)
                    continue;
                if (one->name == other->name) continue;
                if (told.emplace(root_of(one->name), root_of(other->name)).second)
                    say(*one, *other, std::max(one->first, other->first));
            }
    }

    [[nodiscard]] static Declaration declared(const Taken& taken) {
        return declaration_of(taken.name, taken.type, taken.stage->pieces);
    }

    void check_bindings() {
        for (const auto blocks : {&Interface::blocks, &Interface::storage_blocks}) {
            std::vector<Taken> places;
            for (const StageView& stage : stages_)
                for (const Block& block : stage.interface.*blocks)
                    if (block.binding >= 0 && block.set < 0 && !block.usage.unused)
                        places.push_back({block.name, "", block.binding, 1, &stage});
            for_each_overlap(places, [&](const Taken& one, const Taken& other, std::int64_t binding) {
                if (root_of(one.name) == root_of(other.name)) return;
                add(declared(one), Severity::warning,
                    fmt::format("the blocks '{}' and '{}' ({}) share binding {}: both read the same buffer",
                                one.name, other.name, declared(other).text(), binding),
                    "give each a binding of its own");
            });
        }
    }

    void check_units() {
        std::vector<Taken> places;
        for (const StageView& stage : stages_)
            for (const Sampler& sampler : stage.interface.samplers)
                if (sampler.binding >= 0 && sampler.set < 0 && !sampler.usage.unused &&
                    sampler.type.find("sampler") != std::string::npos)
                    places.push_back(
                        {sampler.name, sampler.type, sampler.binding, element_count(sampler.array), &stage});
        // Mesa 22.3 takes the last unit of such an array for that before the first.
        for (const StageView& stage : stages_)
            for (const Sampler& sampler : stage.interface.samplers)
                if (sampler.binding == 0 && sampler.set < 0 && sampler.usage.stated == "[]")
                    add(declaration_of(sampler.name, sampler.type, stage.pieces), Severity::error,
                        fmt::format("the array '{}' states binding 0 and no size: some drivers refuse it",
                                    sampler.name),
                        "state its size");
        for_each_overlap(places, [&](const Taken& one, const Taken& other, std::int64_t unit) {
            const bool is_refused = one.type != other.type;
            add(declared(one), is_refused ? Severity::error : Severity::warning,
                fmt::format("'{} {}' and '{} {}' ({}) share texture unit {}{}", one.type, one.name,
                            other.type, other.name, declared(other).text(), unit,
                            is_refused ? ": OpenGL refuses to draw (INVALID_OPERATION)"
                                       : ": both read the same texture"),
                "give each a unit of its own");
        });
    }

    /// Each counter has its own place in its buffer (GLSL 4.60, 4.4.6.1).
    void check_counters() {
        std::vector<Taken> places;
        constexpr std::int64_t kBuffer = std::int64_t{1} << 31;  // keeps buffers apart
        for (const StageView& stage : stages_)
            for (const Uniform& uniform : stage.interface.uniforms)
                if (uniform.counter_offset >= 0 && !uniform.usage.unused)
                    places.push_back({uniform.name, uniform.type,
                                      uniform.counter_binding * kBuffer + uniform.counter_offset,
                                      std::int64_t{4} * element_count(uniform.array), &stage});
        for_each_overlap(places, [&](const Taken& one, const Taken& other, std::int64_t place) {
            add(declared(one), Severity::error,
                fmt::format("the atomic counters '{}' and '{}' ({}) share offset {} of binding {}", one.name,
                            other.name, declared(other).text(), place % kBuffer, place / kBuffer),
                "state another offset: a counter takes 4 bytes, an array 4 for each element");
        });
    }

    /// Each element of an array and each member of a struct has a location of its own.
    [[nodiscard]] static std::int64_t locations_of(const std::vector<int>& array,
                                                   const std::vector<Member>& members) {
        std::int64_t inner = members.empty() ? 1 : 0;
        for (const Member& member : members) inner += locations_of(member.array, member.members);
        return std::min<std::int64_t>(inner, 1 << 30) * element_count(array);
    }

    void check_uniform_locations() {
        std::vector<Taken> places;
        for (const StageView& stage : stages_) {
            for (const Uniform& uniform : stage.interface.uniforms)
                if (uniform.location >= 0)
                    places.push_back({uniform.name, uniform.type, uniform.location,
                                      locations_of(uniform.array, uniform.members), &stage});
            for (const Sampler& sampler : stage.interface.samplers)
                if (sampler.location >= 0)
                    places.push_back(
                        {sampler.name, sampler.type, sampler.location, element_count(sampler.array), &stage});
        }
        for_each_overlap(places, [&](const Taken& one, const Taken& other, std::int64_t location) {
            add(declared(one), Severity::error,
                fmt::format("the uniforms '{}' and '{}' ({}) share location {}", one.name, other.name,
                            declared(other).text(), location),
                "an array takes a location for each element: count on behind it");
        });
    }

    /// OpenGL links attributes that share a location, if no path through the stage reads both
    /// (OpenGL 4.6, 11.1.1).
    void check_attributes() {
        const StageView& first = stages_.front();
        if (first.kind != StageKind::vertex) return;
        std::vector<Taken> places;
        for (const Variable& input : first.interface.inputs)
            // Those of other components share a location by right.
            if (input.location >= 0 && input.component == 0 && !input.usage.unused)
                places.push_back({input.name, input.type, input.location,
                                  location_count(input.type, input.array), &first});
        for_each_overlap(places, [&](const Taken& one, const Taken& other, std::int64_t location) {
            add(declared(one), Severity::warning,
                fmt::format("the attributes '{} {}' and '{} {}' ({}) share location {}: OpenGL takes it only "
                            "where no path reads both",
                            one.type, one.name, other.type, other.name, declared(other).text(), location),
                "give each a location of its own: a matrix takes one for each column, an array for each "
                "element");
        });
    }

    const std::vector<StageView>& stages_;
    Diagnostics found_;
};

}  // namespace

Diagnostics check_shared_places(const std::vector<StageView>& stages) {
    return SharedPlaces(stages).run();
}

}  // namespace gobo
