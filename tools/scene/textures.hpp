// The textures of a document, and the pictures that they show.
#pragma once

#include "scene/accessor.hpp"
#include "scene/picture.hpp"

namespace gobo::scene {

/// Throws Diagnostics, as all reading does.
struct Textures {
    Textures(const Value& root, const Accessors& accessors, const FileSystem& disk, Scene& scene);

    /// Checks that the texture that a material names exists. Whether it names one.
    [[nodiscard]] bool is_named(const Value& info) const;

    /// The alpha of the picture that a material names; nothing where it names none, or it has none. The map
    /// is empty where its alpha is not known: it is neither PNG nor JPEG, or is not laid out plainly.
    [[nodiscard]] std::optional<AlphaMap> alpha(const Value& info) const;

    /// The texture that a material names, its picture decoded, once, into the scene; nothing where it names
    /// none, or one without a picture that gobo reads.
    [[nodiscard]] std::optional<TextureUse> use(const Value& info);

    /// Of a texture without a picture that gobo reads: "by KHR_texture_basisu alone".
    [[nodiscard]] std::string why_unused(const Value& info) const;

  private:
    [[nodiscard]] bool is_plain(const Value& info, const Value& texture) const;
    [[nodiscard]] std::string bytes_of(const Value& image) const;

    Value root_;
    const Accessors& accessors_;
    const FileSystem& disk_;
    Scene& scene_;
    std::vector<Value> textures_;
    std::vector<Value> images_;
    std::vector<std::optional<std::size_t>> pictures_;  ///< of each image, where it is decoded
};

/// The metallic-roughness material in its own terms: docs/scene_format.md, "Physically based materials".
[[nodiscard]] PhysicalMaterial read_physical(const Value& value, Textures& textures);

}  // namespace gobo::scene
