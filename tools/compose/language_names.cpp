#include "compose/language_names.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace gobo {
namespace {

constexpr std::string_view kImages = "GL_ARB_shader_image_load_store";
constexpr std::string_view kTessellation = "_tessellation_shader";

// By the tables of the GLSL 4.60 and GLSL ES 3.20 specifications, chapters 4.4, 7.3 and 8, and those of
// earlier versions.
constexpr std::array kNames = {
    NameSince{"gl_MaxCombinedImageUniforms", 420, 310, kImages},
    NameSince{"gl_MaxCombinedImageUnitsAndFragmentOutputs", 420, 310, kImages},
    NameSince{"gl_MaxCombinedShaderOutputResources", 440, 310, ""},
    NameSince{"gl_MaxCompute*", 430, 310, "GL_ARB_compute_shader"},
    NameSince{"gl_MaxFragmentImageUniforms", 420, 310, kImages},
    NameSince{"gl_MaxGeometryImageUniforms", 420, 320, "GL_ARB_shader_image_load_store _geometry_shader"},
    NameSince{"gl_MaxGeometry*", 150, 320, "_geometry_shader"},
    NameSince{"gl_MaxImageSamples", 420, kNever, kImages},
    NameSince{"gl_MaxImageUnits", 420, 310, kImages},
    NameSince{"gl_MaxPatchVertices", 400, 320, kTessellation},
    NameSince{"gl_MaxSamples", 100, 320, "GL_OES_sample_variables"},
    NameSince{"gl_MaxTessControlImageUniforms", 420, 320,
              "GL_ARB_shader_image_load_store _tessellation_shader"},
    NameSince{"gl_MaxTessEvaluationImageUniforms", 420, 320,
              "GL_ARB_shader_image_load_store _tessellation_shader"},
    NameSince{"gl_MaxTess*", 400, 320, kTessellation},
    NameSince{"gl_MaxVertexImageUniforms", 420, 310, kImages},
    NameSince{"packDouble2x32", 400, kNever, "GL_ARB_gpu_shader_fp64"},
    NameSince{"unpackDouble2x32", 400, kNever, "GL_ARB_gpu_shader_fp64"},
    NameSince{"textureGatherOffsets", 400, 320, "GL_ARB_gpu_shader5 _gpu_shader5"},
    NameSince{"textureQueryLOD", kNever, kNever, "GL_ARB_texture_query_lod"},
    NameSince{"debugPrintfEXT", kVulkan, kVulkan, ""},
    NameSince{"nonuniformEXT", kVulkan, kVulkan, ""},
    NameSince{"subgroupuniformEXT", kVulkan, kVulkan, ""},
};

constexpr std::array kLayouts = {
    NameSince{"align", 440, kNever, "GL_ARB_enhanced_layouts"},
    NameSince{"offset", 440, kNever, "GL_ARB_enhanced_layouts"},
    NameSince{"index", 100, kNever, "GL_EXT_blend_func_extended"},
    NameSince{"origin_upper_left", 150, kNever, "GL_ARB_fragment_coord_conventions"},
    NameSince{"pixel_center_integer", 150, kNever, "GL_ARB_fragment_coord_conventions"},
    NameSince{"buffer_reference", kVulkan, kVulkan, ""},
    NameSince{"buffer_reference_align", kVulkan, kVulkan, ""},
    NameSince{"input_attachment_index", kVulkan, kVulkan, ""},
    NameSince{"push_constant", kVulkan, kVulkan, ""},
    NameSince{"scalar", kVulkan, kVulkan, ""},
    NameSince{"set", kVulkan, kVulkan, ""},
};

struct Owner {
    std::string_view name;  ///< ending in `*`: what begins so
    ExtensionOf owner;
};

// By the registries of OpenGL, OpenGL ES and Vulkan; the first that fits.
constexpr std::array kOwners = {
    Owner{"GL_AMD_*", ExtensionOf::desktop},
    Owner{"GL_ANDROID_*", ExtensionOf::es},
    Owner{"GL_ARB_*", ExtensionOf::desktop},
    Owner{"GL_EXT_YUV_target", ExtensionOf::es},
    Owner{"GL_EXT_blend_func_extended", ExtensionOf::es},
    Owner{"GL_EXT_buffer_reference*", ExtensionOf::vulkan},
    Owner{"GL_EXT_control_flow_attributes*", ExtensionOf::vulkan},
    Owner{"GL_EXT_debug_printf", ExtensionOf::vulkan},
    Owner{"GL_EXT_frag_depth", ExtensionOf::es},
    Owner{"GL_EXT_geometry_*", ExtensionOf::es},
    Owner{"GL_EXT_gpu_shader5", ExtensionOf::es},
    Owner{"GL_EXT_multiview", ExtensionOf::vulkan},
    Owner{"GL_EXT_nonuniform_qualifier", ExtensionOf::vulkan},
    Owner{"GL_EXT_null_initializer", ExtensionOf::vulkan},
    Owner{"GL_EXT_primitive_bounding_box", ExtensionOf::es},
    Owner{"GL_EXT_ray_*", ExtensionOf::vulkan},
    Owner{"GL_EXT_samplerless_texture_functions", ExtensionOf::vulkan},
    Owner{"GL_EXT_scalar_block_layout", ExtensionOf::vulkan},
    Owner{"GL_EXT_shader_16bit_storage", ExtensionOf::vulkan},
    Owner{"GL_EXT_shader_8bit_storage", ExtensionOf::vulkan},
    Owner{"GL_EXT_shader_atomic_*", ExtensionOf::vulkan},
    Owner{"GL_EXT_shader_explicit_*", ExtensionOf::vulkan},
    Owner{"GL_EXT_shader_implicit_conversions", ExtensionOf::es},
    Owner{"GL_EXT_shader_io_blocks", ExtensionOf::es},
    Owner{"GL_EXT_shadow_samplers", ExtensionOf::es},
    Owner{"GL_EXT_shared_memory_block", ExtensionOf::vulkan},
    Owner{"GL_EXT_spirv_intrinsics", ExtensionOf::vulkan},
    Owner{"GL_EXT_subgroupuniform_qualifier", ExtensionOf::vulkan},
    Owner{"GL_EXT_terminate_invocation", ExtensionOf::vulkan},
    Owner{"GL_EXT_tessellation_*", ExtensionOf::es},
    Owner{"GL_EXT_texture_array", ExtensionOf::desktop},
    Owner{"GL_EXT_texture_buffer", ExtensionOf::es},
    Owner{"GL_EXT_texture_cube_map_array", ExtensionOf::es},
    Owner{"GL_GOOGLE_*", ExtensionOf::tools},
    Owner{"GL_INTEL_shader_atomic_float_minmax", ExtensionOf::desktop},
    Owner{"GL_KHR_memory_scope_semantics", ExtensionOf::vulkan},
    Owner{"GL_KHR_vulkan_glsl", ExtensionOf::vulkan},
    Owner{"GL_NV_shader_atomic_float*", ExtensionOf::desktop},
    Owner{"GL_OES_*", ExtensionOf::es},
};

// Those whose functions no version took in, by the same registries.
constexpr std::array<std::string_view, 33> kNeverCore = {
    "GL_AMD_*",
    "GL_ARB_bindless_texture",
    "GL_ARB_compatibility",
    "GL_ARB_fragment_shader_interlock",
    "GL_ARB_gpu_shader_int64",
    "GL_ARB_post_depth_coverage",
    "GL_ARB_shader_ballot",
    "GL_ARB_shader_clock",
    "GL_ARB_shader_stencil_export",
    "GL_ARB_shader_viewport_layer_array",
    "GL_ARB_sparse_texture*",
    "GL_ARM_*",
    "GL_EXT_YUV_target",
    "GL_EXT_demote_to_helper_invocation",
    "GL_EXT_device_group",
    "GL_EXT_fragment_shader_barycentric",
    "GL_EXT_fragment_shading_rate",
    "GL_EXT_post_depth_coverage",
    "GL_EXT_shader_framebuffer_fetch*",
    "GL_EXT_shader_image_load_formatted",
    "GL_EXT_shader_non_constant_global_initializers",
    "GL_EXT_shader_pixel_local_storage*",
    "GL_EXT_texture_shadow_lod",
    "GL_IMG_*",
    "GL_INTEL_*",
    "GL_KHR_blend_equation_advanced*",
    "GL_KHR_shader_subgroup*",
    "GL_MESA_*",
    "GL_NVX_*",
    "GL_NV_*",
    "GL_OES_EGL_image_external*",
    "GL_OVR_*",
    "GL_QCOM_*",
};

bool fits(std::string_view pattern, std::string_view name) {
    return pattern.ends_with('*') ? name.starts_with(pattern.substr(0, pattern.size() - 1)) : name == pattern;
}

const NameSince* find(std::span<const NameSince> names, std::string_view name) {
    const auto found = std::ranges::find_if(names, [&](const NameSince& since) {
        return !name.empty() && name.front() == since.name.front() && fits(since.name, name);
    });
    return found == names.end() ? nullptr : &*found;
}

}  // namespace

const NameSince* name_since(std::string_view identifier) {
    constexpr std::size_t kShortest =
        std::ranges::min(kNames, {}, [](const NameSince& since) { return since.name.size(); }).name.size();
    return identifier.size() + 1 < kShortest ? nullptr : find(kNames, identifier);  // for one may end in `*`
}

const NameSince* layout_since(std::string_view qualifier) {
    return find(kLayouts, qualifier);
}

ExtensionOf owner_of_extension(std::string_view name) {
    const auto* const found =
        std::ranges::find_if(kOwners, [&](const Owner& owner) { return fits(owner.name, name); });
    return found == kOwners.end() ? ExtensionOf::any : found->owner;
}

bool is_foreign_macro(std::string_view name) {
    const ExtensionOf owner = owner_of_extension(name);
    return name == "GL_SPIRV" || owner == ExtensionOf::vulkan || owner == ExtensionOf::tools;
}

bool may_be_lacking(std::string_view extension) {
    return std::ranges::any_of(kNeverCore,
                               [&](std::string_view pattern) { return fits(pattern, extension); });
}

}  // namespace gobo
