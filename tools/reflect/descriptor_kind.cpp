#include "reflect/descriptor_kind.hpp"

namespace gobo {

std::string_view descriptor_kind(std::string_view type) {
    if (type.starts_with("accelerationStructure")) return "acceleration_structure";
    if (type.find("subpassInput") != std::string_view::npos) return "input_attachment";
    const bool is_buffer = type.ends_with("Buffer");
    if (type.find("image") != std::string_view::npos)
        return is_buffer ? "storage_texel_buffer" : "storage_image";
    if (is_buffer) return "uniform_texel_buffer";
    if (type == "sampler" || type == "samplerShadow") return "sampler";
    if (type.find("texture") != std::string_view::npos) return "sampled_image";
    return "combined_image_sampler";
}

}  // namespace gobo
