#include "reflect/reflect.hpp"

#include <algorithm>
#include <limits>
#include <string_view>

#include <fmt/format.h>

#include "reflect/glsl_type.hpp"

namespace gobo {
namespace {

using spirv::Id;
using spirv::Module;

/// Far above what any device offers; keeps a malformed module from asking for lists without end.
constexpr int most_locations = 1 << 16;
constexpr int most_bindings = 1 << 16;

std::string stage_name(spv::ExecutionModel model) {
    switch (model) {
        case spv::ExecutionModel::Vertex:
            return "vertex";
        case spv::ExecutionModel::TessellationControl:
            return "tess_control";
        case spv::ExecutionModel::TessellationEvaluation:
            return "tess_evaluation";
        case spv::ExecutionModel::Geometry:
            return "geometry";
        case spv::ExecutionModel::Fragment:
            return "fragment";
        case spv::ExecutionModel::GLCompute:
            return "compute";
        default:
            return {};
    }
}

std::vector<Member> members_of(const Module& module, Id structure);

Member member_of(const Module& module, Id structure, int index) {
    const Id id = module.type(structure).members[static_cast<std::size_t>(index)];
    const Id element = array_element(module, id);
    Member member;
    member.name = module.name(structure, index);
    member.type = glsl_name(module, element);
    member.offset = module.decoration(structure, spv::Decoration::Offset, index).value_or(0);
    member.array = array_extents(module, id);
    member.array_stride = module.decoration(id, spv::Decoration::ArrayStride).value_or(0);
    member.matrix_stride = module.decoration(structure, spv::Decoration::MatrixStride, index).value_or(0);
    member.row_major = module.decoration(structure, spv::Decoration::RowMajor, index).has_value();
    member.members = members_of(module, element);
    return member;
}

std::vector<Member> members_of(const Module& module, Id structure) {
    std::vector<Member> members;
    if (module.type(structure).opcode != spv::Op::OpTypeStruct) return members;
    for (int i = 0; i < static_cast<int>(module.type(structure).members.size()); ++i) {
        members.push_back(member_of(module, structure, i));
    }
    return members;
}

bool is_block(const Module& module, Id type) {
    return module.decoration(type, spv::Decoration::Block) ||
           module.decoration(type, spv::Decoration::BufferBlock);
}

/// The location or binding point that the module states, or -1.
int place(const Module& module, spv::Decoration kind, Id id, int member = spirv::whole) {
    return std::min(module.decoration(id, kind, member).value_or(-1), most_locations);
}

std::int64_t element_count(const std::vector<int>& extents) {
    std::int64_t count = 1;
    for (const int extent : extents) count = std::min<std::int64_t>(count * extent, most_bindings + 1);
    return count;
}

/// Every element of an array of blocks is a block of its own to OpenGL, on the binding points that follow.
std::vector<Block> elements_of(const Block& block, const std::vector<int>& extents,
                               std::size_t dimension = 0) {
    if (dimension == extents.size()) return {block};
    std::vector<Block> elements;
    for (int i = 0; i < extents[dimension]; ++i) {
        Block element = block;
        element.name += fmt::format("[{}]", i);
        for (Block& inner : elements_of(element, extents, dimension + 1)) {
            if (block.binding >= 0) inner.binding = block.binding + static_cast<int>(elements.size());
            elements.push_back(std::move(inner));
        }
    }
    return elements;
}

/// Reads one stage; what it finds is added to an Interface.
class Reflection {
  public:
    explicit Reflection(const Module& module) : module_(module) {}

    Result<Interface> run() {
        if (module_.entry_points.empty())
            return fail(Fault::internal, "the SPIR-V module has no entry point");
        const std::string stage = stage_name(module_.entry_points.front().model);
        if (stage.empty()) return fail(Fault::internal, "the SPIR-V module is of an unknown kind of stage");
        interface_.stages = {stage};
        for (const spirv::Variable& variable : module_.variables) {
            if (!is_built_in(module_, variable)) add(variable);
        }
        if (!problem_.empty()) return fail(Fault::internal, problem_);
        sort();
        return std::move(interface_);
    }

  private:
    void add(const spirv::Variable& variable) {
        switch (variable.storage) {
            case spv::StorageClass::Uniform:
            case spv::StorageClass::StorageBuffer:
                return add_block(variable);
            case spv::StorageClass::UniformConstant:
            case spv::StorageClass::AtomicCounter:
                return add_uniform(variable);
            case spv::StorageClass::Input:
                return add_variables(variable, interface_.inputs);
            case spv::StorageClass::Output:
                return add_variables(variable, interface_.outputs);
            default:
                return;
        }
    }

    void add_block(const spirv::Variable& variable) {
        const Id structure = array_element(module_, variable.type);
        const std::vector<int> extents = array_extents(module_, variable.type);
        Block block;
        block.name = interface_name(module_, variable);
        if (!check_block(structure, extents, block.name)) return;
        block.binding = place(module_, spv::Decoration::Binding, variable.id);
        block.size = static_cast<int>(block_size(module_, structure));
        block.stages = interface_.stages;
        block.members = members_of(module_, structure);
        const bool storage = variable.storage == spv::StorageClass::StorageBuffer ||
                             module_.decoration(structure, spv::Decoration::BufferBlock);
        std::vector<Block>& blocks = storage ? interface_.storage_blocks : interface_.blocks;
        for (Block& element : elements_of(block, extents)) blocks.push_back(std::move(element));
    }

    bool check_block(Id structure, const std::vector<int>& extents, const std::string& name) {
        if (module_.type(structure).opcode != spv::Op::OpTypeStruct || !is_laid_out(module_, structure)) {
            problem_ = fmt::format("block '{}' of the SPIR-V module has no layout", name);
        } else if (block_size(module_, structure) > std::numeric_limits<int>::max()) {
            problem_ = fmt::format("block '{}' takes more than 2 GiB", name);
        } else if (element_count(extents) > most_bindings) {
            problem_ = fmt::format("block '{}' is an array of too many blocks", name);
        }
        return problem_.empty();
    }

    void add_uniform(const spirv::Variable& variable) {
        const Id element = array_element(module_, variable.type);
        if (is_opaque(module_.type(element))) return add_sampler(variable, element);
        Uniform uniform;
        uniform.name = module_.name(variable.id);
        const bool counter = variable.storage == spv::StorageClass::AtomicCounter;
        uniform.type = counter ? "atomic_uint" : glsl_name(module_, element);
        uniform.location = place(module_, spv::Decoration::Location, variable.id);
        uniform.array = array_extents(module_, variable.type);
        uniform.members = members_of(module_, element);
        uniform.stages = interface_.stages;
        interface_.uniforms.push_back(std::move(uniform));
    }

    void add_sampler(const spirv::Variable& variable, Id element) {
        Sampler sampler;
        sampler.name = module_.name(variable.id);
        sampler.type = glsl_name(module_, element);
        sampler.binding = place(module_, spv::Decoration::Binding, variable.id);
        sampler.array = array_extents(module_, variable.type);
        sampler.stages = interface_.stages;
        interface_.samplers.push_back(std::move(sampler));
    }

    void add_variables(const spirv::Variable& variable, std::vector<gobo::Variable>& list) {
        const bool attribute =
            variable.storage == spv::StorageClass::Input && interface_.stages.front() == "vertex";
        const std::string name = interface_name(module_, variable);
        if (location_count(module_, variable.type, attribute) > most_locations) {
            problem_ = fmt::format("variable '{}' takes too many locations", name);
            return;
        }
        add_paths(name, variable.type, place(module_, spv::Decoration::Location, variable.id), attribute,
                  list);
    }

    /// Structs and blocks between stages are listed member by member, as OpenGL's queries do.
    void add_paths(const std::string& path, Id type, int location, bool attribute,
                   std::vector<gobo::Variable>& list) {
        const Id element = array_element(module_, type);
        const bool structure = module_.type(element).opcode == spv::Op::OpTypeStruct;
        if (!structure) {
            list.push_back({path, glsl_name(module_, element), location, array_extents(module_, type)});
        } else if (is_array(module_.type(type))) {
            add_elements(path, type, location, attribute, list);
        } else {
            add_members(path, type, location, attribute, list);
        }
    }

    void add_elements(const std::string& path, Id array, int location, bool attribute,
                      std::vector<gobo::Variable>& list) {
        const spirv::Type& type = module_.type(array);
        const int step = location_count(module_, type.element, attribute);
        for (int i = 0; i < type.count; ++i) {
            add_paths(fmt::format("{}[{}]", path, i), type.element, location, attribute, list);
            if (location >= 0) location += step;
        }
    }

    void add_members(const std::string& path, Id structure, int location, bool attribute,
                     std::vector<gobo::Variable>& list) {
        const std::vector<Id>& members = module_.type(structure).members;
        for (int i = 0; i < static_cast<int>(members.size()); ++i) {
            const Id member = members[static_cast<std::size_t>(i)];
            const int stated = place(module_, spv::Decoration::Location, structure, i);
            if (stated >= 0) location = stated;
            add_paths(path + "." + module_.name(structure, i), member, location, attribute, list);
            if (location >= 0) location += location_count(module_, member, attribute);
        }
    }

    void sort() {
        const auto by_name = [](const auto& left, const auto& right) { return left.name < right.name; };
        std::ranges::stable_sort(interface_.blocks, by_name);
        std::ranges::stable_sort(interface_.storage_blocks, by_name);
        std::ranges::stable_sort(interface_.uniforms, by_name);
        std::ranges::stable_sort(interface_.samplers, by_name);
        std::ranges::stable_sort(interface_.inputs, by_name);
        std::ranges::stable_sort(interface_.outputs, by_name);
    }

    const Module& module_;
    Interface interface_;
    std::string problem_;
};

}  // namespace

bool is_built_in(const Module& module, const spirv::Variable& variable) {
    const Id structure = array_element(module, variable.type);
    return module.decoration(variable.id, spv::Decoration::BuiltIn).has_value() ||
           module.decoration(structure, spv::Decoration::BuiltIn, 0).has_value() ||
           std::string_view(module.name(variable.id)).starts_with("gl_") ||
           std::string_view(module.name(structure)).starts_with("gl_");
}

std::string interface_name(const Module& module, const spirv::Variable& variable) {
    const Id structure = array_element(module, variable.type);
    return module.name(is_block(module, structure) ? structure : variable.id);
}

Result<Interface> reflect_stage(const Module& module) {
    return Reflection(module).run();
}

Result<Interface> reflect_stage(const std::vector<std::uint32_t>& words) {
    const Result<Module> module = spirv::read_module(words);
    if (!module) return tl::unexpected(module.error());
    return reflect_stage(*module);
}

}  // namespace gobo
