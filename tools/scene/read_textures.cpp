#include "scene/read_textures.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <lodepng.h>

namespace gobo::scene {
namespace {

/// As many numbers as all accessors together may hold: a picture of 8192 by 8192.
constexpr std::size_t most_texels = 67'108'864;
constexpr int repeated = 10497;  ///< GL_REPEAT, which is glTF's default

bool is_png(std::string_view bytes) {
    return bytes.starts_with("\x89PNG\r\n\x1a\n");
}

/// JPEG has no alpha.
bool is_jpeg(std::string_view bytes) {
    return bytes.starts_with("\xff\xd8\xff");
}

/// An error's text, or the alpha; nothing where all of it is opaque.
std::string decode(std::string_view bytes, std::optional<AlphaMap>& map) {
    const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
    unsigned width = 0;
    unsigned height = 0;
    lodepng::State state;
    unsigned error = lodepng_inspect(&width, &height, &state, data, bytes.size());
    if (error == 0 && std::size_t{width} * height > most_texels)
        return fmt::format("is of {} x {} pixels, which is more than gobo decodes", width, height);
    std::vector<unsigned char> pixels;
    if (error == 0) error = lodepng::decode(pixels, width, height, data, bytes.size());
    if (error != 0) return fmt::format("is no PNG that can be decoded: {}", lodepng_error_text(error));
    map = AlphaMap{static_cast<int>(width), static_cast<int>(height), {}};
    for (std::size_t i = 3; i < pixels.size(); i += 4) map->texels.push_back(pixels[i]);
    const auto is_opaque = [](std::uint8_t alpha) { return alpha == 255; };
    if (std::all_of(map->texels.begin(), map->texels.end(), is_opaque)) map.reset();
    return {};
}

}  // namespace

Textures::Textures(Document& document, Accessors& accessors, const FileSystem& files)
    : document_(document),
      accessors_(accessors),
      disk_(files),
      textures_(document.objects(document.root(), "textures")),
      images_(document.objects(document.root(), "images")) {
    for (const Value& texture : textures_)
        static_cast<void>(document_.index(texture, "source", images_.size(), "images"));
}

bool Textures::is_named(const Value& material, std::string_view member) {
    const auto info = document_.object(material, member);
    if (!info) return false;
    static_cast<void>(document_.required_index(*info, "index", textures_.size(), "textures"));
    return true;
}

std::optional<AlphaMap> Textures::alpha(const Value& material, std::string_view member) {
    if (!is_named(material, member) || document_.failed()) return std::nullopt;
    const Value info = *document_.object(material, member);
    const int number = document_.required_index(info, "index", textures_.size(), "textures");
    const Value& texture = textures_[static_cast<std::size_t>(number)];
    const auto source = document_.index(texture, "source", images_.size(), "images");
    if (!source || !is_plain(info, texture)) return AlphaMap();
    const Value& image = images_[static_cast<std::size_t>(*source)];
    const auto bytes = bytes_of(image);
    if (!bytes || is_jpeg(*bytes)) return std::nullopt;
    if (!is_png(*bytes)) return AlphaMap();
    std::optional<AlphaMap> map;
    if (const std::string why = decode(*bytes, map); !why.empty()) document_.error(image.path, why);
    return map;
}

bool Textures::is_plain(const Value& info, const Value& texture) {
    if (document_.integer(info, "texCoord").value_or(0) != 0) return false;
    if (const auto extensions = document_.object(info, "extensions"))
        if (document_.object(*extensions, "KHR_texture_transform")) return false;
    const auto samplers = document_.objects(document_.root(), "samplers");
    const auto sampler = document_.index(texture, "sampler", samplers.size(), "samplers");
    if (!sampler) return true;
    const Value& how = samplers[static_cast<std::size_t>(*sampler)];
    return document_.integer(how, "wrapS").value_or(repeated) == repeated &&
           document_.integer(how, "wrapT").value_or(repeated) == repeated;
}

std::optional<std::string> Textures::bytes_of(const Value& image) {
    if (const auto view = accessors_.view(image, "bufferView")) return std::string(*view);
    const auto uri = document_.string(image, "uri");
    if (!uri) {
        document_.error(image.path, "has neither uri nor bufferView");
        return std::nullopt;
    }
    return read_uri(disk_, document_, image, *uri, read_);
}

}  // namespace gobo::scene
