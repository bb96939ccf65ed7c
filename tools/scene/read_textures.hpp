// Pictures, as far as they decide what is called for: the alpha of what is cut by it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/accessor.hpp"
#include "scene/scene.hpp"

namespace gobo::scene {

/// The textures of a document.
class Textures {
  public:
    /// Checks that every texture's picture exists. All that is given must live as long as this.
    Textures(Document& document, Accessors& accessors, const FileSystem& files);

    /// Checks that the texture named by a material's member exists. Whether there is such a member.
    bool is_named(const Value& material, std::string_view member);

    /// The alpha of the picture that the member names; nothing where the picture has none. The map is empty
    /// where its alpha is not known: it is neither PNG nor JPEG, or is not laid out plainly (by TEXCOORD_0,
    /// repeated, without a transform). A picture that cannot be decoded is an error of the document.
    [[nodiscard]] std::optional<AlphaMap> alpha(const Value& material, std::string_view member);

    /// The files that were read.
    [[nodiscard]] const std::vector<std::string>& files() const { return read_; }

  private:
    [[nodiscard]] bool is_plain(const Value& info, const Value& texture);
    [[nodiscard]] std::optional<std::string> bytes_of(const Value& image);

    Document& document_;
    Accessors& accessors_;
    const FileSystem& disk_;
    std::vector<Value> textures_;
    std::vector<Value> images_;
    std::vector<std::string> read_;
};

}  // namespace gobo::scene
