// Templates of generated text: `{{name}}` stands for a value.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "common/diagnostic.hpp"
#include "common/file_system.hpp"

namespace gobo {

/// What each placeholder stands for.
using TemplateValues = std::map<std::string, std::string, std::less<>>;

/// A text with placeholders, and the name of the file it comes from.
struct TextTemplate {
    std::string name;
    std::string text;
};

/// `text` with every `{{name}}` replaced by its value. A placeholder that has no value is a fault of gobo's
/// own.
[[nodiscard]] Result<std::string> fill(const TextTemplate& text_template, const TemplateValues& values);

/// The templates of a generated header.
struct HeaderTemplates {
    TextTemplate header;
    TextTemplate structure;  ///< a uniform block, or a struct within one
};

/// Reads them from `folder` (templates/header of the sources, or of the library in the executable).
[[nodiscard]] Result<HeaderTemplates> read_header_templates(const FileSystem& files,
                                                            const std::string& folder);

}  // namespace gobo
