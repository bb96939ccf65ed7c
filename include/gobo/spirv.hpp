// What a generated header holds for the dialects vulkan and gl_spirv: SPIR-V, and plain tables of what
// pipelines are made with. No Vulkan and no OpenGL: <gobo/vulkan.hpp> makes Vulkan's structs of the tables.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <gobo/permutation.hpp>

namespace gobo {

/// What a descriptor is, by the numbers of VkDescriptorType.
enum class DescriptorKind : std::uint32_t {
    sampler = 0,
    combined_image_sampler = 1,
    sampled_image = 2,
    storage_image = 3,
    uniform_texel_buffer = 4,
    storage_texel_buffer = 5,
    uniform_buffer = 6,
    storage_buffer = 7,
    input_attachment = 10,
    acceleration_structure = 1000150000,
};

/// Where a sampler is bound.
struct DescriptorPlace {
    int set;
    int binding;
};

namespace runtime {

/// A SPIR-V module.
struct Module {
    const std::uint32_t* words;
    std::size_t count;
};

/// A stage of a permutation: an index into the modules of its generated header. Stages of the same module
/// compare equal, so that an application can keep a map.
template <class Tables>
struct SpirvStage {
    std::uint32_t number = 0;

    /// Where the module begins to run, for vkCreateGraphicsPipelines and glSpecializeShader.
    static constexpr const char* entry_point = "main";

    /// Whether the permutation has the stage: others of its family may have one that it lacks.
    [[nodiscard]] constexpr bool exists() const { return Tables::modules[number].count > 0; }
    [[nodiscard]] constexpr const std::uint32_t* words() const { return Tables::modules[number].words; }
    [[nodiscard]] constexpr std::size_t word_count() const { return Tables::modules[number].count; }
    /// In bytes.
    [[nodiscard]] constexpr std::size_t size() const { return word_count() * sizeof(std::uint32_t); }

    friend constexpr bool operator==(const SpirvStage& left, const SpirvStage& right) {
        return left.number == right.number;
    }
    friend constexpr bool operator!=(const SpirvStage& left, const SpirvStage& right) {
        return !(left == right);
    }
};

/// Whether the module of a stage has the specialisation constant of that constant_id.
template <class Tables>
[[nodiscard]] constexpr bool has_constant(const SpirvStage<Tables>& stage, std::uint32_t id) {
    constexpr std::uint32_t decorate = 71;  // OpDecorate: target, decoration, literals
    constexpr std::uint32_t spec_id = 1;
    for (std::size_t at = 5; at + 3 < stage.word_count() && stage.words()[at] >> 16U != 0;
         at += stage.words()[at] >> 16U)
        if ((stage.words()[at] & 0xffffU) == decorate && stage.words()[at + 2] == spec_id &&
            stage.words()[at + 3] == id)
            return true;
    return false;
}

/// A block or sampler of some permutation, sorted by set and binding. `stages` are the bits of
/// VkShaderStageFlags, of all permutations together.
struct Descriptor {
    std::string_view name;
    std::uint32_t set = 0;
    std::uint32_t binding = 0;
    DescriptorKind kind = DescriptorKind::uniform_buffer;
    std::uint32_t count = 1;  ///< elements of an array
    std::uint32_t stages = 0;
    Only only = {};
};

/// A block of push constants. Stages may each have one of their own: views of the same memory.
struct PushConstants {
    std::string_view name;
    std::uint32_t size = 0;    ///< bytes, from 0 to the end of the last member
    std::uint32_t stages = 0;  ///< as in Descriptor
    std::uint32_t offset = 0;  ///< of the first member
};

/// A location of a vertex attribute: matrices have one for each column, arrays for each element. In Vulkan a
/// column of three or four doubles takes the next location, too.
struct VertexInput {
    std::string_view name;
    std::string_view type;  ///< the GLSL type of the whole attribute
    std::uint32_t location = 0;
    std::uint32_t format = 0;  ///< VkFormat
    std::uint32_t size = 0;    ///< bytes of the column
    Only only = {};
};

/// A constant that is chosen when a pipeline is made.
struct SpecializationConstant {
    std::string_view name;
    std::string_view type;  ///< "int", "uint", "float" or "bool"
    std::uint32_t id = 0;
    std::uint32_t value = 0;  ///< the bits of its default
};

}  // namespace runtime
}  // namespace gobo
