#include "reflect/reflect.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "core/numbers.hpp"
#include "core/stage.hpp"
#include "core/text.hpp"

namespace gobo {
namespace {

using spirv::Id;
using spirv::kWhole;
using spirv::Module;
using spirv::Type;

/// Locations or binding points, far above what any device offers; keeps a malformed module from asking for
/// lists without end.
constexpr int kMostPlaces = 1 << 16;
constexpr const char* kStateSize = "write its size between the brackets";
constexpr int kLargest = std::numeric_limits<int>::max();

/// The number that decorates the id or member; `absent` where none does.
int decorated(const Module& module, spv::Decoration kind, Id id, int member = kWhole, int absent = 0) {
    const auto value = module.decoration(id, kind, member);
    return value ? static_cast<int>(std::min<std::uint32_t>(*value, kLargest)) : absent;
}

/// The location or binding point that the module states, or -1.
int stated(const Module& module, spv::Decoration kind, Id id, int member = kWhole) {
    return std::min(decorated(module, kind, id, member, -1), kMostPlaces);
}

/// The extents of an array, outermost first, 0 for no size; empty where the type is no array.
std::vector<int> array_extents(const Module& module, Id id) {
    std::vector<int> extents;
    for (; module.type(id).is_array(); id = module.type(id).element)
        extents.push_back(static_cast<int>(module.type(id).count));
    return extents;
}

/// The type with all array dimensions taken off.
Id array_element(const Module& module, Id id) {
    while (module.type(id).is_array()) id = module.type(id).element;
    return id;
}

bool is_structure(const Module& module, Id id) {
    return module.type(id).opcode == spv::OpTypeStruct;
}

bool is_block(const Module& module, Id structure) {
    return module.decoration(structure, spv::DecorationBlock) ||
           module.decoration(structure, spv::DecorationBufferBlock);
}

/// Calls `visit(index, type)` for each member of a struct.
template <class Visit>
void for_each_member(const Module& module, Id structure, const Visit& visit) {
    int index = 0;
    for (const Id member : module.type(structure).members) visit(index++, member);
}

/// Every member, array and matrix of the struct states its offset and strides.
bool is_laid_out(const Module& module, Id structure) {
    bool result = true;
    for_each_member(module, structure, [&](int index, Id member) {
        Id id = member;
        for (; module.type(id).is_array(); id = module.type(id).element)
            result = result && module.decoration(id, spv::DecorationArrayStride);
        result = result && module.decoration(structure, spv::DecorationOffset, index) &&
                 (module.type(id).opcode != spv::OpTypeMatrix ||
                  module.decoration(structure, spv::DecorationMatrixStride, index)) &&
                 (!is_structure(module, id) || is_laid_out(module, id));
    });
    return result;
}

/// From the start of what contains the members to the end of the one that ends last.
std::int64_t end_of(const std::vector<Member>& members) {
    std::int64_t end = 0;
    for (const Member& member : members) end = std::max(end, member.offset + size_of(member));
    return end;
}

/// Bytes from the start of a block to the end of its last member. Rounded up to 16 that is what Mesa reports
/// as UNIFORM_BLOCK_DATA_SIZE; push constants are as large as a struct of C++, in whole words, as Vulkan
/// wants them. An array without a size counts as empty.
std::int64_t block_size(const std::vector<Member>& members, bool is_pushed) {
    return rounded_up<std::int64_t>(end_of(members), is_pushed ? std::max(alignment_of(members), 4) : 16);
}

/// Locations between stages. A vertex attribute of three or four doubles takes one, elsewhere two.
int locations_of(const Module& module, Id id, bool is_attribute) {
    const Type& type = module.type(id);
    std::int64_t count = 1;
    if (type.opcode == spv::OpTypeStruct) {
        count = 0;
        for (const Id member : type.members) count += locations_of(module, member, is_attribute);
    } else if (type.is_array() || type.value.is_matrix()) {
        // An empty struct counts as one here, so that nobody walks two thousand million of them for nothing.
        count = std::int64_t{type.count} * std::max(locations_of(module, type.element, is_attribute), 1);
    } else if (type.value.column_size() > 16 && !is_attribute) {
        count = 2;
    }
    return static_cast<int>(std::min<std::int64_t>(count, kLargest));
}

/// The memory qualifiers of a storage block's member, which SPIR-V has member by member.
std::string access_of(const Module& module, Id structure, int index) {
    constexpr std::pair<spv::Decoration, std::string_view> kQualifiers[] = {
        {spv::DecorationCoherent, "coherent"},
        {spv::DecorationVolatile, "volatile"},
        {spv::DecorationRestrict, "restrict"},
        {spv::DecorationNonWritable, "readonly"},
        {spv::DecorationNonReadable, "writeonly"}};
    std::string words;
    for (const auto& [decoration, word] : kQualifiers)
        if (module.decoration(structure, decoration, index))
            words += fmt::format("{}{}", words.empty() ? "" : " ", word);
    return words;
}

std::vector<Member> members_of(const Module& module, Id structure) {
    std::vector<Member> members;
    members.reserve(module.type(structure).members.size());
    for_each_member(module, structure, [&](int index, Id id) {
        const Id element = array_element(module, id);
        Member member;
        member.name = module.name(structure, index);
        member.type = type_name(module, element);
        member.offset = decorated(module, spv::DecorationOffset, structure, index);
        member.array = array_extents(module, id);
        member.array_stride = decorated(module, spv::DecorationArrayStride, id);
        member.matrix_stride = decorated(module, spv::DecorationMatrixStride, structure, index);
        member.row_major = module.decoration(structure, spv::DecorationRowMajor, index).has_value();
        member.members = members_of(module, element);
        member.usage.access = access_of(module, structure, index);
        members.push_back(std::move(member));
    });
    return members;
}

/// Every element of an array of blocks is a block of its own to OpenGL, on the binding points that follow. In
/// Vulkan they share one binding.
std::vector<Block> elements_of(Block block, const std::vector<int>& extents, std::size_t dimension = 0) {
    std::vector<Block> elements;
    if (dimension == extents.size()) {
        elements.push_back(std::move(block));
        return elements;
    }
    for (int i = 0; i < extents[dimension]; ++i) {
        Block element = block;
        element.name += fmt::format("[{}]", i);
        for (Block& inner : elements_of(std::move(element), extents, dimension + 1)) {
            if (block.binding >= 0 && block.set < 0)
                inner.binding = block.binding + static_cast<int>(elements.size());
            elements.push_back(std::move(inner));
        }
    }
    return elements;
}

/// Reads one stage; what it finds is added to an Interface.
class Reflection {
  public:
    Reflection(const Module& module, const spirv::Usage& usage, Api api)
        : module_(module), used_(usage), api_(api) {}

    Result<Interface> run() {
        if (module_.entry_points.empty())
            return fail(Fault::internal, "the SPIR-V module has no entry point");
        const spv::ExecutionModel model = module_.entry_points.front().model;
        if (model >= kStages.size())
            return fail(Fault::internal, "the SPIR-V module is of an unknown kind of stage");
        interface_.stages = {std::string(kStages[model].name)};
        for (const spirv::Variable& variable : module_.variables)
            if (!is_built_in(module_, variable)) add(variable);
        add_constants();
        if (!problem_.empty()) return fail(fault_, problem_, help_);
        sort(interface_.blocks, interface_.storage_blocks, interface_.uniforms, interface_.samplers,
             interface_.inputs, interface_.outputs);
        return std::move(interface_);
    }

  private:
    void stop(fmt::format_string<const std::string&> problem, const std::string& name,
              Fault fault = Fault::input, std::string help = "") {
        problem_ = fmt::format(problem, name);
        fault_ = fault;
        help_ = std::move(help);
    }

    /// Arrays of descriptors whose size is open came after Vulkan 1.0.
    [[nodiscard]] bool lacks_size(const std::vector<int>& extents) const {
        return api_ == Api::vulkan && std::ranges::find(extents, 0) != extents.end();
    }

    [[nodiscard]] Usage usage_of(Id variable) const {
        Usage usage;
        usage.unused = !used_.reads(variable) && !used_.writes(variable);
        return usage;
    }

    /// glslang states a set for OpenGL too, where there are none.
    [[nodiscard]] int set_of(Id variable) const {
        return api_ == Api::opengl ? -1 : decorated(module_, spv::DecorationDescriptorSet, variable);
    }

    /// The source's name of a constant; of a work group's size, which has none in SPIR-V, what it is stated
    /// by.
    [[nodiscard]] std::string name_of_constant(Id id) const {
        for (const spirv::Instruction& instruction : module_.instructions) {
            if (instruction.opcode != spv::OpSpecConstantComposite ||
                module_.decoration(instruction.result, spv::DecorationBuiltIn) != spv::BuiltInWorkgroupSize)
                continue;
            for (std::size_t i = 0; i < 3; ++i)
                if (instruction.id(3 + i) == id) return fmt::format("local_size_{}", "xyz"[i]);
        }
        return module_.name(id);
    }

    void add_constants() {
        for (const spirv::Instruction& instruction : module_.instructions) {
            const auto is = [&](spv::Op opcode) { return instruction.opcode == opcode; };
            if (is(spv::OpFunction)) break;
            const auto id = module_.decoration(instruction.result, spv::DecorationSpecId);
            if (!id || instruction.result == Id::none) continue;
            const std::string type = type_name(module_, instruction.type);
            const std::string name = name_of_constant(instruction.result);
            if (type != "int" && type != "uint" && type != "float" && type != "bool")
                return stop("the specialisation constant '{}' is none of int, uint, float and bool", name,
                            Fault::input, "make it a float or an int: headers carry values of 32 bits");
            const std::uint32_t value = is(spv::OpSpecConstant)       ? instruction.word(3)
                                        : is(spv::OpSpecConstantTrue) ? 1
                                                                      : 0;
            interface_.specialization_constants.push_back({name, type, static_cast<int>(*id), value});
        }
        std::ranges::stable_sort(interface_.specialization_constants, {}, &SpecializationConstant::name);
    }

    void add(const spirv::Variable& variable) {
        switch (variable.storage) {
            case spv::StorageClassUniform:
            case spv::StorageClassStorageBuffer:
            case spv::StorageClassPushConstant:
                return add_block(variable);
            case spv::StorageClassUniformConstant:
            case spv::StorageClassAtomicCounter:
                return add_uniform(variable);
            case spv::StorageClassInput:
                return add_variables(variable, interface_.inputs);
            case spv::StorageClassOutput:
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
        if (!is_structure(module_, structure) || !is_laid_out(module_, structure))
            return stop("block '{}' of the SPIR-V module has no layout", block.name, Fault::internal);
        block.members = members_of(module_, structure);
        const bool is_pushed = variable.storage == spv::StorageClassPushConstant;
        const std::int64_t size = block_size(block.members, is_pushed);
        if (size > kLargest) return stop("block '{}' takes more than 2 GiB", block.name);
        std::int64_t count = 1;
        for (const int extent : extents) count = std::min<std::int64_t>(count * extent, kMostPlaces + 1);
        if (count > kMostPlaces) return stop("block '{}' is an array of too many blocks", block.name);
        if (lacks_size(extents))
            return stop("block '{}' is an array without a size, which Vulkan 1.0 cannot bind", block.name,
                        Fault::input, kStateSize);
        if (api_ == Api::vulkan && extents.size() > 1)  // Vulkan 1.0, 14.5.1
            return stop("block '{}' is an array of arrays, which Vulkan 1.0 cannot bind", block.name,
                        Fault::input, "make it an array of one dimension: [2 * i + j] for [i][j]");
        block.binding = stated(module_, spv::DecorationBinding, variable.id);
        block.set = is_pushed ? -1 : set_of(variable.id);
        block.size = static_cast<int>(size);
        block.stages = interface_.stages;
        block.usage = usage_of(variable.id);
        block.usage.anonymous = module_.name(variable.id).empty();
        const bool is_storage = variable.storage == spv::StorageClassStorageBuffer ||
                                module_.decoration(structure, spv::DecorationBufferBlock);
        std::vector<Block>& blocks = is_pushed    ? interface_.push_constants
                                     : is_storage ? interface_.storage_blocks
                                                  : interface_.blocks;
        for (Block& element : elements_of(std::move(block), extents)) blocks.push_back(std::move(element));
    }

    void add_uniform(const spirv::Variable& variable) {
        const Id element = array_element(module_, variable.type);
        const std::string name = module_.name(variable.id);
        const std::vector<int> array = array_extents(module_, variable.type);
        std::string type = type_name(module_, element);
        Usage usage = usage_of(variable.id);
        if (lacks_size(array))
            return stop("sampler '{}' is an array without a size, which Vulkan 1.0 cannot bind", name,
                        Fault::input, kStateSize);
        const spv::Op kind = module_.type(element).opcode;
        if (kind == spv::OpTypeAccelerationStructureKHR && api_ == Api::opengl)
            return stop("acceleration structure '{}': OpenGL has none", name);
        if (!is_opaque(element) && kind > spv::OpTypeStruct)
            return stop("uniform '{}' is of a type by which nothing can be bound", name, Fault::input,
                        "declare it as a sampler, an image, an acceleration structure or a block");
        if (is_opaque(element)) {
            usage.access = spirv::format_name(module_.type(element).image.format);
            interface_.samplers.push_back({name, type, stated(module_, spv::DecorationBinding, variable.id),
                                           array, interface_.stages, usage, set_of(variable.id),
                                           stated(module_, spv::DecorationLocation, variable.id)});
            return;
        }
        if (holds_opaque(element)) {
            int location = stated(module_, spv::DecorationLocation, variable.id);
            return add_parts(name, variable.type, location, usage);
        }
        const bool is_counter = variable.storage == spv::StorageClassAtomicCounter;
        if (is_counter) type = "atomic_uint";
        Uniform& uniform = interface_.uniforms.emplace_back(
            Uniform{name, type, stated(module_, spv::DecorationLocation, variable.id), array,
                    members_of(module_, element), interface_.stages, usage});
        if (!is_counter) return;
        uniform.counter_binding = stated(module_, spv::DecorationBinding, variable.id);
        uniform.counter_offset = decorated(module_, spv::DecorationOffset, variable.id);
    }

    [[nodiscard]] bool is_opaque(Id type) const {
        const spv::Op kind = module_.type(type).opcode;
        return module_.type(type).is_image() || kind == spv::OpTypeSampler ||
               kind == spv::OpTypeAccelerationStructureKHR;
    }

    [[nodiscard]] bool holds_opaque(Id structure) const {
        return std::ranges::any_of(module_.type(structure).members, [&](Id member) {
            const Id element = array_element(module_, member);
            return is_opaque(element) || holds_opaque(element);
        });
    }

    /// The members of a struct that holds samplers, each a uniform or a sampler of its own. Moves on a stated
    /// location.
    void add_parts(const std::string& path, Id id, int& location, const Usage& usage) {
        const Type& type = module_.type(id);
        const Id element = array_element(module_, id);
        if (is_structure(module_, element) && type.is_array()) {
            for (std::uint32_t i = 0; i < type.count; ++i)
                add_parts(fmt::format("{}[{}]", path, i), type.element, location, usage);
        } else if (is_structure(module_, element)) {
            for_each_member(module_, id, [&](int index, Id member) {
                add_parts(path + "." + module_.name(id, index), member, location, usage);
            });
        } else {
            const std::vector<int> array = array_extents(module_, id);
            const std::string name = type_name(module_, element);
            if (is_opaque(element))
                interface_.samplers.push_back(
                    {path, name, -1, array, interface_.stages, usage, -1, location});
            else
                interface_.uniforms.push_back({path, name, location, array, {}, interface_.stages, usage});
            if (location >= 0) location += element_count(array);
        }
    }

    /// Whether it is declared `patch`; of a block the members are.
    [[nodiscard]] bool is_patch(const spirv::Variable& variable) const {
        const Id element = array_element(module_, variable.type);
        return module_.decoration(variable.id, spv::DecorationPatch) ||
               module_.decoration(element, spv::DecorationPatch, 0);
    }

    /// Whether a fragment reads what each vertex of its triangle wrote; of a block the members state it.
    [[nodiscard]] bool is_of_vertices(const spirv::Variable& variable) const {
        const Id element = array_element(module_, variable.type);
        return module_.decoration(variable.id, spv::DecorationPerVertexKHR) ||
               module_.decoration(element, spv::DecorationPerVertexKHR, 0);
    }

    void add_variables(const spirv::Variable& variable, std::vector<gobo::Variable>& list) {
        const bool is_input = variable.storage == spv::StorageClassInput;
        const spv::ExecutionModel stage = module_.entry_points.front().model;
        const bool is_attribute = is_input && stage == spv::ExecutionModelVertex;
        const bool has_vertices = is_input ? stage == spv::ExecutionModelTessellationControl ||
                                                 stage == spv::ExecutionModelTessellationEvaluation ||
                                                 stage == spv::ExecutionModelGeometry ||
                                                 is_of_vertices(variable)  // pervertexEXT
                                           : stage == spv::ExecutionModelTessellationControl;
        const bool is_of_patch = is_patch(variable);
        const bool is_per_vertex = has_vertices && !is_of_patch && module_.type(variable.type).is_array();
        const Id type = is_per_vertex ? module_.type(variable.type).element : variable.type;
        const std::string name = interface_name(module_, variable);
        if (locations_of(module_, type, is_attribute) > kMostPlaces)
            return stop("variable '{}' takes too many locations", name);
        int location = stated(module_, spv::DecorationLocation, variable.id);
        const std::size_t first = list.size();
        const Id element = array_element(module_, type);
        add_paths(name, type, location, is_attribute, list);
        for (std::size_t i = first; i < list.size(); ++i) {
            list[i].whole = is_block(module_, element)       ? Whole::block
                            : is_structure(module_, element) ? Whole::structure
                                                             : Whole::itself;
            list[i].per_vertex = is_per_vertex;
            list[i].patch = is_of_patch;
            list[i].component = decorated(module_, spv::DecorationComponent, variable.id);
            list[i].usage.anonymous = list[i].whole == Whole::block && module_.name(variable.id).empty();
            list[i].usage.unused = is_input ? !used_.reads(variable.id) : !used_.writes(variable.id);
            if (const int stream = decorated(module_, spv::DecorationStream, variable.id); stream > 0)
                list[i].usage.access = fmt::format("stream {}", stream);
            add_interpolation(list[i].interpolation, variable.id, kWhole);
        }
    }

    void add_interpolation(Interpolation& interpolation, Id id, int member) const {
        const auto has = [&](spv::Decoration kind) {
            return module_.decoration(id, kind, member).has_value();
        };
        interpolation.flat |= has(spv::DecorationFlat);
        interpolation.noperspective |= has(spv::DecorationNoPerspective);
        interpolation.centroid |= has(spv::DecorationCentroid);
        interpolation.sample |= has(spv::DecorationSample);
        interpolation.invariant |= has(spv::DecorationInvariant);
    }

    /// Structs and blocks between stages are listed member by member, as OpenGL's queries do. Moves on a
    /// stated location.
    void add_paths(const std::string& path, Id id, int& location, bool is_attribute,
                   std::vector<gobo::Variable>& list) {
        const Type& type = module_.type(id);
        const Id element = array_element(module_, id);
        if (!is_structure(module_, element)) {
            list.push_back({path, type_name(module_, element), location, array_extents(module_, id)});
            if (location >= 0) location += locations_of(module_, id, is_attribute);
        } else if (type.is_array()) {
            for (std::uint32_t i = 0; i < type.count; ++i)
                add_paths(fmt::format("{}[{}]", path, i), type.element, location, is_attribute, list);
        } else {
            for_each_member(module_, id, [&](int index, Id member) {
                const int own = stated(module_, spv::DecorationLocation, id, index);
                if (own >= 0) location = own;
                const std::size_t first = list.size();
                add_paths(path + "." + module_.name(id, index), member, location, is_attribute, list);
                for (std::size_t i = first; i < list.size(); ++i)
                    add_interpolation(list[i].interpolation, id, index);
            });
        }
    }

    template <class... List>
    static void sort(List&... lists) {
        (std::ranges::stable_sort(lists, {}, &List::value_type::name), ...);
    }

    const Module& module_;
    const spirv::Usage& used_;
    Api api_;
    Interface interface_;
    std::string problem_;
    std::string help_;
    Fault fault_ = Fault::input;
};

}  // namespace

int alignment_of(const std::vector<Member>& members) {
    int most = 1;
    for (const Member& member : members) {
        std::optional<GlslType> column = glsl_type(member.type);
        if (column && member.row_major) column->rows = column->columns;
        most = std::max(most, column ? column->column_alignment() : alignment_of(member.members));
    }
    return most;
}

std::int64_t size_of(const Member& member) {
    if (!member.array.empty()) return std::int64_t{member.array_stride} * member.array.front();
    if (!member.members.empty())
        return rounded_up<std::int64_t>(end_of(member.members), alignment_of(member.members));
    const GlslType type = glsl_type(member.type).value_or(GlslType{});
    if (!type.is_matrix()) return type.column_size();
    return std::int64_t{member.matrix_stride} * (member.row_major ? type.rows : type.columns);
}

bool is_built_in(const Module& module, const spirv::Variable& variable) {
    const Id structure = array_element(module, variable.type);
    return module.decoration(variable.id, spv::DecorationBuiltIn) ||
           module.decoration(structure, spv::DecorationBuiltIn, 0) ||
           module.name(variable.id).starts_with("gl_") || module.name(structure).starts_with("gl_");
}

std::string interface_name(const Module& module, const spirv::Variable& variable) {
    const Id structure = array_element(module, variable.type);
    return module.name(is_block(module, structure) ? structure : variable.id);
}

Result<Interface> reflect_stage(std::span<const std::uint32_t> words) {
    GOBO_TRY(const Module module, spirv::read_module(words));
    return reflect_stage(module, spirv::usage_of(module));
}

Result<Interface> reflect_stage(const Module& module, const spirv::Usage& usage, Api api) {
    return Reflection(module, usage, api).run();
}

}  // namespace gobo
