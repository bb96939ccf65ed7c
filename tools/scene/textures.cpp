#include "scene/textures.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/ranges.h>

namespace gobo::scene {
namespace {

constexpr int kRepeat = 10497;  ///< GL_REPEAT, which is glTF's default
constexpr int kNearest = 9728;  ///< GL_NEAREST

void check_choice(const Value& value, const std::vector<std::int64_t>& known) {
    const auto number = value.integer();
    if (number && std::ranges::find(known, *number) == known.end())
        value.fail("is {}, but must be one of {}", *number, fmt::join(known, ", "));
}

/// glTF 2.0, 5.26: OpenGL's numbers.
void check_sampler(const Value& sampler) {
    check_choice(sampler["magFilter"], {9728, 9729});
    check_choice(sampler["minFilter"], {9728, 9729, 9984, 9985, 9986, 9987});
    for (const char* wrap : {"wrapS", "wrapT"}) check_choice(sampler[wrap], {kRepeat, 33071, 33648});
}

/// The number of a set of texture coordinates.
std::int64_t set_of(const Value& number) {
    const std::int64_t set = number.integer().value_or(0);
    if (set < 0) number.fail("is {}, but must be at least 0", set);
    return set;
}

}  // namespace

Textures::Textures(const Value& root, const Accessors& accessors, const FileSystem& disk, Scene& scene)
    : root_(root),
      accessors_(accessors),
      disk_(disk),
      scene_(scene),
      textures_(root["textures"].objects()),
      images_(root["images"].objects()),
      pictures_(images_.size()) {
    for (const Value& sampler : root["samplers"].objects()) check_sampler(sampler);
    for (const Value& texture : textures_)
        static_cast<void>(texture["source"].index(images_.size(), "images"));
}

bool Textures::is_named(const Value& info) const {
    return info && info["index"].required().index(textures_.size(), "textures");
}

/// Whether it is laid out plainly: by TEXCOORD_0, repeated, without a transform.
bool Textures::is_plain(const Value& info, const Value& texture) const {
    if (info["texCoord"].integer().value_or(0) != 0) return false;
    if (info["extensions"]["KHR_texture_transform"].object()) return false;
    const std::vector<Value> samplers = root_["samplers"].objects();
    const auto sampler = texture["sampler"].index(samplers.size(), "samplers");
    return !sampler || (samplers[*sampler]["wrapS"].integer().value_or(kRepeat) == kRepeat &&
                        samplers[*sampler]["wrapT"].integer().value_or(kRepeat) == kRepeat);
}

std::string Textures::bytes_of(const Value& image) const {
    if (image["bufferView"] && image["uri"]) image.fail_with("leave one out", "has both uri and bufferView");
    if (const auto view = accessors_.view(image["bufferView"])) return std::string(*view);
    if (const Value uri = image["uri"]) return read_uri(disk_, uri, scene_);
    image.fail("has neither uri nor bufferView");
}

std::optional<AlphaMap> Textures::alpha(const Value& info) const {
    const auto number = info["index"].index(textures_.size(), "textures");
    if (!number) return std::nullopt;
    const auto source = textures_[*number]["source"].index(images_.size(), "images");
    if (!source || !is_plain(info, textures_[*number])) return AlphaMap();
    const std::string bytes = bytes_of(images_[*source]);
    const PictureFormat format = format_of_picture(bytes);
    if (format == PictureFormat::jpeg) return std::nullopt;  // it has no alpha
    if (format == PictureFormat::unknown) return AlphaMap();
    const auto picture = decode_picture(bytes);
    if (!picture) images_[*source].fail_with(picture.error().help, "{}", picture.error().message);
    AlphaMap map{picture->width, picture->height, {}};
    for (std::size_t i = 3; i < picture->texels.size(); i += 4) map.texels.push_back(picture->texels[i]);
    const auto is_opaque = [](std::uint8_t alpha) { return alpha == 255; };
    return std::ranges::all_of(map.texels, is_opaque) ? std::nullopt : std::optional(std::move(map));
}

std::string Textures::why_unused(const Value& info) const {
    const Value extensions =
        textures_[*info["index"].index(textures_.size(), "textures")]["extensions"].object();
    if (!extensions || extensions.json->empty()) return "without source";
    return fmt::format("by {} alone", extensions.json->begin().key());
}

std::optional<TextureUse> Textures::use(const Value& info) {
    if (!is_named(info)) return std::nullopt;
    const Value& texture = textures_[*info["index"].index(textures_.size(), "textures")];
    const auto source = texture["source"].index(images_.size(), "images");
    if (!source) return std::nullopt;  // an extension's format
    if (!pictures_[*source]) {
        auto picture = decode_picture(bytes_of(images_[*source]));
        if (!picture) images_[*source].fail_with(picture.error().help, "{}", picture.error().message);
        pictures_[*source] = scene_.pictures.size();
        scene_.pictures.push_back(std::move(*picture));
    }
    TextureUse use;
    use.picture = *pictures_[*source];
    use.set = set_of(info["texCoord"]);
    const std::vector<Value> samplers = root_["samplers"].objects();
    if (const auto sampler = texture["sampler"].index(samplers.size(), "samplers")) {
        use.wrap_s = static_cast<int>(samplers[*sampler]["wrapS"].integer().value_or(kRepeat));
        use.wrap_t = static_cast<int>(samplers[*sampler]["wrapT"].integer().value_or(kRepeat));
        use.is_nearest = samplers[*sampler]["magFilter"].integer().value_or(0) == kNearest;
        use.min_filter = static_cast<int>(samplers[*sampler]["minFilter"].integer().value_or(use.min_filter));
    }
    // uv' = offset + R(-rotation) (scale uv), as the extension's page has it: v runs down.
    const Value transform = info["extensions"]["KHR_texture_transform"].object();
    double rotation = 0;
    glm::dvec2 scale(1);
    transform["offset"].read_numbers(&use.offset.x, 2);
    transform["scale"].read_numbers(&scale.x, 2);
    transform["rotation"].read(rotation);
    if (transform["texCoord"]) use.set = set_of(transform["texCoord"]);
    const double cosine = std::cos(rotation);
    const double sine = std::sin(rotation);
    use.linear = {cosine * scale.x, sine * scale.y, -sine * scale.x, cosine * scale.y};
    return use;
}

}  // namespace gobo::scene
