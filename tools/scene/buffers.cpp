#include "scene/buffers.hpp"

#include <cstdint>

#include <fmt/format.h>

namespace gobo::scene {
namespace {

/// The value of a base64 digit (RFC 4648, also its URL alphabet), or -1.
int digit_value(char digit) {
    if (digit >= 'A' && digit <= 'Z') return digit - 'A';
    if (digit >= 'a' && digit <= 'z') return digit - 'a' + 26;
    if (digit >= '0' && digit <= '9') return digit - '0' + 52;
    if (digit == '+' || digit == '-') return 62;
    if (digit == '/' || digit == '_') return 63;
    return -1;
}

std::optional<std::string> decode_base64(std::string_view text) {
    while (text.ends_with('=')) text.remove_suffix(1);
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t pending = 0;
    int bits = 0;
    for (const char digit : text) {
        const int value = digit_value(digit);
        if (value < 0) return std::nullopt;
        pending = (pending << 6 | static_cast<std::uint32_t>(value)) & 0xFFFFFF;
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        bytes += static_cast<char>(pending >> bits & 0xFF);
    }
    return bytes;
}

int hexadecimal_value(char digit) {
    if (digit >= '0' && digit <= '9') return digit - '0';
    if (digit >= 'a' && digit <= 'f') return digit - 'a' + 10;
    if (digit >= 'A' && digit <= 'F') return digit - 'A' + 10;
    return -1;
}

/// A URI's path with %20 and the like decoded.
std::string decode_percent(std::string_view uri) {
    std::string path;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool is_escape = uri[i] == '%' && i + 2 < uri.size() && hexadecimal_value(uri[i + 1]) >= 0 &&
                               hexadecimal_value(uri[i + 2]) >= 0;
        if (!is_escape) {
            path += uri[i];
            continue;
        }
        path += static_cast<char>(hexadecimal_value(uri[i + 1]) * 16 + hexadecimal_value(uri[i + 2]));
        i += 2;
    }
    return path;
}

/// Whether a URI begins with a scheme (RFC 3986): `https:`, `file:`.
bool has_scheme(std::string_view uri) {
    const auto colon = uri.find(':');
    return colon != std::string_view::npos && uri.find('/') > colon;
}

std::string folder_of(const std::string& path) {
    const auto slash = path.rfind('/');
    return slash == std::string::npos ? "" : path.substr(0, slash + 1);
}

std::string decode_data_uri(Document& document, const Value& buffer, std::string_view uri) {
    const auto comma = uri.find(',');
    const std::string place = path_to(buffer, "uri");
    if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64")) {
        document.error(place, "is a data URI that is not in base64");
        return {};
    }
    auto bytes = decode_base64(uri.substr(comma + 1));
    if (!bytes)
        document.error(place, "is a data URI whose base64 holds a character that is none of its digits");
    return bytes.value_or("");
}

std::string read_file(const FileSystem& files, Document& document, const Value& buffer, std::string_view uri,
                      std::vector<std::string>& read) {
    const std::string place = path_to(buffer, "uri");
    if (has_scheme(uri) || uri.starts_with('/')) {
        document.error(place, fmt::format("is '{}'", uri),
                       "buffers and pictures are data URIs or paths relative to the file");
        return {};
    }
    const std::string path = folder_of(document.path()) + decode_percent(uri);
    Result<std::string> content = files.read(path);
    if (!content) {
        content.error().front().help = fmt::format("{} of {} names it", place, document.path());
        document.take(std::move(content.error()));
        return {};
    }
    read.push_back(path);
    return std::move(*content);
}

std::string read_buffer(const FileSystem& files, Document& document, const Value& buffer, bool is_first,
                        std::optional<std::string_view> binary, Buffers& buffers) {
    const auto uri = document.string(buffer, "uri");
    if (uri) return read_uri(files, document, buffer, *uri, buffers.files);
    if (is_first && binary) return std::string(*binary);
    document.error(buffer.path, "has no uri, and the file holds no binary chunk for it");
    return {};
}

}  // namespace

std::string read_uri(const FileSystem& files, Document& document, const Value& user, std::string_view uri,
                     std::vector<std::string>& read) {
    return uri.starts_with("data:") ? decode_data_uri(document, user, uri)
                                    : read_file(files, document, user, uri, read);
}

Buffers read_buffers(const FileSystem& files, Document& document, std::optional<std::string_view> binary) {
    Buffers buffers;
    for (const Value& buffer : document.objects(document.root(), "buffers")) {
        const std::int64_t length = document.required_integer(buffer, "byteLength");
        if (length < 1)
            document.error(path_to(buffer, "byteLength"),
                           fmt::format("is {}, but must be at least 1", length));
        if (document.failed()) return buffers;
        std::string content = read_buffer(files, document, buffer, buffers.contents.empty(), binary, buffers);
        if (!document.failed() && content.size() < static_cast<std::uint64_t>(length)) {
            document.error(buffer.path,
                           fmt::format("holds {} bytes, but its byteLength is {}", content.size(), length));
        }
        if (document.failed()) return buffers;
        content.resize(static_cast<std::size_t>(length));
        buffers.contents.push_back(std::move(content));
    }
    return buffers;
}

}  // namespace gobo::scene
