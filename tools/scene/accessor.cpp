#include "scene/accessor.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/text.hpp"

namespace gobo::scene {
namespace {

/// More numbers than this are read of no scene: half a gigabyte in double precision. Accessors may overlap,
/// so that a small file can ask for any amount.
constexpr std::size_t most_components = std::size_t{1} << 26;
/// And no more than this of an accessor without a buffer view, which costs a file nothing.
constexpr std::size_t most_zeros = std::size_t{1} << 22;

std::size_t size_of(Component component) {
    switch (component) {
        case Component::signed_byte:
        case Component::unsigned_byte:
            return 1;
        case Component::signed_short:
        case Component::unsigned_short:
            return 2;
        default:
            return 4;
    }
}

std::string_view name_of(Component component) {
    switch (component) {
        case Component::signed_byte:
            return "byte";
        case Component::unsigned_byte:
            return "unsigned byte";
        case Component::signed_short:
            return "short";
        case Component::unsigned_short:
            return "unsigned short";
        case Component::unsigned_int:
            return "unsigned int";
        case Component::float_number:
            return "float";
    }
    return "float";
}

std::size_t width_of(std::string_view shape) {
    constexpr std::pair<std::string_view, std::size_t> widths[] = {
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
    for (const auto& [name, width] : widths)
        if (name == shape) return width;
    return 1;
}

/// A matrix's columns begin at multiples of four bytes (glTF 2.0 specification, 3.6.2.4).
std::size_t element_size(std::string_view shape, std::size_t width, Component component) {
    if (!shape.starts_with("MAT")) return width * size_of(component);
    const auto rows = static_cast<std::size_t>(shape.back() - '0');
    return rows * ((rows * size_of(component) + 3) / 4 * 4);
}

std::uint32_t bits_at(std::string_view bytes, std::size_t offset, std::size_t size) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < size; ++i)
        bits |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[offset + i])) << (8 * i);
    return bits;
}

double number_at(std::string_view bytes, std::size_t offset, Component component, bool normalized) {
    const std::uint32_t bits = bits_at(bytes, offset, size_of(component));
    switch (component) {
        case Component::signed_byte: {
            const double value = static_cast<std::int8_t>(bits);
            return normalized ? std::max(value / 127, -1.0) : value;
        }
        case Component::unsigned_byte:
            return normalized ? bits / 255.0 : bits;
        case Component::signed_short: {
            const double value = static_cast<std::int16_t>(bits);
            return normalized ? std::max(value / 32767, -1.0) : value;
        }
        case Component::unsigned_short:
            return normalized ? bits / 65535.0 : bits;
        case Component::unsigned_int:
            return bits;
        case Component::float_number:
            return std::bit_cast<float>(bits);
    }
    return 0;
}

std::string kind_of(std::string_view shape, Component component) {
    return fmt::format("{} of {}", shape, name_of(component));
}

}  // namespace

Accessors::Accessors(Document& document, const Buffers& buffers) : document_(document) {
    read_views(buffers);
    for (const Value& value : document_.objects(document_.root(), "accessors")) {
        accessors_.push_back(read_accessor(value));
        if (document_.failed()) return;
    }
}

void Accessors::read_views(const Buffers& buffers) {
    for (const Value& value : document_.objects(document_.root(), "bufferViews")) {
        const int buffer = document_.required_index(value, "buffer", buffers.contents.size(), "buffers");
        const std::int64_t offset = document_.integer(value, "byteOffset").value_or(0);
        const std::int64_t length = document_.required_integer(value, "byteLength");
        const auto stride = document_.integer(value, "byteStride");
        if (document_.failed()) return;
        const std::string_view content = buffers.contents[static_cast<std::size_t>(buffer)];
        const auto available = static_cast<std::int64_t>(content.size());
        if (offset < 0 || length < 1 || offset > available || length > available - offset) {
            document_.error(value.path,
                            fmt::format("spans {} bytes from byte {}, but buffers[{}] holds {} bytes", length,
                                        offset, buffer, available));
        }
        if (stride && (*stride < 4 || *stride > 252 || *stride % 4 != 0)) {
            document_.error(path_to(value, "byteStride"),
                            fmt::format("is {}, but must be a multiple of 4 from 4 to 252", *stride));
        }
        if (document_.failed()) return;
        views_.push_back({content.substr(static_cast<std::size_t>(offset), static_cast<std::size_t>(length)),
                          static_cast<std::size_t>(stride.value_or(0))});
    }
}

Component Accessors::read_component(const Value& value) {
    const std::int64_t number = document_.required_integer(value, "componentType");
    for (const Component component :
         {Component::signed_byte, Component::unsigned_byte, Component::signed_short,
          Component::unsigned_short, Component::unsigned_int, Component::float_number})
        if (static_cast<std::int64_t>(component) == number) return component;
    document_.error(path_to(value, "componentType"),
                    fmt::format("is {}, but must be one of 5120, 5121, 5122, 5123, 5125, 5126", number));
    return Component::float_number;
}

Accessors::Accessor Accessors::read_accessor(const Value& value) {
    Accessor accessor;
    accessor.path = value.path;
    accessor.component = read_component(value);
    const auto shape =
        document_.choice(value, "type", {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"});
    if (!shape) document_.error(path_to(value, "type"), "is missing");
    const std::int64_t count = document_.required_integer(value, "count");
    if (count < 1)
        document_.error(path_to(value, "count"), fmt::format("is {}, but must be at least 1", count));
    accessor.normalized = document_.boolean(value, "normalized").value_or(false);
    if (document_.failed()) return accessor;
    accessor.shape = *shape;
    accessor.width = width_of(*shape);
    accessor.count = static_cast<std::size_t>(count);
    accessor.view = view_from(value, element_size(*shape, accessor.width, accessor.component),
                              size_of(accessor.component), accessor.count);
    accessor.sparse = read_sparse(value, accessor);
    return accessor;
}

/// The view of `count` elements that `value` names, checked to lie within its buffer view; nothing where it
/// names none.
std::optional<Accessors::View> Accessors::view_from(const Value& value, std::size_t element_size,
                                                    std::size_t component_size, std::size_t count) {
    const auto index = document_.index(value, "bufferView", views_.size(), "buffer views");
    const std::int64_t offset = document_.integer(value, "byteOffset").value_or(0);
    if (!index) return std::nullopt;
    const View& view = views_[static_cast<std::size_t>(*index)];
    const std::size_t stride = view.stride == 0 ? element_size : view.stride;
    const std::size_t available = view.bytes.size();
    if (offset < 0 || static_cast<std::size_t>(offset) % component_size != 0) {
        document_.error(path_to(value, "byteOffset"),
                        fmt::format("is {}, but must be a multiple of {}", offset, component_size));
        return std::nullopt;
    }
    if (stride < element_size) {
        document_.error(value.path,
                        fmt::format("has elements of {} bytes, but bufferViews[{}].byteStride is {}",
                                    element_size, *index, stride));
        return std::nullopt;
    }
    const auto start = static_cast<std::size_t>(offset);
    const bool has_room = start <= available && element_size <= available - start;
    const std::size_t room = has_room ? (available - start - element_size) / stride + 1 : 0;
    if (count > room) {
        document_.error(value.path, fmt::format("asks for {} elements, but bufferViews[{}] has room for {}",
                                                count, *index, room));
        return std::nullopt;
    }
    return View{view.bytes.substr(start), stride};
}

std::optional<Accessors::Sparse> Accessors::read_sparse(const Value& value, const Accessor& accessor) {
    const auto source = document_.object(value, "sparse");
    if (!source) return std::nullopt;
    const auto indices = document_.object(*source, "indices");
    const auto values = document_.object(*source, "values");
    const std::int64_t count = document_.required_integer(*source, "count");
    if (!indices || !values) document_.error(source->path, "needs both indices and values");
    if (count < 1 || static_cast<std::uint64_t>(count) > accessor.count) {
        document_.error(path_to(*source, "count"),
                        fmt::format("is {}, but must be from 1 to {}", count, accessor.count));
    }
    if (document_.failed()) return std::nullopt;
    Sparse sparse;
    sparse.count = static_cast<std::size_t>(count);
    sparse.index_component = read_component(*indices);
    const std::size_t index_size = size_of(sparse.index_component);
    const auto index_view = view_from(*indices, index_size, index_size, sparse.count);
    const auto value_view =
        view_from(*values, element_size(accessor.shape, accessor.width, accessor.component),
                  size_of(accessor.component), sparse.count);
    if (!index_view || !value_view) {
        document_.error(source->path, "names no buffer view");
        return std::nullopt;
    }
    sparse.indices = *index_view;
    sparse.values = *value_view;
    return sparse;
}

void Accessors::apply(const Accessor& accessor, const Sparse& sparse, Values& values) {
    double before = -1;
    for (std::size_t i = 0; i < sparse.count; ++i) {
        const double index =
            number_at(sparse.indices.bytes, i * sparse.indices.stride, sparse.index_component, false);
        if (index <= before || index >= static_cast<double>(values.count)) {
            document_.error(accessor.path,
                            fmt::format("has sparse indices that do not rise from 0 to {}: {} after {}",
                                        values.count - 1, index, before));
            return;
        }
        before = index;
        for (std::size_t k = 0; k < values.width; ++k) {
            values.numbers[static_cast<std::size_t>(index) * values.width + k] =
                number_at(sparse.values.bytes, i * sparse.values.stride + k * size_of(accessor.component),
                          accessor.component, accessor.normalized);
        }
    }
}

bool Accessors::accepts(const Accessor& accessor, const Wanted& wanted, std::string_view user) {
    const bool shape_fits =
        std::find(wanted.shapes.begin(), wanted.shapes.end(), accessor.shape) != wanted.shapes.end();
    const bool component_fits = std::find(wanted.components.begin(), wanted.components.end(),
                                          accessor.component) != wanted.components.end();
    if (shape_fits && component_fits) return true;
    std::vector<std::string> kinds;
    for (const Component component : wanted.components) kinds.emplace_back(name_of(component));
    document_.error(user, fmt::format("names {}, which holds {}, not {} of {}", accessor.path,
                                      kind_of(accessor.shape, accessor.component),
                                      fmt::join(wanted.shapes, " or "), join(kinds, " or ")));
    return false;
}

std::optional<std::string_view> Accessors::view(const Value& parent, std::string_view name) {
    const auto index = document_.index(parent, name, views_.size(), "buffer views");
    if (!index || document_.failed()) return std::nullopt;
    return views_[static_cast<std::size_t>(*index)].bytes;
}

Values Accessors::read(int index, const Wanted& wanted, std::string_view user) {
    if (document_.failed()) return {};
    const Accessor& accessor = accessors_[static_cast<std::size_t>(index)];
    if (!accepts(accessor, wanted, user)) return {};
    if (accessor.count > (most_components - components_read_) / accessor.width) {
        document_.error(accessor.path,
                        fmt::format("has {} elements: the scene would hold more than {} numbers",
                                    accessor.count, most_components));
        return {};
    }
    if (!accessor.view && accessor.count > most_zeros / accessor.width) {
        document_.error(accessor.path,
                        fmt::format("has {} elements without a buffer view: more than {} zeros",
                                    accessor.count, most_zeros));
        return {};
    }
    Values values{accessor.width, accessor.count, std::vector<double>(accessor.count * accessor.width, 0.0)};
    components_read_ += values.numbers.size();
    if (accessor.view) {
        const std::size_t size = size_of(accessor.component);
        for (std::size_t i = 0; i < values.count; ++i) {
            for (std::size_t k = 0; k < values.width; ++k) {
                values.numbers[i * values.width + k] =
                    number_at(accessor.view->bytes, i * accessor.view->stride + k * size, accessor.component,
                              accessor.normalized);
            }
        }
    }
    if (accessor.sparse) apply(accessor, *accessor.sparse, values);
    const auto bad = std::find_if_not(values.numbers.begin(), values.numbers.end(),
                                      [](double number) { return std::isfinite(number); });
    if (bad != values.numbers.end()) {
        const auto element = static_cast<std::size_t>(bad - values.numbers.begin()) / values.width;
        document_.error(user, fmt::format("is not finite in element {} of {}", element, accessor.path));
    }
    if (document_.failed()) return {};
    return values;
}

}  // namespace gobo::scene
