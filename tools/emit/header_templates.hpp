// The templates of a generated header.
#pragma once

#include <string>

#include "core/file_system.hpp"
#include "core/text_template.hpp"

namespace gobo {

/// The templates of a generated header.
struct HeaderTemplates {
    TextTemplate header;
    TextTemplate structure;  ///< a uniform block, or a struct within one
};

/// Reads them from `folder` (templates/header of the sources, or of the library in the executable).
[[nodiscard]] Result<HeaderTemplates> read_header_templates(const FileSystem& files,
                                                            const std::string& folder);

}  // namespace gobo
