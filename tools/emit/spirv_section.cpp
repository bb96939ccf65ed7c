// What pipelines are made with, in headers that hold SPIR-V: tables by the numbers that Vulkan has for types
// of descriptors, stages and formats.
#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "emit/sections.hpp"
#include "reflect/descriptor_kind.hpp"
#include "spirv/glsl_type.hpp"
#include "spirv/vertex_locations.hpp"

namespace gobo {
namespace {

/// VkShaderStageFlags: bit by bit in the order of the pipeline, as gobo has the stages.
unsigned stage_bits(const std::vector<std::string>& stages) {
    unsigned bits = 0;
    for (const std::string& name : stages)
        if (const auto kind = stage_named(name)) bits |= 1U << static_cast<unsigned>(*kind);
    return bits;
}

/// A row of the table of descriptors before it is a text.
struct DescriptorRow {
    std::string name;
    std::string_view kind;
    int count = 1;
    unsigned stages = 0;
    std::string only;
};
using Descriptors = std::map<std::pair<int, int>, std::vector<DescriptorRow>>;  ///< by set and binding

/// Adds a list of the interface; `entry_of` gives kind and count of an entry.
template <class Entry, class EntryOf>
void add(Descriptors& descriptors, const std::vector<Entry>& entries, std::string_view kind,
         const Declarations& declarations, EntryOf entry_of) {
    int number = 0;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const Entry& entry = entries[i];
        number = i > 0 && entries[i - 1].name == entry.name ? number + 1 : 1;
        const std::string name(entry.name.substr(0, entry.name.find('[')));
        const std::string only = only_text(kind, entry.name, number, declarations);
        std::vector<DescriptorRow>& rows = descriptors[{entry.set, entry.binding}];
        const auto [descriptor_kind, count] = entry_of(entry);
        const auto same = std::ranges::find_if(rows, [&, wanted = descriptor_kind](const DescriptorRow& row) {
            return row.name == name && row.kind == wanted && row.only == only && entry.name != name;
        });
        if (same != rows.end())  // another element of an array of blocks
            ++same->count;
        else
            rows.push_back({name, descriptor_kind, count, stage_bits(entry.stages), only});
    }
}

std::vector<std::string> descriptor_rows(const Interface& interface, const Declarations& declarations) {
    Descriptors descriptors;
    const auto as = [](std::string_view kind) { return [kind](const Block&) { return std::pair(kind, 1); }; };
    add(descriptors, interface.blocks, "uniform block", declarations, as("uniform_buffer"));
    add(descriptors, interface.storage_blocks, "storage block", declarations, as("storage_buffer"));
    add(descriptors, interface.samplers, "sampler", declarations, [](const Sampler& sampler) {
        return std::pair(descriptor_kind(sampler.type), element_count(sampler.array));
    });
    std::vector<std::string> rows;
    for (const auto& [place, list] : descriptors) {
        const auto& [set, binding] = place;
        for (const DescriptorRow& row : list)
            rows.push_back(fmt::format("{{{}, {}, {}, gobo::DescriptorKind::{}, {}, {:#x}{}}}",
                                       cpp_literal(row.name), set, binding, row.kind, row.count, row.stages,
                                       row.only));
    }
    return rows;
}

/// VkFormat of up to four numbers; nothing where Vulkan has none that every device takes.
std::optional<int> format_of(const GlslType& type) {
    const int more = type.rows - 1;
    switch (type.scalar) {
        case Scalar::uint32:
            return 98 + 3 * more;  // VK_FORMAT_R32_UINT, and so on
        case Scalar::int32:
            return 99 + 3 * more;
        case Scalar::float32:
            return 100 + 3 * more;
        case Scalar::float64:
            return 112 + 3 * more;
        default:
            return std::nullopt;
    }
}

/// A row for each column of a matrix and element of an array.
std::vector<std::string> vertex_input_rows(const Interface& interface, const Declarations& declarations,
                                           Dialect dialect) {
    std::vector<std::string> rows;
    int number = 0;
    for (std::size_t i = 0; i < interface.inputs.size(); ++i) {
        const Variable& input = interface.inputs[i];
        number = i > 0 && interface.inputs[i - 1].name == input.name ? number + 1 : 1;
        const GlslType type = glsl_type(input.type).value_or(GlslType{});
        const std::optional<int> format = format_of(type);
        if (!format) continue;
        const std::string only = only_text("input", input.name, number, declarations);
        const int columns = type.columns * element_count(input.array);
        const int step = dialect == Dialect::vulkan ? vulkan_locations_of_column(type) : 1;
        for (int column = 0; column < columns; ++column)
            rows.push_back(fmt::format("{{{}, {}, {}, {}, {}{}}}", cpp_literal(input.name),
                                       cpp_literal(input.type), input.location + column * step, *format,
                                       type.column_size(), only));
    }
    return rows;
}

/// The value that a permutation gives to a constant: its count, or the constant's default.
std::string value_of(const SpecializationConstant& constant, const CppKey& key) {
    for (const CppFeature& feature : key.features)
        if (feature.feature->is_specialized && feature.feature->macro == constant.name)
            return fmt::format("static_cast<std::uint32_t>(own.{})", feature.member);
    return fmt::format("{:#x}U", constant.value);
}

}  // namespace

Result<void> spirv_section(const EmitInput& input, const Interface& interface, const CppKey& key,
                           const Declarations& declarations, const HeaderTemplates& templates,
                           TemplateValues& values) {
    const Dialect dialect = input.composition.dialect;
    values["stage_type"] = is_spirv(dialect) ? "SpirvStage" : "Stage";
    for (const char* name : {"includes", "spirv_tables", "spirv", "specialization"}) values[name] = "";
    if (!is_spirv(dialect)) return {};
    values["includes"] = "#include <gobo/spirv.hpp>\n";
    TemplateValues own;
    std::vector<std::string> descriptors;
    if (dialect == Dialect::vulkan) descriptors = descriptor_rows(interface, declarations);
    add_table(own, "descriptor", descriptors);
    std::vector<std::string> push_constants;
    for (const Block& block : interface.push_constants)
        push_constants.push_back(fmt::format("{{{}, {}, {:#x}, {}}}", cpp_literal(block.name), block.size,
                                             stage_bits(block.stages),
                                             std::ranges::min(block.members, {}, &Member::offset).offset));
    add_table(own, "push_constant", push_constants);
    add_table(own, "vertex_input", vertex_input_rows(interface, declarations, dialect));
    std::vector<std::string> constants;
    std::string constant_values;
    for (const SpecializationConstant& constant : interface.specialization_constants) {
        constants.push_back(fmt::format("{{{}, {}, {}, {:#x}}}", cpp_literal(constant.name),
                                        cpp_literal(constant.type), constant.id, constant.value));
        constant_values += (constant_values.empty() ? "" : ", ") + value_of(constant, key);
    }
    add_table(own, "specialization_constant", constants);
    GOBO_TRY(values["spirv_tables"], fill(templates.at("spirv_tables"), own));
    std::string& sets = own["descriptor_sets"];
    CppScope scope;
    for (std::size_t set = 0; set < input.family.descriptor_sets.size(); ++set)
        sets += fmt::format("inline constexpr std::uint32_t {} = {};\n",
                            scope.claim(cpp_identifier(input.family.descriptor_sets[set].name)), set);
    GOBO_TRY(values["spirv"], fill(templates.at("spirv"), own));
    values["specialization"] = fmt::format(
        "    /// Values for `specialization_constants`, in their order: the key's counts, and the defaults "
        "of\n"
        "    /// others. What a stage does not have, Vulkan ignores.\n"
        "    [[nodiscard]] {} std::array<std::uint32_t, {}> specialization() const {{\n"
        "        [[maybe_unused]] const Key own = key();\n"
        "        return {{ {} }};\n    }}\n",
        values.at("lookup"), constants.size(), constants.empty() ? "" : "{" + constant_values + "}");
    return {};
}

}  // namespace gobo
