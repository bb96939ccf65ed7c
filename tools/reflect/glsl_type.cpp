#include "reflect/glsl_type.hpp"

#include <algorithm>
#include <limits>
#include <string_view>

#include <fmt/format.h>

namespace gobo {
namespace {

using spirv::Id;
using spirv::Module;
using spirv::Type;

std::string scalar_name(const Type& type) {
    if (type.opcode == spv::Op::OpTypeBool) return "bool";
    if (type.opcode == spv::Op::OpTypeFloat) {
        return type.width == 64 ? "double" : type.width == 16 ? "float16_t" : "float";
    }
    const std::string base = type.is_signed ? "int" : "uint";
    return type.width == 32 ? base : fmt::format("{}{}_t", base, type.width);
}

/// What stands before "vec": "", "d", "i", "u", "b", "f16", "i64" ...
std::string vector_prefix(const Type& component) {
    if (component.opcode == spv::Op::OpTypeBool) return "b";
    if (component.opcode == spv::Op::OpTypeFloat) {
        return component.width == 64 ? "d" : component.width == 16 ? "f16" : "";
    }
    const std::string base = component.is_signed ? "i" : "u";
    return component.width == 32 ? base : base + std::to_string(component.width);
}

std::string matrix_name(const Module& module, const Type& matrix) {
    const Type& column = module.type(matrix.element);
    const std::string prefix = vector_prefix(module.type(column.element)) + "mat";
    if (column.count == matrix.count) return fmt::format("{}{}", prefix, matrix.count);
    return fmt::format("{}{}x{}", prefix, matrix.count, column.count);
}

std::string dimension_name(spv::Dim dimension) {
    switch (dimension) {
        case spv::Dim::Dim1D:
            return "1D";
        case spv::Dim::Dim3D:
            return "3D";
        case spv::Dim::Cube:
            return "Cube";
        case spv::Dim::Rect:
            return "2DRect";
        case spv::Dim::Buffer:
            return "Buffer";
        default:
            return "2D";
    }
}

std::string image_name(const Module& module, const Type& image, std::string_view kind) {
    const Type& texel = module.type(image.element);
    std::string name = texel.opcode == spv::Op::OpTypeInt ? vector_prefix(texel) : "";
    name += kind;
    name += dimension_name(image.image.dimension);
    if (image.image.multisampled) name += "MS";
    if (image.image.arrayed) name += "Array";
    if (image.image.depth) name += "Shadow";
    return name;
}

std::int64_t rounded_up(std::int64_t value, std::int64_t multiple) {
    return (value + multiple - 1) / multiple * multiple;
}

/// Base alignment without std140's rounding of arrays and structs to 16, which block_size() does once at the
/// end.
std::int64_t alignment_of(const Module& module, Id id) {
    const Type& type = module.type(id);
    if (type.opcode == spv::Op::OpTypeStruct) {
        std::int64_t alignment = 1;
        for (const Id member : type.members) alignment = std::max(alignment, alignment_of(module, member));
        return alignment;
    }
    if (type.opcode == spv::Op::OpTypeVector) {
        return alignment_of(module, type.element) * (type.count == 2 ? 2 : 4);
    }
    if (type.element != 0) return alignment_of(module, type.element);
    return std::max(type.width / 8, 1);
}

std::int64_t size_of(const Module& module, Id structure, int index);

/// From the start of the struct to the end of the member that ends last.
std::int64_t end_of_members(const Module& module, Id structure) {
    std::int64_t end = 0;
    for (int i = 0; i < static_cast<int>(module.type(structure).members.size()); ++i) {
        const int offset = module.decoration(structure, spv::Decoration::Offset, i).value_or(0);
        end = std::max(end, offset + size_of(module, structure, i));
    }
    return end;
}

/// A row-major matrix is stored as an array of its rows.
std::int64_t matrix_size(const Module& module, const Type& matrix, Id structure, int index) {
    const std::int64_t stride =
        module.decoration(structure, spv::Decoration::MatrixStride, index).value_or(0);
    const bool rows = module.decoration(structure, spv::Decoration::RowMajor, index).has_value();
    return stride * (rows ? module.type(matrix.element).count : matrix.count);
}

/// Of member `index` of the struct, in bytes, from its strides.
std::int64_t size_of(const Module& module, Id structure, int index) {
    const Id id = module.type(structure).members[static_cast<std::size_t>(index)];
    const Type& type = module.type(id);
    if (is_array(type)) {
        const std::int64_t stride = module.decoration(id, spv::Decoration::ArrayStride).value_or(0);
        return stride * type.count;
    }
    if (type.opcode == spv::Op::OpTypeStruct) {
        return rounded_up(end_of_members(module, id), alignment_of(module, id));
    }
    if (type.opcode == spv::Op::OpTypeMatrix) return matrix_size(module, type, structure, index);
    if (type.opcode == spv::Op::OpTypeVector) return type.count * alignment_of(module, type.element);
    return alignment_of(module, id);
}

bool arrays_have_strides(const Module& module, Id id) {
    for (; is_array(module.type(id)); id = module.type(id).element) {
        if (!module.decoration(id, spv::Decoration::ArrayStride)) return false;
    }
    return true;
}

}  // namespace

bool is_array(const Type& type) {
    return type.opcode == spv::Op::OpTypeArray || type.opcode == spv::Op::OpTypeRuntimeArray;
}

bool is_opaque(const Type& type) {
    return type.opcode == spv::Op::OpTypeSampledImage || type.opcode == spv::Op::OpTypeImage ||
           type.opcode == spv::Op::OpTypeSampler;
}

std::string glsl_name(const Module& module, Id id) {
    const Type& type = module.type(id);
    switch (type.opcode) {
        case spv::Op::OpTypeVector:
            return fmt::format("{}vec{}", vector_prefix(module.type(type.element)), type.count);
        case spv::Op::OpTypeMatrix:
            return matrix_name(module, type);
        case spv::Op::OpTypeStruct:
            return module.name(id);
        case spv::Op::OpTypeSampledImage:
            return image_name(module, module.type(type.element), "sampler");
        case spv::Op::OpTypeImage:
            return image_name(module, type, type.image.storage ? "image" : "texture");
        case spv::Op::OpTypeSampler:
            return "sampler";
        default:
            return scalar_name(type);
    }
}

std::vector<int> array_extents(const Module& module, Id id) {
    std::vector<int> extents;
    for (; is_array(module.type(id)); id = module.type(id).element) extents.push_back(module.type(id).count);
    return extents;
}

Id array_element(const Module& module, Id id) {
    while (is_array(module.type(id))) id = module.type(id).element;
    return id;
}

bool is_laid_out(const Module& module, Id structure) {
    const std::vector<Id>& members = module.type(structure).members;
    for (int i = 0; i < static_cast<int>(members.size()); ++i) {
        const Id member = members[static_cast<std::size_t>(i)];
        const Id element = array_element(module, member);
        const spv::Op opcode = module.type(element).opcode;
        if (!module.decoration(structure, spv::Decoration::Offset, i)) return false;
        if (!arrays_have_strides(module, member)) return false;
        if (opcode == spv::Op::OpTypeMatrix &&
            !module.decoration(structure, spv::Decoration::MatrixStride, i)) {
            return false;
        }
        if (opcode == spv::Op::OpTypeStruct && !is_laid_out(module, element)) return false;
    }
    return true;
}

std::int64_t block_size(const Module& module, Id structure) {
    return rounded_up(end_of_members(module, structure), 16);
}

int location_count(const Module& module, Id id, bool vertex_attribute) {
    const Type& type = module.type(id);
    std::int64_t count = 1;
    if (type.opcode == spv::Op::OpTypeStruct) {
        count = 0;
        for (const Id member : type.members) count += location_count(module, member, vertex_attribute);
    } else if (is_array(type) || type.opcode == spv::Op::OpTypeMatrix) {
        // An empty struct counts as one here, so that nobody walks two thousand million of them for nothing.
        count =
            std::int64_t{type.count} * std::max(location_count(module, type.element, vertex_attribute), 1);
    } else if (type.opcode == spv::Op::OpTypeVector && type.count > 2 && !vertex_attribute) {
        count = module.type(type.element).width == 64 ? 2 : 1;
    }
    return static_cast<int>(std::min<std::int64_t>(count, std::numeric_limits<int>::max()));
}

}  // namespace gobo
