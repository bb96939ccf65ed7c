#include <algorithm>
#include <array>
#include <functional>

#include <fmt/format.h>

#include "compose/dialect.hpp"
#include "spirv/glsl_type.hpp"
#include "validate/declaration.hpp"
#include "validate/guarantees.hpp"
#include "validate/link_rules.hpp"

namespace gobo {
namespace {

/// 4096 vectors of four: what AMD's, Intel's and Mesa's drivers offer, and none more.
constexpr int kMostComponents = 16384;

/// Rows of four components that varyings take by the packing of OpenGL ES 3.00 (chapter 11): the widest
/// first, each in the rows where it fits beside others. Columns are numbered from 0.
int packed_rows(const std::vector<Variable>& inputs) {
    struct Strip {
        int width;
        int height;
    };
    std::vector<Strip> strips;
    for (const Variable& input : inputs) {
        const GlslType type = glsl_type(input.type).value_or(GlslType{});
        if (!input.usage.unused)
            strips.push_back({type.rows, std::max(type.columns * element_count(input.array), 1)});
    }
    std::ranges::stable_sort(strips, [](const Strip& one, const Strip& other) {
        return std::pair(one.width, one.height) > std::pair(other.width, other.height);
    });
    std::vector<int> used;  // components taken of each row, from the left: the widest come first
    for (const Strip& strip : strips) {
        std::size_t first = 0;
        const auto fits = [&](std::size_t row) { return row >= used.size() || used[row] + strip.width <= 4; };
        for (std::size_t row = 0; row < first + static_cast<std::size_t>(strip.height); ++row)
            if (!fits(row)) first = row + 1;
        used.resize(std::max(used.size(), first + static_cast<std::size_t>(strip.height)), 0);
        for (std::size_t row = first; row < first + static_cast<std::size_t>(strip.height); ++row)
            used[row] += strip.width;
    }
    return static_cast<int>(used.size());
}

int component_count(const std::string& type, const std::vector<int>& array,
                    const std::vector<Member>& members) {
    int components = members.empty() ? glsl_type(type).value_or(GlslType{}).components() : 0;
    for (const Member& member : members)
        components += component_count(member.type, member.array, member.members);
    // An array of two thousand million vectors is beyond every limit, whatever its exact number.
    const std::int64_t all = std::int64_t{components} * std::max(element_count(array), 1);
    return static_cast<int>(std::min<std::int64_t>(all, 1 << 30));
}

/// "GEOMETRY" and "TESS_CONTROL", as OpenGL's constants have them.
std::string upper(std::string_view name) {
    std::string text(name);
    for (char& letter : text)
        if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
    return text;
}

class LimitCheck {
  public:
    LimitCheck(const std::vector<StageView>& stages, Dialect dialect) : stages_(stages), dialect_(dialect) {
        const GlslVersion version = version_of(stages.front().pieces.front()->text);
        is_es_ = version.es;
        version_ = version.number;
        block_bindings_ = dialect == Dialect::glsl330 ? 36 : dialect == Dialect::es300 ? 24 : 84;
        units_ = is_es_ ? 32 : version.number < 400 ? 48 : 80;
        if (dialect == Dialect::vulkan) {
            block_bindings_ = units_ = kMostComponents;  // bindings are mere names
            rows_of_varyings_ = 16;
            varying_components_ = 64;
        }
    }

    Diagnostics run() {
        for (const StageView& stage : stages_) check_stage(stage);
        const StageView* before = nullptr;
        for (const StageView& stage : stages_) {
            if (stage.kind == StageKind::fragment) check_varyings(before, stage);
            before = &stage;
        }
        const StageView& first = stages_.front();
        if (first.kind == StageKind::vertex)
            check_locations(first, first.interface.inputs, 16, "vertex attribute", "MAX_VERTEX_ATTRIBS");
        const StageView& last = stages_.back();
        if (last.kind == StageKind::fragment) check_outputs(last);
        return std::move(found_);
    }

  private:
    void at_most(int limit, std::int64_t needed, const StageView& stage, const std::string& name,
                 const std::string& what, std::string_view constant, Severity severity = Severity::error) {
        if (needed <= guaranteed(dialect_, limit, constant)) return;
        if (needed <= limit) severity = Severity::warning;
        const Declaration at = name.empty() ? Declaration{{stage.pieces.back()->path, 0, 0}, "", false}
                                            : declaration_of(name, "", stage.pieces);
        found_.push_back(diagnostic_at(
            at, severity,
            fmt::format("{} {}, {}", what, needed, guarantee_text(dialect_, needed, limit, constant)),
            "use fewer, or forbid the combination by a rule of the family"));
    }

    void check_stage(const StageView& stage) {
        const std::string_view name = name_of(stage.kind);
        constexpr int kBlockBytes = 16384;
        constexpr int kBlocksOfStage = 12;
        constexpr int kSamplersOfStage = 16;
        const Interface& interface = stage.interface;
        at_most(kBlocksOfStage, static_cast<int>(interface.blocks.size()), stage, "",
                fmt::format("uniform blocks in the {} stage:", name),
                fmt::format("MAX_{}_UNIFORM_BLOCKS", upper(name)));
        std::int64_t samplers = 0;
        std::int64_t images = 0;
        for (const Sampler& sampler : interface.samplers) {
            if (sampler.usage.unused) continue;
            const bool is_image = sampler.type.find("image") != std::string::npos;
            (is_image ? images : samplers) += element_count(sampler.array);
            if (sampler.type.find("sampler") != std::string::npos && sampler.binding >= 0)
                at_most(units_, std::int64_t{sampler.binding} + element_count(sampler.array), stage,
                        sampler.name, fmt::format("texture units up to that of '{}':", sampler.name),
                        "MAX_COMBINED_TEXTURE_IMAGE_UNITS");
        }
        // By the tables of implementation-dependent values of OpenGL 4.3, OpenGL ES 3.1 and 3.2; most drivers
        // have more, and have them in every stage: up to `usual`, which Mesa's software renderer has.
        const bool is_compute = stage.kind == StageKind::compute;
        const bool may_store =
            is_compute || (stage.kind == StageKind::fragment && !(is_es_ && version_ < 320));
        const int stored = !may_store ? 0 : is_es_ ? 4 : 8;
        const auto offered = [&](int limit, std::int64_t count, std::string_view what,
                                 std::string_view constant, int usual) {
            at_most(limit, count, stage, "", fmt::format("{} in the {} stage:", what, name),
                    fmt::format("MAX_{}_{}", upper(name), constant),
                    count > usual ? Severity::error : Severity::warning);
        };
        if (dialect_ != Dialect::vulkan) {
            offered(stored, images, "images", "IMAGE_UNIFORMS", 32);
            std::int64_t counters = 0;
            for (const Uniform& uniform : interface.uniforms)
                if (uniform.type == "atomic_uint" && !uniform.usage.unused)
                    counters += element_count(uniform.array);
            offered(may_store ? 8 : 0, counters, "atomic counters", "ATOMIC_COUNTERS", 4096);
            const auto blocks = std::ranges::count_if(interface.storage_blocks,
                                                      [](const Block& block) { return !block.usage.unused; });
            offered(stored, blocks, "storage blocks", "SHADER_STORAGE_BLOCKS", 16);
        }
        at_most(kSamplersOfStage, samplers, stage, "", fmt::format("samplers in the {} stage:", name),
                "MAX_TEXTURE_IMAGE_UNITS");
        for (const Block& block : interface.blocks) {
            at_most(kBlockBytes, block.size, stage, block.name,
                    fmt::format("bytes of the uniform block '{}':", block.name), "MAX_UNIFORM_BLOCK_SIZE");
            at_most(block_bindings_, std::int64_t{block.binding} + 1, stage, block.name,
                    fmt::format("uniform buffer bindings up to that of '{}':", block.name),
                    "MAX_UNIFORM_BUFFER_BINDINGS");
        }
        // AMD's and NVIDIA's drivers offer more bindings of storage blocks than are guaranteed, none more
        // than 96.
        for (const Block& block : interface.storage_blocks) {
            if (dialect_ == Dialect::vulkan) break;
            const std::int64_t binding = std::int64_t{block.binding} + 1;
            at_most(binding > 96 ? 96 : 8, binding, stage, block.name,
                    fmt::format("storage buffer bindings up to that of '{}':", block.name),
                    "MAX_SHADER_STORAGE_BUFFER_BINDINGS", binding > 96 ? Severity::error : Severity::warning);
        }
        int components = 0;
        std::string largest;
        int most = 0;
        for (const Uniform& uniform : interface.uniforms) {
            if (dialect_ != Dialect::vulkan && uniform.location >= 0)
                at_most(1024, std::int64_t{uniform.location} + element_count(uniform.array), stage,
                        uniform.name, fmt::format("uniform locations up to the last of '{}':", uniform.name),
                        "MAX_UNIFORM_LOCATIONS", Severity::warning);
            const int own = component_count(uniform.type, uniform.array, uniform.members);
            if (uniform.usage.unused || uniform.type == "atomic_uint") continue;
            if (own > kMostComponents)
                found_.push_back(diagnostic_at(
                    declaration_of(uniform.name, "", stage.pieces), Severity::error,
                    fmt::format("the uniform '{}' has {} components, more than {}: no driver offers so many",
                                uniform.name, own, kMostComponents),
                    "keep so much in a texture or in a shader storage block"));
            if (own > kMostComponents) continue;
            components = std::min(components + own, 1 << 30);
            if (own > most) largest = uniform.name;
            most = std::max(most, own);
        }
        const bool is_fragment = stage.kind == StageKind::fragment;
        const bool is_usual = is_fragment || stage.kind == StageKind::vertex;
        at_most(!is_usual               ? 512
                : is_es_ && is_fragment ? 896
                                        : 1024,
                components, stage, largest,
                fmt::format("components of plain uniforms in the {} stage:", name),
                fmt::format("MAX_{}_UNIFORM_COMPONENTS", upper(name)),
                Severity::warning);  // most offer 4096, and the bones of animated models need them
    }

    /// `before` is the stage whose outputs reach the fragment stage, if there is one.
    void check_varyings(const StageView* before, const StageView& fragment) {
        const std::vector<Variable>& inputs = fragment.interface.inputs;
        std::int64_t components = 0;
        for (const Variable& input : inputs)
            if (!input.usage.unused)
                components += std::int64_t{1} * glsl_type(input.type).value_or(GlslType{}).components() *
                              element_count(input.array);
        at_most(varying_components_, components, fragment, "",
                "varying components:", "MAX_VARYING_COMPONENTS");
        const std::size_t found = found_.size();
        if (components <= varying_components_) {
            if (before != nullptr) check_varying_locations(*before, before->interface.outputs);
            if (found_.size() == found) check_varying_locations(fragment, inputs);
        }
        if (is_es_ && found_.size() == found && components <= varying_components_)
            at_most(rows_of_varyings_, packed_rows(inputs), fragment, "",
                    "varying vectors:", "MAX_VARYING_VECTORS");
    }

    /// Stated locations are four components each, whether or not the variable takes them all.
    void check_varying_locations(const StageView& stage, const std::vector<Variable>& list) {
        std::int64_t needed = 0;
        for (const Variable& variable : list) {
            if (variable.location < 0) continue;
            const std::int64_t count = location_count(variable.type, variable.array);
            if (!variable.usage.unused && variable.component == 0) needed += count;
            if (variable.location + count <= rows_of_varyings_) continue;
            at_most(rows_of_varyings_, variable.location + count, stage, variable.name,
                    fmt::format("locations of varyings up to the last of '{}':", variable.name),
                    "MAX_VARYING_COMPONENTS / 4");
            return;
        }
        at_most(rows_of_varyings_, needed, stage, "", "varying vectors:", "MAX_VARYING_VECTORS");
    }

    void check_outputs(const StageView& stage) {
        const int limit = is_es_ ? 4 : 8;
        const auto least = static_cast<int>(guaranteed(dialect_, limit, "MAX_DRAW_BUFFERS"));
        const std::size_t found = found_.size();
        for (const auto& [most, severity] :
             {std::pair{limit, Severity::error}, std::pair{least, Severity::warning}})
            if (found_.size() == found)
                check_locations(stage, stage.interface.outputs, most, "fragment output", "MAX_DRAW_BUFFERS",
                                severity);
    }

    /// Attributes or fragment outputs: each column of a matrix and each element of an array takes a location.
    void check_locations(const StageView& stage, const std::vector<Variable>& list, int limit,
                         std::string_view what, std::string_view constant,
                         Severity severity = Severity::error) {
        std::int64_t needed = 0;
        for (const Variable& variable : list) {
            const std::int64_t count = location_count(variable.type, variable.array);
            if (variable.location >= 0 && variable.location + count > limit)
                return at_most(limit, variable.location + count, stage, variable.name,
                               fmt::format("{} locations up to the last of '{}':", what, variable.name),
                               constant, severity);
            // A column of three or four doubles counts twice among attributes (OpenGL 4.6, 11.1.1).
            const GlslType type = glsl_type(variable.type).value_or(GlslType{});
            const bool is_wide =
                stage.kind == StageKind::vertex && type.scalar == Scalar::float64 && type.rows > 2;
            if (!variable.usage.unused && variable.component == 0) needed += is_wide ? 2 * count : count;
        }
        if (needed > limit)
            return at_most(limit, needed, stage, "", fmt::format("{} locations:", what), constant, severity);
        check_room(stage, list, limit, what, constant);
    }

    /// What states no location takes free ones in a row, the largest first, as drivers do (OpenGL 4.6, 11.1.1
    /// and 15.2.3).
    void check_room(const StageView& stage, const std::vector<Variable>& list, int limit,
                    std::string_view what, std::string_view constant) {
        std::vector<bool> is_taken(static_cast<std::size_t>(limit), false);
        const auto take = [&](std::int64_t first, std::int64_t count) {
            std::fill_n(is_taken.begin() + first, count, true);
        };
        std::vector<std::pair<std::int64_t, const Variable*>> open;
        for (const Variable& variable : list) {
            if (variable.usage.unused) continue;
            const std::int64_t count = location_count(variable.type, variable.array);
            if (variable.location >= 0)
                take(variable.location, count);
            else
                open.emplace_back(count, &variable);
        }
        std::ranges::stable_sort(open, std::greater(), &decltype(open)::value_type::first);
        for (const auto& [count, variable] : open) {
            const auto room = std::search_n(is_taken.begin(), is_taken.end(), count, false);
            if (room != is_taken.end()) {
                take(room - is_taken.begin(), count);
                continue;
            }
            found_.push_back(diagnostic_at(
                declaration_of(variable->name, variable->type, stage.pieces), Severity::error,
                fmt::format(
                    "the {} '{}' takes {} locations in a row, and no {} in a row of the {} that OpenGL "
                    "guarantees are free ({})",
                    what, variable->name, count, count, limit, constant),
                "state locations that leave it room"));
            return;
        }
    }

    const std::vector<StageView>& stages_;
    Dialect dialect_;
    bool is_es_ = false;
    int version_ = 0;
    int block_bindings_ = 0;
    int units_ = 0;
    int rows_of_varyings_ = 15;
    int varying_components_ = 60;  ///< 15 vectors of four
    Diagnostics found_;
};

}  // namespace

Diagnostics check_limits(const std::vector<StageView>& stages, Dialect dialect) {
    return LimitCheck(stages, dialect).run();
}

}  // namespace gobo
