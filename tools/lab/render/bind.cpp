#include "lab/render/bind.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/text.hpp"
#include "family/render_sources.hpp"
#include "lab/render/camera.hpp"
#include "lab/render/texture.hpp"

namespace gobo {
namespace {

/// Of an inner dimension: std140 and std430 pack the elements of an array of arrays without a gap.
int stride_of(const Member& member, std::size_t dimension) {
    int stride = member.array_stride;
    for (std::size_t i = 1; i <= dimension; ++i) stride /= member.array[i] > 0 ? member.array[i] : 1;
    return stride;
}

/// Adds the leaves of a member, which is called `name` and begins at `offset`. `dimension` is the first of
/// its array dimensions that the name does not spell out yet.
void flatten(const Member& member, const std::string& block, const std::string& name, int offset,
             std::size_t dimension, std::vector<Leaf>& leaves) {
    const std::size_t left = member.array.size() - dimension;
    if (left > (member.members.empty() ? 1U : 0U)) {
        for (int i = 0; i < member.array[dimension]; ++i)
            flatten(member, block, fmt::format("{}[{}]", name, i), offset + i * stride_of(member, dimension),
                    dimension + 1, leaves);
        return;
    }
    for (const Member& inner : member.members)
        flatten(inner, block, name + "." + inner.name, offset + inner.offset, 0, leaves);
    if (!member.members.empty()) return;
    Leaf leaf{name, block, member.type};
    leaf.is_array = left == 1;
    leaf.offset = offset;
    leaf.matrix_stride = member.matrix_stride;
    leaf.row_major = member.row_major;
    if (leaf.is_array) {
        leaf.count = member.array.back();
        leaf.array_stride = stride_of(member, member.array.size() - 1);
    }
    leaves.push_back(std::move(leaf));
}

/// The leaf of that name. "weights[2]" finds the element 2 of the leaf "weights", with what follows it in its
/// array counted. Nothing where there is none, or the element lies outside of the array.
std::optional<Leaf> find_leaf(const std::vector<Leaf>& leaves, std::string_view name) {
    for (const Leaf& leaf : leaves)
        if (leaf.name == name) return leaf;
    const std::size_t bracket = name.rfind('[');
    if (bracket == std::string_view::npos || name.back() != ']') return std::nullopt;
    int element = -1;
    std::from_chars(name.data() + bracket + 1, name.data() + name.size() - 1, element);
    for (Leaf leaf : leaves) {
        if (leaf.name != name.substr(0, bracket) || element < 0 || element >= leaf.count) continue;
        leaf.name = name;
        leaf.offset += element * leaf.array_stride;
        leaf.count -= element;
        return leaf;
    }
    return std::nullopt;
}

/// The type of that name, where it is one that OpenGL can set.
std::optional<GlslType> settable_type(std::string_view name) {
    constexpr std::array kSettable = {Scalar::float32, Scalar::float64, Scalar::int32, Scalar::uint32,
                                      Scalar::boolean};
    const auto type = glsl_type(name);
    const bool is_settable =
        type && std::find(kSettable.begin(), kSettable.end(), type->scalar) != kSettable.end();
    return is_settable ? type : std::nullopt;
}

/// A value that the renderer supplies: a matrix, or a vector as the first column of one. `numbers` are those
/// of a point or a direction in world space.
struct Source {
    const char* name;
    const char* spellings;  ///< names that tell it, in lower case, without prefix, underscores and "matrix"
    bool is_matrix;
    bool has_numbers;
    glm::dmat4 (*value)(const ViewedObject& object, const glm::dvec4& numbers);
};

glm::dmat4 column(const glm::dvec4& vector) {
    return {vector, glm::dvec4(0), glm::dvec4(0), glm::dvec4(0)};
}

using Seen = const ViewedObject&;
using Numbers = const glm::dvec4&;
constexpr auto kUniformSources = std::to_array<Source>({
    {"model", "model modeltoworld world objecttoworld", true, false, [](Seen o, Numbers) { return o.model; }},
    {"view", "view worldtoview worldtoeye", true, false, [](Seen o, Numbers) { return o.view; }},
    {"projection", "projection proj viewtoclip", true, false, [](Seen o, Numbers) { return o.projection; }},
    {"model_view", "modelview mv worldview", true, false, [](Seen o, Numbers) { return o.view * o.model; }},
    {"view_projection", "viewprojection viewproj vp worldtoclip", true, false,
     [](Seen o, Numbers) { return o.projection * o.view; }},
    {"model_view_projection", "modelviewprojection modelviewproj mvp worldviewprojection wvp", true, false,
     [](Seen o, Numbers) { return o.projection * (o.view * o.model); }},
    {"inverse_view", "inverseview viewinverse", true, false,
     [](Seen o, Numbers) { return glm::inverse(o.view); }},
    // Object-space normals to eye space, and to world space.
    {"normal_matrix", "normal normals modelviewinversetranspose", true, false,
     [](Seen o, Numbers) { return glm::dmat4(normal_matrix(o.view * o.model)); }},
    {"world_normal_matrix", "", true, false,
     [](Seen o, Numbers) { return glm::dmat4(normal_matrix(o.model)); }},
    {"camera_position", "cameraposition camerapos campos eyeposition eyepos viewposition viewpos", false,
     false, [](Seen o, Numbers) { return column(glm::inverse(o.view)[3]); }},
    // In eye space; a direction has w = 0, and in the second unit length.
    {"eye_point", "", false, true, [](Seen o, Numbers world) { return column(o.view * world); }},
    {"eye_point_and", "", false, true,
     [](Seen o, Numbers world) {
         return column(glm::dvec4(glm::dvec3(o.view * glm::dvec4(glm::dvec3(world), 1)), world.w));
     }},
    {"eye_direction", "", false, true,
     [](Seen o, Numbers world) {
         return column(glm::dvec4(glm::normalize(glm::dmat3(o.view) * glm::dvec3(world)), 0));
     }},
    {"viewport", "viewport viewportsize resolution", false, false,
     [](Seen o, Numbers) { return column(glm::dvec4(o.viewport, 0, 1)); }},
});
// A family file may name each of them.
static_assert(std::ranges::all_of(kUniformSources,
                                  [](const Source& source) { return is_render_source(source.name); }));

/// Sources of attributes, each with its spellings.
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kAttributeSpellings = {
    {{"position", "position pos vertex vertexposition"},
     {"normal", "normal vertexnormal"},
     {"texcoord",
      "texcoord texcoords texcoord0 multitexcoord0 texturecoordinate texturecoord textureuv uv uv0"},
     {"color", "color colour color0 vertexcolor"}}};

/// Takes off `u_`, `in_`, the `legacy_` of what OpenGL once had built in and the like, and a lower-case
/// letter or "in" before a capital.
std::string_view without_prefix(std::string_view name) {
    for (const std::string_view prefix : {"in", "attr", "legacy", "u", "a", "v", "i", "m", "g", "vs"}) {
        if (!name.starts_with(prefix) || name.size() <= prefix.size()) continue;
        const char next = name[prefix.size()];
        if (next == '_') return name.substr(prefix.size() + 1);
        if (std::isupper(static_cast<unsigned char>(next)) != 0) return name.substr(prefix.size());
    }
    return name;
}

std::string plain_spelling(std::string_view name) {
    name.remove_prefix(name.rfind('.') + 1);
    std::string plain;
    for (const char character : without_prefix(name))
        if (character != '_') plain += static_cast<char>(std::tolower(static_cast<unsigned char>(character)));
    for (const std::string_view ending : {"matrix", "mat"})
        if (plain.ends_with(ending) && plain.size() > ending.size())
            plain.erase(plain.size() - ending.size());
    return plain;
}

bool is_spelling(std::string_view plain, std::string_view spellings) {
    return !plain.empty() &&
           fmt::format(" {} ", spellings).find(fmt::format(" {} ", plain)) != std::string::npos;
}

/// The numbers of a source for a uniform of the given type, column by column. Nothing where there is no such
/// source, or it does not fit the type (a matrix for a vector). A 4 x 4 matrix gives a mat3 its upper left
/// part; a mat3 fills a mat4 up from the identity.
std::optional<std::vector<double>> source_value(std::string_view name, const std::vector<double>& numbers,
                                                const ViewedObject& object, const GlslType& type) {
    const auto* const source = std::find_if(kUniformSources.begin(), kUniformSources.end(),
                                            [&](const Source& one) { return one.name == name; });
    if (source == kUniformSources.end() || source->is_matrix != type.is_matrix()) return std::nullopt;
    if (!source->is_matrix && type.rows == 1) return std::nullopt;
    glm::dvec4 vector(0, 0, 0, 1);
    if (source->has_numbers) {
        if (numbers.size() < 3 || numbers.size() > 4) return std::nullopt;
        std::copy(numbers.begin(), numbers.end(), &vector[0]);
        if (name == "eye_direction" && !(glm::length(glm::dvec3(vector)) > 0)) return std::nullopt;
    }
    const glm::dmat4 value = source->value(object, vector);
    std::vector<double> fitted;
    for (int column = 0; column < type.columns; ++column)
        for (int row = 0; row < type.rows; ++row) fitted.push_back(value[column][row]);
    return fitted;
}

/// "lights[].color"
bool is_of_all_elements(const RenderValue& value) {
    return value.name.find("[]") != std::string::npos;
}

/// What a value is for: nothing, one, or every element.
std::vector<Leaf> named_leaves(const std::vector<Leaf>& leaves, const RenderValue& value) {
    std::vector<Leaf> named;
    if (is_of_all_elements(value)) {
        std::ranges::copy_if(leaves, std::back_inserter(named),
                             [&](const Leaf& leaf) { return without_subscripts(leaf.name) == value.name; });
        for (const Leaf& leaf : leaves)  // "weights[]", of an array of numbers
            for (int i = 0; i < leaf.count && without_subscripts(leaf.name) + "[]" == value.name; ++i)
                if (const auto element = find_leaf(leaves, fmt::format("{}[{}]", leaf.name, i)))
                    named.push_back(*element);
    } else if (const auto leaf = find_leaf(leaves, value.name)) {
        named.push_back(*leaf);
    }
    return named;
}

/// A struct may hold samplers beside what has numbers.
bool is_of_sampler(const Interface& interface, const RenderValue& value) {
    return std::ranges::any_of(interface.samplers,
                               [plain = without_subscripts(value.name)](const Sampler& sampler) {
                                   return without_subscripts(sampler.name) == plain;
                               });
}

/// An attribute, or a value that only attributes have.
bool is_of_input(const Interface& interface, const RenderValue& value) {
    const bool is_source_of_uniforms =
        value.source.empty() || std::ranges::any_of(kUniformSources, [&](const Source& source) {
            return source.name == value.source;
        });
    return !is_source_of_uniforms || std::ranges::count(interface.inputs, value.name, &Variable::name) > 0;
}

/// An error where the interface has the block or uniform, but not what the value names in it.
Result<void> check_name(const std::vector<Leaf>& leaves, const RenderValue& value) {
    const auto head_of = [](std::string_view name) { return name.substr(0, name.find_first_of(".[")); };
    const std::string_view head = head_of(value.name);
    const std::string plain = without_subscripts(value.name);
    std::set<std::string> known;
    for (const Leaf& leaf : leaves) {
        if (!leaf.name.starts_with(head) || head_of(leaf.name) != head) continue;
        const std::string name = without_subscripts(leaf.name);
        if (name == plain || name + "[]" == plain) return {};  // an element beyond the array's extent
        known.insert(name);
    }
    if (known.empty()) return {};
    return fail(value.place, {}, fmt::format("'{}' has no member '{}'", head, value.name),
                suggestion(plain, {known.begin(), known.end()}));
}

/// An error where a value names a member of a storage block, which nothing fills.
Result<void> refuse_storage(const Interface& interface, const RenderValue& value) {
    for (const Block& block : interface.storage_blocks)
        if (value.name.starts_with(block.name + "."))
            return fail(
                value.place, {},
                fmt::format("'{}' is in a storage block, which the renderer does not fill", value.name),
                "leave it out, or have the shaders read a uniform block");
    return {};
}

/// A block with one of its members, whatever elements of arrays within the block.
std::string member_of(const Leaf& leaf) {
    return leaf.block + " " + without_subscripts(leaf.name);
}

/// The member without a value that a value means which names nothing: by the block's instance, or by itself.
const Leaf* meant_member(const std::vector<Leaf>& leaves, const RenderValue& value,
                         const std::set<std::string>& given) {
    const auto has_end = [](std::string_view name, std::string_view end) {
        return name.size() > end.size() && name.ends_with(end);
    };
    const std::size_t head = value.name.find_first_of(".[");
    const std::string member = "." + value.name.substr(value.name.rfind('.') + 1);
    const Leaf* meant = nullptr;
    for (const Leaf& leaf : leaves) {
        if (!has_end(leaf.name, member) || given.contains(member_of(leaf))) continue;
        const bool is_same_element = head != std::string::npos && has_end(leaf.name, value.name.substr(head));
        if (is_same_element) return &leaf;
        if (meant == nullptr) meant = &leaf;
    }
    return meant;
}

/// Values that name nothing, though members that they may mean stay 0: these are told of here.
void warn_of_meant_members(const std::vector<Leaf>& leaves, const std::vector<const RenderValue*>& unused,
                           const std::set<std::string>& given, std::set<std::string>& without_value,
                           Diagnostics& warnings) {
    for (const RenderValue* value : unused) {
        const Leaf* leaf = meant_member(leaves, *value, given);
        if (leaf == nullptr) continue;
        without_value.erase(without_subscripts(leaf->name));
        Diagnostic warning =
            no_value(fmt::format("'{}' has no value: '{}' names no uniform", leaf->name, value->name));
        warning.place = value->place;
        warning.help =
            fmt::format("a member is named behind its block, not behind its instance: \"{}\"", leaf->name);
        warnings.push_back(std::move(warning));
    }
}

tl::unexpected<Diagnostics> cannot_supply(const Leaf& leaf, const RenderValue& value) {
    std::vector<std::string> known;
    for (const Source& source : kUniformSources) known.emplace_back(source.name);
    if (std::find(known.begin(), known.end(), value.source) == known.end())
        return unknown_source(value, known);
    return fail(value.place, {},
                fmt::format("the source '{}' with {} numbers cannot supply '{}' of type {}", value.source,
                            value.numbers.size(), value.name, leaf.type),
                value.source.starts_with("eye_")
                    ? "eye_point and eye_direction need numbers = [x, y, z] and give vectors"
                    : "matrices go to matrices, vectors to vectors");
}

/// Fault::input where the count of numbers is not that of whole elements within the array, or the type is
/// none that can be supplied.
Result<void> check(const Assignment& assignment, const Place& place) {
    const Leaf& leaf = assignment.leaf;
    const auto type = settable_type(leaf.type);
    if (!type || (leaf.block.empty() && type->scalar == Scalar::float64 && type->is_matrix()))
        return fail(
            place, {},
            fmt::format("'{}' is of type {}, which the renderer cannot supply", leaf.name, leaf.type));
    const std::size_t components = static_cast<std::size_t>(type->components());
    const std::size_t most = components * static_cast<std::size_t>(leaf.count);
    const std::size_t given = assignment.numbers.size();
    if (given > 0 && given <= most && given % components == 0) return {};
    return fail(place, {}, fmt::format("'{}' is given {} number{}", leaf.name, given, given == 1 ? "" : "s"),
                leaf.count > 1 ? fmt::format("it is an array of {}: give a multiple of {}, at most {}",
                                             leaf.type, components, most)
                               : fmt::format("it is of type {}: give {}", leaf.type, components));
}

Result<Assignment> assign(const Leaf& leaf, const RenderValue& value, const ViewedObject& object) {
    Assignment assignment{leaf, value.numbers};
    const auto type = settable_type(leaf.type);
    if (!value.source.empty() && type) {
        const auto numbers = source_value(value.source, value.numbers, object, *type);
        if (!numbers) return cannot_supply(leaf, value);
        assignment.numbers = *numbers;
    }
    GOBO_TRY_DO(check(assignment, value.place));
    return assignment;
}

/// What the usual spelling of the uniform's name tells, if it fits the type.
std::optional<Assignment> guess(const Leaf& leaf, const ViewedObject& object) {
    const std::string_view source = uniform_source_of(leaf.name);
    const auto type = settable_type(leaf.type);
    if (source.empty() || !type || leaf.is_array || type->scalar != Scalar::float32) return std::nullopt;
    const auto numbers = source_value(source, {}, object, *type);
    return numbers ? std::optional(Assignment{leaf, *numbers}) : std::nullopt;
}

/// The nearest value of an integer type; NaN becomes 0.
template <class Integer>
Integer to_integer(double number) {
    constexpr double low = std::numeric_limits<Integer>::min();
    constexpr double high = std::numeric_limits<Integer>::max();
    return std::isnan(number) ? Integer{0} : static_cast<Integer>(std::clamp(std::round(number), low, high));
}

/// Calls `use` with the number as the type that a component is kept as.
template <class Use>
void with_component(Scalar scalar, double number, const Use& use) {
    switch (scalar) {
        case Scalar::float32:
            return use(static_cast<float>(number));
        case Scalar::float64:
            return use(number);
        case Scalar::int32:
            return use(to_integer<std::int32_t>(number));
        case Scalar::uint32:
            return use(to_integer<std::uint32_t>(number));
        case Scalar::boolean:
            return use(std::int32_t{number != 0 ? 1 : 0});
        default:
            return;  // see settable_type()
    }
}

/// From the start of an element to one of its components.
int component_offset(const Leaf& leaf, const GlslType& type, int index) {
    const int size = type.scalar_size();
    const int column = index / type.rows;
    const int row = index % type.rows;
    if (!type.is_matrix()) return row * size;
    return leaf.row_major ? row * leaf.matrix_stride + column * size
                          : column * leaf.matrix_stride + row * size;
}

void write(const Assignment& assignment, std::vector<std::byte>& block) {
    const Leaf& leaf = assignment.leaf;
    const auto type = settable_type(leaf.type);
    for (int i = 0; type && i < static_cast<int>(assignment.numbers.size()); ++i) {
        const int offset = leaf.offset + i / type->components() * leaf.array_stride +
                           component_offset(leaf, *type, i % type->components());
        with_component(type->scalar, assignment.numbers[static_cast<std::size_t>(i)], [&](auto value) {
            const auto first = static_cast<std::size_t>(offset);
            if (offset >= 0 && first + sizeof value <= block.size())
                std::memcpy(&block[first], &value, sizeof value);
        });
    }
}

template <class Value>
std::vector<Value> values_as(Scalar scalar, const std::vector<double>& numbers) {
    std::vector<Value> values;
    for (const double number : numbers)
        with_component(scalar, number, [&](auto value) { values.push_back(static_cast<Value>(value)); });
    return values;
}

}  // namespace

std::vector<Leaf> leaves_of(const Interface& interface) {
    std::vector<Leaf> leaves;
    for (const auto blocks : {&Interface::blocks, &Interface::push_constants})
        for (const Block& block : interface.*blocks)
            for (const Member& member : block.members)
                flatten(member, block.name, block.name + "." + member.name, member.offset, 0, leaves);
    for (const Uniform& uniform : interface.uniforms) {
        Member member;
        member.name = uniform.name;
        member.type = uniform.type;
        member.array = uniform.array;
        member.members = uniform.members;
        flatten(member, "", uniform.name, 0, 0, leaves);
    }
    return leaves;
}

std::string_view uniform_source_of(std::string_view name) {
    const std::string plain = plain_spelling(name);
    for (const Source& source : kUniformSources)
        if (is_spelling(plain, source.spellings)) return source.name;
    return {};
}

std::string_view attribute_source_of(std::string_view name) {
    const std::string plain = plain_spelling(name);
    for (const auto& [source, spellings] : kAttributeSpellings)
        if (is_spelling(plain, spellings)) return source;
    return {};
}

tl::unexpected<Diagnostics> unknown_source(const RenderValue& value, const std::vector<std::string>& known) {
    return fail(value.place, {}, fmt::format("unknown source '{}' for '{}'", value.source, value.name),
                suggestion(value.source, known));
}

Diagnostic no_value(std::string message) {
    return {.severity = Severity::warning,
            .message = std::move(message),
            .help = "give it one under [render] in the family file"};
}

Result<ResolvedUniforms> resolve_uniforms(const Interface& interface, const std::vector<RenderValue>& values,
                                          const ViewedObject& object) {
    const std::vector<Leaf> leaves = leaves_of(interface);
    ResolvedUniforms resolved;
    std::set<std::string> without_value;
    for (const Leaf& leaf : leaves) {
        if (auto guessed = guess(leaf, object))
            resolved.assignments.push_back(std::move(*guessed));
        else
            without_value.insert(without_subscripts(leaf.name));
    }
    std::vector<RenderValue> ordered = values;  // what is said of all elements, then of one
    std::stable_partition(ordered.begin(), ordered.end(), is_of_all_elements);
    std::vector<const RenderValue*> unused;
    std::set<std::string> given;
    for (const RenderValue& value : ordered) {
        const std::vector<Leaf> named = named_leaves(leaves, value);
        if (named.empty() && !is_of_sampler(interface, value)) {
            GOBO_TRY_DO(check_name(leaves, value));
            GOBO_TRY_DO(refuse_storage(interface, value));
            if (!is_of_input(interface, value)) unused.push_back(&value);
        }
        for (const Leaf& leaf : named) {
            GOBO_TRY(Assignment assignment, assign(leaf, value, object));
            resolved.assignments.push_back(std::move(assignment));
            given.insert(member_of(leaf));
            std::string name = without_subscripts(leaf.name);
            without_value.erase(name);
            if (name.ends_with("[]")) without_value.erase(name.substr(0, name.size() - 2));
        }
    }
    warn_of_meant_members(leaves, unused, given, without_value, resolved.warnings);
    for (const std::string& name : without_value)
        resolved.warnings.push_back(no_value(fmt::format("'{}' has no value and stays 0", name)));
    return resolved;
}

std::vector<std::byte> bytes_of(const Block& block, const std::vector<Assignment>& assignments) {
    std::vector<std::byte> bytes(static_cast<std::size_t>(block.size));
    for (const Assignment& assignment : assignments)
        if (assignment.leaf.block == block.name) write(assignment, bytes);
    return bytes;
}

std::vector<std::byte> pushed_bytes(const Interface& interface, const std::vector<Assignment>& assignments) {
    std::vector<std::byte> bytes;
    for (const Block& block : interface.push_constants)
        bytes.resize(std::max(bytes.size(), static_cast<std::size_t>(block.size)));
    for (const Assignment& assignment : assignments)
        if (std::ranges::count(interface.push_constants, assignment.leaf.block, &Block::name) > 0)
            write(assignment, bytes);
    return bytes;
}

void set_uniform(const GladGLContext& gl, const Program& program, const Assignment& assignment) {
    const auto type = settable_type(assignment.leaf.type);
    const GLint location = gl.GetUniformLocation(program.id(), assignment.leaf.name.c_str());
    if (!type || location < 0) return;
    const auto elements = static_cast<GLsizei>(assignment.numbers.size()) / type->components();
    const auto row = static_cast<std::size_t>(type->rows) - 1;
    const auto set = [&]<class Value>(Value, const auto& setters) {
        setters[row](location, elements, values_as<Value>(type->scalar, assignment.numbers).data());
    };
    if (type->is_matrix()) {
        // By columns, then rows. There are no matrices of doubles here: check() has refused them.
        const PFNGLUNIFORMMATRIX2FVPROC setters[3][3] = {
            {gl.UniformMatrix2fv, gl.UniformMatrix2x3fv, gl.UniformMatrix2x4fv},
            {gl.UniformMatrix3x2fv, gl.UniformMatrix3fv, gl.UniformMatrix3x4fv},
            {gl.UniformMatrix4x2fv, gl.UniformMatrix4x3fv, gl.UniformMatrix4fv}};
        setters[type->columns - 2][row - 1](location, elements, GL_FALSE,
                                            values_as<GLfloat>(type->scalar, assignment.numbers).data());
        return;
    }
    switch (type->scalar) {
        case Scalar::float32:
            return set(GLfloat{}, std::array{gl.Uniform1fv, gl.Uniform2fv, gl.Uniform3fv, gl.Uniform4fv});
        case Scalar::float64:
            return set(GLdouble{}, std::array{gl.Uniform1dv, gl.Uniform2dv, gl.Uniform3dv, gl.Uniform4dv});
        case Scalar::uint32:
            return set(GLuint{}, std::array{gl.Uniform1uiv, gl.Uniform2uiv, gl.Uniform3uiv, gl.Uniform4uiv});
        case Scalar::int32:
        case Scalar::boolean:
            return set(GLint{}, std::array{gl.Uniform1iv, gl.Uniform2iv, gl.Uniform3iv, gl.Uniform4iv});
        default:
            return;  // see settable_type()
    }
}

}  // namespace gobo
