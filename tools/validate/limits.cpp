#include "validate/limits.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "spirv/glsl_type.hpp"

namespace gobo {
namespace {

class Checker {
  public:
    explicit Checker(Place place) : place_(std::move(place)) {}

    void at_most(int needed, int limit, const std::string& what, std::string_view constant) {
        if (needed <= limit) return;
        Diagnostic diagnostic;
        diagnostic.place = place_;
        diagnostic.message =
            fmt::format("{} {}, OpenGL guarantees only {} ({})", what, needed, limit, constant);
        diagnostic.help = "use fewer, or forbid the combination by a rule of the family";
        found_.push_back(std::move(diagnostic));
    }

    void stage(const Interface& interface, std::string_view name, const Limits& limits) {
        at_most(static_cast<int>(interface.blocks.size()), limits.uniform_blocks_per_stage,
                fmt::format("uniform blocks in the {} stage:", name),
                "MAX_VERTEX_UNIFORM_BLOCKS, MAX_FRAGMENT_UNIFORM_BLOCKS");
        int samplers = 0;
        for (const Sampler& sampler : interface.samplers) samplers += element_count(sampler.array);
        at_most(samplers, limits.samplers_per_stage, fmt::format("samplers in the {} stage:", name),
                "MAX_TEXTURE_IMAGE_UNITS");
        for (const Block& block : interface.blocks) {
            at_most(block.size, limits.uniform_block_size,
                    fmt::format("bytes of the uniform block '{}':", block.name), "MAX_UNIFORM_BLOCK_SIZE");
            at_most(block.binding + 1, limits.uniform_buffer_bindings,
                    fmt::format("uniform buffer bindings up to that of '{}':", block.name),
                    "MAX_UNIFORM_BUFFER_BINDINGS");
        }
    }

    [[nodiscard]] Diagnostics found() && { return std::move(found_); }

  private:
    Place place_;
    Diagnostics found_;
};

}  // namespace

Limits limits_of(Dialect dialect) {
    Limits limits;
    if (dialect == Dialect::glsl330) limits.uniform_buffer_bindings = 36;
    if (dialect == Dialect::es300) limits.uniform_buffer_bindings = 24;
    return limits;
}

Diagnostics beyond_limits(const Interface& vertex, const Interface& fragment, const Limits& limits,
                          const Place& place) {
    Checker checker(place);
    checker.stage(vertex, "vertex", limits);
    checker.stage(fragment, "fragment", limits);
    int components = 0;
    int vectors = 0;
    for (const Variable& input : fragment.inputs) {
        components += glsl_type(input.type).value_or(GlslType{}).components() * element_count(input.array);
        vectors += location_count(input.type, input.array);
    }
    checker.at_most(components, limits.varying_components, "varying components:", "MAX_VARYING_COMPONENTS");
    if (components <= limits.varying_components)
        checker.at_most(vectors, limits.varying_vectors, "varying vectors:", "MAX_VARYING_VECTORS");
    checker.at_most(static_cast<int>(vertex.inputs.size()), limits.vertex_attributes,
                    "vertex attributes:", "MAX_VERTEX_ATTRIBS");
    return std::move(checker).found();
}

Diagnostics unwritten_inputs(const Interface& vertex, const Interface& fragment, const Place& place) {
    Diagnostics found;
    for (const Variable& input : fragment.inputs) {
        const bool is_written =
            std::any_of(vertex.outputs.begin(), vertex.outputs.end(), [&](const Variable& output) {
                return input.location >= 0 && output.location >= 0 ? input.location == output.location
                                                                   : input.name == output.name;
            });
        if (is_written) continue;
        Diagnostic diagnostic;
        diagnostic.place = place;
        diagnostic.message =
            fmt::format("the fragment stage reads '{} {}', which the vertex stage does not write", input.type,
                        input.name);
        diagnostic.help = "declare and write it as an output of the vertex stage";
        found.push_back(std::move(diagnostic));
    }
    return found;
}

}  // namespace gobo
