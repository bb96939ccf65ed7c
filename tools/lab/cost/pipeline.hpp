// The stages of a pipeline as a Vulkan driver takes them: gobo's SPIR-V is for OpenGL.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/diagnostic.hpp"
#include "core/stage.hpp"
#include "spirv/glsl_type.hpp"

namespace gobo::cost {

using Words = std::vector<std::uint32_t>;

struct Descriptor {
    enum class Kind {
        uniform_buffer,
        storage_buffer,
        texture,  ///< with its sampler
        texel_buffer,
        image,
        image_buffer,
        bare_texture,
        sampler,
        input_attachment,
    };
    Kind kind = Kind::uniform_buffer;
    std::uint32_t count = 1;  ///< elements of an array
};

struct VertexInput {
    std::uint32_t location = 0;
    Scalar scalar = Scalar::float32;  ///< float32, int32 or uint32
    int components = 4;
};

struct PipelineStage {
    StageKind kind = StageKind::vertex;
    Words words;
    bool loop_varies = false;  ///< whether it has a loop whose turns the driver guesses (has_varying_loop())
};

/// A vertex and a fragment stage, or a compute stage alone, and what they are linked with. Everything is
/// bound in set 0; the binding of a descriptor is its index.
struct Pipeline {
    std::vector<PipelineStage> stages;
    std::vector<Descriptor> descriptors;
    std::vector<VertexInput> inputs;
    std::vector<std::optional<Scalar>> outputs;  ///< of the fragment stage, by location; nothing: none there
    /// Specialisation constants of all stages: constant_id and value.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> constants = {};
    std::uint32_t push_bytes = 0;  ///< of push constants

    [[nodiscard]] bool is_compute() const { return stages.front().kind == StageKind::compute; }
};

/// The pipeline of stages in OpenGL's SPIR-V. What Vulkan has otherwise is rewritten in the words: one space
/// of bindings for blocks and samplers, uniforms outside blocks gathered in one for each stage, varyings
/// matched by location instead of by name, gl_VertexID and the origin of gl_FragCoord. Errors: what Vulkan
/// lacks, such as samplers within structs; their subject is the variable.
[[nodiscard]] Result<Pipeline> pipeline_of(std::vector<PipelineStage> stages_of_opengl);

/// The same of stages in Vulkan's SPIR-V, whose resources are gathered in set 0. Push constants are left to
/// the caller.
[[nodiscard]] Result<Pipeline> pipeline_of_vulkan(std::vector<PipelineStage> stages);

}  // namespace gobo::cost
