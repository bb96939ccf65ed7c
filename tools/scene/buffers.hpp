// The buffers of a glTF file, wherever they lie: in the container, in the JSON, in files beside it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/file_system.hpp"
#include "scene/document.hpp"

namespace gobo::scene {

struct Buffers {
    std::vector<std::string> contents;  ///< one per buffer of the file, of exactly its byteLength
    std::vector<std::string> files;     ///< those that were read
};

/// What a URI names: data in base64, or a file beside the document, which is added to `read`. Anything wrong
/// is an error of the document about the member `uri` of `user`.
[[nodiscard]] std::string read_uri(const FileSystem& files, Document& document, const Value& user,
                                   std::string_view uri, std::vector<std::string>& read);

/// Reads every buffer. Paths are relative to the folder of the document. An unreadable file is Fault::file;
/// anything else that is wrong becomes an error of the document.
[[nodiscard]] Buffers read_buffers(const FileSystem& files, Document& document,
                                   std::optional<std::string_view> binary);

}  // namespace gobo::scene
