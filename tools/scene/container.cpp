#include "scene/container.hpp"

#include <cstdint>

#include <fmt/format.h>

namespace gobo::scene {
namespace {

constexpr std::string_view magic = "glTF";
constexpr std::size_t header_size = 12;
constexpr std::size_t chunk_header_size = 8;
constexpr std::uint32_t json_chunk = 0x4E4F534A;
constexpr std::uint32_t binary_chunk = 0x004E4942;

std::uint32_t word_at(std::string_view content, std::size_t offset) {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 4; ++i)
        word |= static_cast<std::uint32_t>(static_cast<unsigned char>(content[offset + i])) << (8 * i);
    return word;
}

tl::unexpected<Diagnostics> broken(const std::string& path, std::string message, std::string help = {}) {
    Diagnostic diagnostic;
    diagnostic.place.file = path;
    diagnostic.message = std::move(message);
    diagnostic.help = std::move(help);
    return fail(std::move(diagnostic));
}

struct Chunk {
    std::uint32_t type = 0;
    std::string_view content;
};

/// Takes the next chunk off the front of `rest`.
Result<Chunk> next_chunk(std::string_view& rest, std::size_t offset, const std::string& path) {
    if (rest.size() < chunk_header_size) {
        return broken(path,
                      fmt::format("this container is cut short: the chunk at byte {} has no header", offset));
    }
    const std::size_t size = word_at(rest, 0);
    if (size > rest.size() - chunk_header_size) {
        return broken(path,
                      fmt::format("this container is cut short: the chunk at byte {} should have {} bytes, "
                                  "but only {} follow",
                                  offset, size, rest.size() - chunk_header_size));
    }
    const Chunk chunk{word_at(rest, 4), rest.substr(chunk_header_size, size)};
    rest.remove_prefix(chunk_header_size + size);
    return chunk;
}

}  // namespace

Result<Container> open_container(std::string_view content, const std::string& path) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (content.starts_with(byte_order_mark)) content.remove_prefix(byte_order_mark.size());
    if (!content.starts_with(magic)) return Container{content, std::nullopt};
    if (content.size() < header_size)
        return broken(path, "this container is cut short: it has no whole header");
    if (const std::uint32_t version = word_at(content, 4); version != 2) {
        return broken(path,
                      fmt::format("this container has version {}, but only version 2 is read", version));
    }
    const std::size_t length = word_at(content, 8);
    if (length > content.size() || length < header_size) {
        return broken(path,
                      fmt::format("this container is cut short: its header says {} bytes, but there are {}",
                                  length, content.size()));
    }
    std::string_view rest = content.substr(header_size, length - header_size);
    const auto json = next_chunk(rest, header_size, path);
    if (!json) return tl::unexpected(json.error());
    if (json->type != json_chunk) return broken(path, "this container does not begin with a chunk of JSON");
    Container container{json->content, std::nullopt};
    while (!rest.empty()) {
        const auto chunk = next_chunk(rest, length - rest.size(), path);
        if (!chunk) return tl::unexpected(chunk.error());
        if (chunk->type == binary_chunk && !container.binary) container.binary = chunk->content;
    }
    return container;
}

}  // namespace gobo::scene
