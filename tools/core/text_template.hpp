// Templates of generated text: `{{name}}` stands for a value.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "core/diagnostic.hpp"

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

}  // namespace gobo
