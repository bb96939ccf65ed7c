#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "emit/sections.hpp"
#include "spirv/glsl_type.hpp"

namespace gobo {
namespace {

/// Gives every item without a place the lowest free one: one and the same to all declarations of a name.
/// `size` says how many places an item takes.
template <class Item, class SizeOf>
void fill_places(std::vector<Item>& items, SizeOf size) {
    std::set<int> taken;
    const auto take = [&](const Item& item) {
        for (int used = 0; used < size(item); ++used) taken.insert(place_of(item) + used);
    };
    for (const Item& item : items)
        if (place_of(item) >= 0) take(item);
    for (auto item = items.begin(); item != items.end();) {
        const auto end =
            std::find_if(item, items.end(), [&](const Item& other) { return other.name != item->name; });
        int most = 0;
        for (auto same = item; same != end; ++same)
            if (place_of(*same) < 0) most = std::max(most, size(*same));
        int first = 0;
        for (int used = 0; used < most;) {
            const bool free = !taken.contains(first + used);
            used = free ? used + 1 : 0;
            if (!free) ++first;
        }
        for (; item != end; ++item) {
            if (place_of(*item) >= 0) continue;
            place_of(*item) = first;
            take(*item);
        }
    }
}

/// The indices of an element of an array of blocks: 2 of "Lights[2]".
std::vector<int> indices_of(std::string_view name) {
    std::vector<int> indices;
    for (std::size_t open = name.find('['); open != std::string_view::npos; open = name.find('[', open + 1)) {
        int& index = indices.emplace_back(0);
        for (std::size_t at = open + 1; name[at] >= '0' && name[at] <= '9'; ++at)
            index = index * 10 + (name[at] - '0');
    }
    return indices;
}

/// Gives blocks the bindings that they lack. The elements of an array take one after the other, in the order
/// of their indices, which is not that of their names; in Vulkan they share one.
void fill_bindings(std::vector<Block>& blocks) {
    std::map<std::string, std::set<std::vector<int>>> elements;  // by the array's name
    const auto array_of = [](const Block& block) { return block.name.substr(0, block.name.find('[')); };
    for (const Block& block : blocks) elements[array_of(block)].insert(indices_of(block.name));
    const auto rank_of = [&](const Block& block) {
        if (block.set >= 0) return 0;
        const auto& all = elements[array_of(block)];
        return static_cast<int>(std::distance(all.begin(), all.find(indices_of(block.name))));
    };
    std::vector<Block> arrays;  // and single blocks: one for each declaration
    for (const Block& block : blocks) {
        Block first = block;
        first.name = array_of(block);
        if (block.binding >= 0) first.binding -= rank_of(block);
        arrays.push_back(std::move(first));
    }
    fill_places(arrays, [&](const Block& array) { return static_cast<int>(elements[array.name].size()); });
    for (std::size_t i = 0; i < blocks.size(); ++i)
        blocks[i].binding = arrays[i].binding + rank_of(blocks[i]);
}

/// A constant of the header, without its name.
struct Constant {
    std::string type;
    std::string value;  ///< with its braces, or behind " = "
};

/// A constant for each variable or sampler: where it is. Declarations of a name whose constants are alike
/// share one.
template <class Item, class ConstantOf>
std::string constants_of(const std::vector<Item>& items, const std::vector<Domain>& domains,
                         ConstantOf constant_of) {
    CppScope scope;
    std::string text;
    for (auto item = items.begin(); item != items.end();) {
        const std::string domain = domain_text(domains, item->name);
        const std::string& name = item->name;
        const std::string identifier = cpp_identifier(name);
        for (int number = 1; item != items.end() && item->name == name; ++number) {
            const Constant constant = constant_of(*item);
            std::string types = item->type;
            for (++item; item != items.end() && item->name == name; ++item) {
                const Constant other = constant_of(*item);
                if (other.type != constant.type || other.value != constant.value) break;
                if (item->type != item[-1].type) types += " or " + item->type;
            }
            text +=
                fmt::format("inline constexpr {} {}{};  ///< {}{}{}\n", constant.type,
                            scope.claim(number == 1 ? identifier : fmt::format("{}_{}", identifier, number)),
                            constant.value, cpp_comment(types), domain.empty() ? "" : ", ", domain);
        }
    }
    return text;
}

/// The C++ type of the application's values.
std::string value_type(const std::string& type) {
    constexpr std::string_view numbers[] = {"float", "std::int32_t", "std::uint32_t", "bool", "double"};
    const std::optional<GlslType> glsl = glsl_type(type);
    if (!glsl || glsl->scalar > Scalar::float64) return "void";  // nothing that set() takes: atomic_uint
    const std::string_view number = numbers[static_cast<std::size_t>(glsl->scalar)];
    if (glsl->is_matrix())
        return fmt::format("std140::PlainMatrix<{}, {}, {}>", glsl->columns, glsl->rows, number);
    return glsl->rows == 1 ? std::string(number) : fmt::format("std140::Vector<{}, {}>", glsl->rows, number);
}

/// ", 3" behind the last argument of a template, where it is an array.
std::string extent_of(const std::vector<int>& array) {
    const int count = element_count(array);
    return count == 1 ? "" : fmt::format(", {}", count);
}

/// Of gobo::target: as what textures for the sampler are bound.
std::string target_of(std::string_view type) {
    constexpr std::pair<std::string_view, std::string_view> kTargets[] = {
        {"1D", "texture_1d"},
        {"1DArray", "texture_1d_array"},
        {"2D", "texture_2d"},
        {"2DArray", "texture_2d_array"},
        {"2DMS", "texture_2d_multisample"},
        {"2DMSArray", "texture_2d_multisample_array"},
        {"2DRect", "texture_rectangle"},
        {"3D", "texture_3d"},
        {"Buffer", "texture_buffer"},
        {"Cube", "texture_cube"},
        {"CubeArray", "texture_cube_array"},
    };
    constexpr std::string_view kSampler = "sampler";
    constexpr std::string_view kShadow = "Shadow";
    if (type.starts_with('i') || type.starts_with('u')) type.remove_prefix(1);
    if (!type.starts_with(kSampler)) return "0";
    type.remove_prefix(kSampler.size());
    if (type.ends_with(kShadow)) type.remove_suffix(kShadow.size());
    for (const auto& [shape, target] : kTargets)
        if (shape == type) return fmt::format("gobo::target::{}", target);
    return "0";
}

/// Of the declarations in a list which one each is of its name, from 1.
template <class Item>
int number_of(const std::vector<Item>& items, const Item& item) {
    int number = 1;
    for (const Item* other = &item; other != items.data() && other[-1].name == item.name; --other) ++number;
    return number;
}

/// ", {2, 1}" where the item is a declaration of a name that permutations declare differently.
template <class Item>
std::string only_of(const std::vector<Item>& items, const Item& item, std::string_view kind,
                    const Declarations& declarations) {
    return only_text(kind, item.name, number_of(items, item), declarations);
}

/// Name, type, place and, where each element takes a place, how many: as the header's tables have them.
template <class Item>
std::string row_of(const Item& item, const std::string& only) {
    std::string row = "{" + cpp_literal(item.name);
    if constexpr (requires { item.type; }) row += ", " + cpp_literal(item.type);
    row += fmt::format(", {}", place_of(item));
    if constexpr (std::is_same_v<Item, Sampler>) row += fmt::format(", {}", element_count(item.array));
    return row + only + "}";
}

/// A row for each name that OpenGL knows: members of structs, and elements of arrays of structs or arrays,
/// are uniforms of their own, at locations that follow one another where the first is stated.
void add_uniform_rows(const Uniform& uniform, int& location, const std::string& only,
                      std::vector<std::string>& rows) {
    Uniform part = uniform;
    const bool is_plain_array = uniform.members.empty() && uniform.array.size() == 1;
    if (!uniform.array.empty() && !is_plain_array) {
        part.array.erase(part.array.begin());
        for (int index = 0; index < uniform.array.front(); ++index) {
            part.name = fmt::format("{}[{}]", uniform.name, index);
            add_uniform_rows(part, location, only, rows);
        }
        return;
    }
    for (const Member& member : uniform.members)
        add_uniform_rows(
            {uniform.name + "." + member.name, member.type, -1, member.array, member.members, {}}, location,
            only, rows);
    if (!uniform.members.empty()) return;
    const int count = element_count(uniform.array);
    rows.push_back(fmt::format("{{{}, {}, {}, {}{}}}", cpp_literal(uniform.name), cpp_literal(uniform.type),
                               location, count, only));
    if (location >= 0) location += count;
}

/// The constants of uniforms outside blocks: typed, at the rows that add_uniform_rows() gives them. Structs
/// become structs, arrays of structs std::array.
class UniformConstants {
  public:
    void add(const Uniform& uniform, int number, const std::vector<Domain>& domains) {
        const std::string identifier = cpp_identifier(uniform.name);
        const std::string name =
            scope_.claim(number == 1 ? identifier : fmt::format("{}_{}", identifier, number));
        const Place place = place_of_uniform(uniform);
        const std::string domain = domain_text(domains, uniform.name);
        constants_ += fmt::format("inline constexpr {} {}{};  ///< {}{}{}\n", place.type, name, place.value,
                                  uniform.type, domain.empty() ? "" : ", ", domain);
    }
    [[nodiscard]] std::string text() const { return structs_ + constants_; }

  private:
    struct Place {
        std::string type;
        std::string value;  ///< with its braces
    };

    Place place_of_uniform(Uniform uniform) {
        const bool is_plain = uniform.members.empty();
        if (is_plain && uniform.array.size() < 2) {
            return {fmt::format("gobo::UniformPlace<detail::Tables, {}{}>", value_type(uniform.type),
                                extent_of(uniform.array)),
                    fmt::format("{{{}}}", row_++)};
        }
        if (!uniform.array.empty()) {
            const int extent = uniform.array.front();
            uniform.array.erase(uniform.array.begin());
            Place element;
            std::vector<std::string> values;
            for (int index = 0; index < extent; ++index) {
                element = place_of_uniform(uniform);
                values.push_back(element.value);
            }
            return {fmt::format("std::array<{}, {}>", element.type, extent),
                    fmt::format("{{{{{}}}}}", fmt::join(values, ", "))};
        }
        std::string members;
        std::vector<std::string> values;
        CppScope scope;
        for (const Member& member : uniform.members) {
            const Place place =
                place_of_uniform({member.name, member.type, -1, member.array, member.members, {}});
            members += fmt::format("    {} {};\n", place.type, scope.claim(cpp_identifier(member.name)));
            values.push_back(place.value);
        }
        return {struct_of(uniform.type, members), fmt::format("{{{}}}", fmt::join(values, ", "))};
    }

    /// The name of a struct with these members, written once.
    std::string struct_of(const std::string& type, const std::string& members) {
        const auto [place, is_new] = names_.try_emplace(members);
        if (is_new) {
            place->second = scope_.claim(cpp_identifier(type) + "_places");
            structs_ += fmt::format("struct {} {{\n{}}};\n", place->second, members);
        }
        return place->second;
    }

    CppScope scope_;
    std::map<std::string, std::string> names_;  ///< of structs, by their members
    std::string structs_;
    std::string constants_;
    int row_ = 0;
};

}  // namespace

std::string only_text(std::string_view kind, std::string_view name, int number,
                      const Declarations& declarations) {
    const auto differing = declarations.find(kind, name);
    return differing ? fmt::format(", {{{}, {}}}", *differing, number) : std::string();
}

Interface with_places(Interface interface) {
    const auto is_built_in = [](const Variable& variable) { return variable.name.starts_with("gl_"); };
    std::erase_if(interface.inputs, is_built_in);
    std::erase_if(interface.outputs, is_built_in);
    fill_bindings(interface.blocks);
    fill_bindings(interface.storage_blocks);
    fill_places(interface.samplers, [](const Sampler& sampler) { return element_count(sampler.array); });
    fill_places(interface.inputs,
                [](const Variable& input) { return location_count(input.type, input.array); });
    if (interface.outputs.size() == 1 && interface.outputs.front().location < 0)
        interface.outputs.front().location = 0;
    return interface;
}

void interface_section(const Interface& interface, const std::vector<Domain>& domains,
                       const Declarations& declarations, Dialect dialect, TemplateValues& values) {
    const bool is_vulkan = dialect == Dialect::vulkan;
    values["attribute_use"] = is_vulkan ? "gobo::vulkan::vertex_attributes()" : "gobo::gl::point_to()";
    values["sampler_use"] =
        is_vulkan ? "their places in descriptor sets" : "their texture units, for gobo::gl::bind_texture()";
    values["attribute_constants"] = constants_of(interface.inputs, domains, [](const Variable& input) {
        return Constant{
            fmt::format("gobo::AttributePlace<{}{}>", value_type(input.type), extent_of(input.array)),
            fmt::format("{{{}}}", input.location)};
    });
    values["output_constants"] = constants_of(interface.outputs, domains, [](const Variable& output) {
        return Constant{"int", fmt::format(" = {}", output.location)};
    });
    values["sampler_constants"] = constants_of(interface.samplers, {}, [&](const Sampler& sampler) {
        if (is_vulkan)
            return Constant{"gobo::DescriptorPlace", fmt::format("{{{}, {}}}", sampler.set, sampler.binding)};
        // Declarations of a name share the row of the first: its location is that of the name.
        const auto first = std::ranges::find(interface.samplers, sampler.name, &Sampler::name);
        return Constant{fmt::format("gobo::SamplerPlace<detail::Tables, {}{}>", target_of(sampler.type),
                                    extent_of(sampler.array)),
                        fmt::format("{{{}, {}}}", first - interface.samplers.begin(), sampler.binding)};
    });
    const auto add_rows = [&](const std::string& name, const std::string& kind, const auto& items) {
        std::vector<std::string> rows;
        for (const auto& item : items) rows.push_back(row_of(item, only_of(items, item, kind, declarations)));
        add_table(values, name, rows);
    };
    add_rows("attribute", "input", interface.inputs);
    add_rows("output", "output", interface.outputs);
    add_rows("block", "uniform block", interface.blocks);
    add_rows("storage_block", "storage block", interface.storage_blocks);
    add_rows("sampler", "sampler", interface.samplers);
    std::vector<std::string> uniforms;
    UniformConstants constants;
    for (const Uniform& uniform : interface.uniforms) {
        constants.add(uniform, number_of(interface.uniforms, uniform), domains);
        int location = uniform.location;
        add_uniform_rows(uniform, location, only_of(interface.uniforms, uniform, "uniform", declarations),
                         uniforms);
    }
    add_table(values, "uniform", uniforms);
    values["uniform_constants"] = constants.text();
}

}  // namespace gobo
