#include "scene/accessor.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace gobo::scene {
namespace {

/// More numbers than this are read of no scene: half a gigabyte in double precision. Accessors may overlap,
/// so that a small file can ask for any amount.
constexpr std::size_t kMostComponents = std::size_t{1} << 26;
/// And no more than this of an accessor without a buffer view, which costs a file nothing.
constexpr std::size_t kMostZeros = std::size_t{1} << 22;

struct ComponentKind {
    std::int64_t number;  ///< OpenGL's, as glTF has it
    std::size_t size;
    double most;  ///< what a normalized 1 is stored as; 0: never normalized
    const char* name;
};
constexpr ComponentKind kComponents[] = {{5120, 1, 127, "byte"},       {5121, 1, 255, "unsigned byte"},
                                         {5122, 2, 32767, "short"},    {5123, 2, 65535, "unsigned short"},
                                         {5125, 4, 0, "unsigned int"}, {5126, 4, 0, "float"}};

const std::vector<std::string> kShapes = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};

const ComponentKind& kind_of(Component component) {
    return kComponents[static_cast<std::size_t>(component)];
}

Component read_component(const Value& value) {
    const std::int64_t number = *value["componentType"].required().integer();
    const auto* const found = std::ranges::find(kComponents, number, &ComponentKind::number);
    if (found == std::end(kComponents))
        value["componentType"].fail("is {}, but must be one of 5120, 5121, 5122, 5123, 5125, 5126", number);
    return static_cast<Component>(found - kComponents);
}

/// Little-endian.
std::uint32_t bits_at(std::string_view bytes, std::size_t offset, std::size_t size = 4) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < size; ++i)
        bits |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[offset + i])) << (8 * i);
    return bits;
}

bool has(const auto& list, const auto& item) {
    return std::ranges::find(list, item) != list.end();
}

std::size_t rows_of(std::string_view shape) {
    return shape == "SCALAR" ? 1 : static_cast<std::size_t>(shape.back() - '0');
}

std::size_t columns_of(std::string_view shape) {
    return shape.starts_with("MAT") ? rows_of(shape) : 1;
}

/// A matrix's columns begin at multiples of four bytes (glTF 2.0 specification, 3.6.2.4).
std::size_t element_size(std::string_view shape, Component component) {
    const std::size_t column = rows_of(shape) * kind_of(component).size;
    return columns_of(shape) == 1 ? column : columns_of(shape) * ((column + 3) / 4 * 4);
}

/// RFC 4648, also its URL alphabet; `uri` is where the text stands.
std::string decode_base64(std::string_view text, const Value& uri) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/-_";
    while (text.ends_with('=')) text.remove_suffix(1);
    std::string bytes;
    std::uint32_t pending = 0;
    int bits = 0;
    for (const char digit : text) {
        const std::size_t value = digits.find(digit);
        if (value == std::string_view::npos)
            uri.fail("is a data URI whose base64 holds a character that is none of its digits");
        pending = pending << 6 | static_cast<std::uint32_t>(value < 64 ? value : value - 2);
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        bytes += static_cast<char>(pending >> bits & 0xFF);
    }
    return bytes;
}

/// A URI's path with %20 and the like decoded.
std::string decode_percent(std::string_view uri) {
    std::string path;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        unsigned character = 0;
        const char* const digits = uri.data() + i + 1;
        const bool is_escape = uri[i] == '%' && i + 2 < uri.size() &&
                               std::from_chars(digits, digits + 2, character, 16).ptr == digits + 2;
        path += is_escape ? static_cast<char>(character) : uri[i];
        if (is_escape) i += 2;
    }
    return path;
}

}  // namespace

Container open_container(std::string_view content) {
    constexpr std::size_t header_size = 12;
    constexpr std::size_t chunk_header_size = 8;
    constexpr std::uint32_t json_chunk = 0x4E4F534A;
    constexpr std::uint32_t binary_chunk = 0x004E4942;
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    const Value container{nullptr, "this container"};
    if (content.starts_with(byte_order_mark)) content.remove_prefix(byte_order_mark.size());
    if (!content.starts_with("glTF")) return {content, std::nullopt};
    if (content.size() < header_size) container.fail("is cut short: it has no whole header");
    if (const std::uint32_t version = bits_at(content, 4); version != 2)
        container.fail("has version {}, but only version 2 is read", version);
    const std::size_t length = bits_at(content, 8);
    if (length < header_size)
        container.fail("says in its header that it has {} bytes, but the header alone has {}", length,
                       header_size);
    if (length > content.size())
        container.fail("is cut short: its header says {} bytes, but there are {}", length, content.size());
    Container parts;
    for (std::size_t at = header_size; parts.json.data() == nullptr || at < length;) {
        if (length - at < chunk_header_size)
            container.fail("is cut short: the chunk at byte {} has no header", at);
        const std::size_t size = bits_at(content, at);
        const std::uint32_t type = bits_at(content, at + 4);
        at += chunk_header_size;
        if (size > length - at)
            container.fail("is cut short: the chunk at byte {} should have {} bytes, but only {} follow",
                           at - chunk_header_size, size, length - at);
        if (parts.json.data() == nullptr && type != json_chunk)
            container.fail("does not begin with a chunk of JSON");
        if (parts.json.data() == nullptr)
            parts.json = content.substr(at, size);
        else if (type == binary_chunk && !parts.binary)
            parts.binary = content.substr(at, size);
        at += size;
    }
    return parts;
}

std::string read_uri(const FileSystem& disk, const Value& uri, Scene& scene) {
    std::string text;
    uri.read(text);
    if (text.starts_with("data:")) {
        const auto comma = text.find(',');
        if (comma == std::string::npos || !text.substr(0, comma).ends_with(";base64"))
            uri.fail("is a data URI that is not in base64");
        return decode_base64(std::string_view(text).substr(comma + 1), uri);
    }
    const auto colon = text.find(':');
    const bool has_scheme = colon != std::string::npos && text.find('/') > colon;  // RFC 3986: `https:`
    if (has_scheme || text.starts_with('/'))
        uri.fail_with("buffers and pictures are data URIs or paths relative to the file", "is '{}'", text);
    const std::string name = decode_percent(text);
    if (name.find('\0') != std::string::npos)
        uri.fail_with("name a file beside it, or put its content into a data URI", "holds a NUL byte");
    const std::string path = scene.path.substr(0, scene.path.rfind('/') + 1) + name;
    Result<std::string> content = disk.read(path);
    if (!content) {
        content.error().front().help = fmt::format("{} of {} names it", uri.path, scene.path);
        throw std::move(content.error());
    }
    scene.files.push_back(path);
    return std::move(*content);
}

std::vector<std::string> read_buffers(const FileSystem& disk, const Value& root,
                                      std::optional<std::string_view> binary, Scene& scene) {
    std::vector<std::string> buffers;
    for (const Value& value : root["buffers"].objects()) {
        const std::size_t length = value["byteLength"].count();
        const Value uri = value["uri"];
        if (!uri && (!buffers.empty() || !binary))
            value.fail("has no uri, and the file holds no binary chunk for it");
        std::string& content = buffers.emplace_back(uri ? read_uri(disk, uri, scene) : std::string(*binary));
        if (content.size() < length)
            value.fail("holds {} bytes, but its byteLength is {}", content.size(), length);
        content.resize(length);
    }
    return buffers;
}

double Accessors::Array::at(std::size_t element, std::size_t part) const {
    const ComponentKind& kind = kind_of(component);
    const std::uint32_t bits = bits_at(bytes, element * stride + part * kind.size, kind.size);
    if (component == Component::float32) return std::bit_cast<float>(bits);
    double value = bits;
    if (component == Component::int8) value = static_cast<std::int8_t>(bits);
    if (component == Component::int16) value = static_cast<std::int16_t>(bits);
    return normalized && kind.most > 0 ? std::max(value / kind.most, -1.0) : value;
}

Accessors::Accessors(const Value& root, const std::vector<std::string>& buffers) {
    for (const Value& value : root["bufferViews"].objects()) {
        const std::size_t buffer = *value["buffer"].required().index(buffers.size(), "buffers");
        const std::int64_t offset = value["byteOffset"].integer().value_or(0);
        const std::int64_t length = *value["byteLength"].required().integer();
        const auto stride = value["byteStride"].integer();
        const std::string_view content = buffers[buffer];
        const auto available = static_cast<std::int64_t>(content.size());
        if (offset < 0 || length < 1 || offset > available || length > available - offset)
            value.fail("spans {} bytes from byte {}, but buffers[{}] holds {} bytes", length, offset, buffer,
                       available);
        if (stride && (*stride < 4 || *stride > 252 || *stride % 4 != 0))
            value["byteStride"].fail("is {}, but must be a multiple of 4 from 4 to 252", *stride);
        views_.push_back({content.substr(static_cast<std::size_t>(offset), static_cast<std::size_t>(length)),
                          static_cast<std::size_t>(stride.value_or(0))});
    }
    for (const Value& value : root["accessors"].objects()) accessors_.push_back(read_accessor(value));
}

Accessors::Accessor Accessors::read_accessor(const Value& value) const {
    Accessor accessor;
    accessor.value = value;
    accessor.numbers.component = read_component(value);
    accessor.shape = kShapes[value["type"].choice(kShapes)];
    accessor.count = value["count"].count();
    value["normalized"].read(accessor.numbers.normalized);
    const Value sparse = value["sparse"].object();
    accessor.sparse_numbers = accessor.numbers;
    read_array(value, accessor.shape, accessor.count, accessor.numbers);
    if (!sparse) return accessor;
    const Value indices = sparse["indices"].object();
    const Value values = sparse["values"].object();
    const std::int64_t sparse_count = *sparse["count"].required().integer();
    if (!indices || !values) sparse.fail("needs both indices and values");
    if (sparse_count < 1 || static_cast<std::size_t>(sparse_count) > accessor.count)
        sparse["count"].fail("is {}, but must be from 1 to {}", sparse_count, accessor.count);
    accessor.sparse_count = static_cast<std::size_t>(sparse_count);
    accessor.sparse_indices.component = read_component(indices);
    read_array(indices, kShapes[0], accessor.sparse_count, accessor.sparse_indices);
    read_array(values, accessor.shape, accessor.sparse_count, accessor.sparse_numbers);
    if (accessor.sparse_indices.stride == 0 || accessor.sparse_numbers.stride == 0)
        sparse.fail("names no buffer view");
    return accessor;
}

/// The bytes of `count` elements in the buffer view that `value` names, if any, checked to lie within it.
void Accessors::read_array(const Value& value, std::string_view shape, std::size_t count,
                           Array& array) const {
    const auto index = value["bufferView"].index(views_.size(), "buffer views");
    const std::int64_t offset = value["byteOffset"].integer().value_or(0);
    if (!index) return;
    const View& view = views_[*index];
    const std::size_t size = element_size(shape, array.component);
    const std::size_t alignment = kind_of(array.component).size;
    const std::size_t available = view.bytes.size();
    const auto start = static_cast<std::size_t>(offset);
    array.stride = view.stride == 0 ? size : view.stride;
    if (offset < 0 || start % alignment != 0)
        value["byteOffset"].fail("is {}, but must be a multiple of {}", offset, alignment);
    if (array.stride < size)
        value.fail("has elements of {} bytes, but bufferViews[{}].byteStride is {}", size, *index,
                   array.stride);
    const bool has_room = start <= available && size <= available - start;
    const std::size_t room = has_room ? (available - start - size) / array.stride + 1 : 0;
    if (count > room)
        value.fail("asks for {} elements, but bufferViews[{}] has room for {}", count, *index, room);
    array.bytes = view.bytes.substr(start);
}

std::optional<std::string_view> Accessors::view(const Value& user) const {
    const auto index = user.index(views_.size(), "buffer views");
    return index ? std::optional(views_[*index].bytes) : std::nullopt;
}

bool Accessors::has_view(const Value& user) const {
    const auto number = user.index(accessors_.size(), "accessors");
    return number && accessors_[*number].numbers.stride != 0;
}

Values Accessors::read(const Value& user, const Wanted& wanted) {
    const auto index = user.index(accessors_.size(), "accessors");
    if (!index) return {};
    const Accessor& accessor = accessors_[*index];
    const Array& numbers = accessor.numbers;
    if (!has(wanted.shapes, accessor.shape) || !has(wanted.components, numbers.component)) {
        std::vector<std::string_view> kinds;
        for (const Component accepted : wanted.components) kinds.emplace_back(kind_of(accepted).name);
        user.fail("names {}, which holds {} of {}, not {} of {}", accessor.value.path, accessor.shape,
                  kind_of(numbers.component).name, fmt::join(wanted.shapes, " or "),
                  fmt::join(kinds, " or "));
    }
    const std::size_t width = columns_of(accessor.shape) * rows_of(accessor.shape);
    const bool has_bytes = numbers.stride > 0;
    if (accessor.count > (kMostComponents - components_read_) / width)
        accessor.value.fail("has {} elements: the scene would hold more than {} numbers", accessor.count,
                            kMostComponents);
    if (!has_bytes && accessor.count > kMostZeros / width)
        accessor.value.fail("has {} elements without a buffer view: more than {} zeros", accessor.count,
                            kMostZeros);
    Values values{width, accessor.count, std::vector<double>(accessor.count * width, 0.0)};
    components_read_ += values.numbers.size();
    for (std::size_t i = 0; has_bytes && i < values.count; ++i)
        for (std::size_t k = 0; k < width; ++k) values.numbers[i * width + k] = numbers.at(i, k);
    double before = -1;
    for (std::size_t i = 0; i < accessor.sparse_count; ++i) {
        const double element = accessor.sparse_indices.at(i, 0);
        if (!(element > before && element < static_cast<double>(values.count)))
            accessor.value.fail("has sparse indices that do not rise from 0 to {}: {} after {}",
                                values.count - 1, element, before);
        before = element;
        for (std::size_t k = 0; k < width; ++k)
            values.numbers[static_cast<std::size_t>(element) * width + k] = accessor.sparse_numbers.at(i, k);
    }
    const auto bad =
        std::ranges::find_if_not(values.numbers, [](double number) { return std::isfinite(number); });
    if (bad != values.numbers.end())
        user.fail("is not finite in element {} of {}",
                  static_cast<std::size_t>(bad - values.numbers.begin()) / width, accessor.value.path);
    return values;
}

Values Attributes::read(std::string_view name, const Wanted& wanted) {
    Values values = accessors.read(attributes[name], wanted);
    if (count == 0) count = values.count;
    if (values.count != 0 && values.count != count)
        attributes[name].fail("has {} elements, but there are {} {}", values.count, count, elements);
    return values;
}

}  // namespace gobo::scene
