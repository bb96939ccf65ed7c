#include "core/text_template.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/text.hpp"

namespace gobo {
namespace {

constexpr std::string_view opening = "{{";
constexpr std::string_view closing = "}}";

tl::unexpected<Diagnostics> fail_at(const TextTemplate& text_template, std::size_t position,
                                    std::string message) {
    const std::string_view before = std::string_view(text_template.text).substr(0, position);
    Diagnostic diagnostic;
    diagnostic.fault = Fault::internal;
    diagnostic.place.file = text_template.name;
    diagnostic.place.line = 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n'));
    diagnostic.message = std::move(message);
    diagnostic.quoted_line = line_of(text_template.text, diagnostic.place.line);
    return fail(std::move(diagnostic));
}

}  // namespace

Result<std::string> fill(const TextTemplate& text_template, const TemplateValues& values) {
    const std::string_view text = text_template.text;
    std::string result;
    std::size_t position = 0;
    for (auto found = text.find(opening); found != std::string_view::npos;
         found = text.find(opening, position)) {
        result += text.substr(position, found - position);
        const auto end = text.find(closing, found);
        if (end == std::string_view::npos) return fail_at(text_template, found, "a placeholder has no end");
        const std::string_view name = text.substr(found + opening.size(), end - found - opening.size());
        const auto value = values.find(name);
        if (value == values.end()) {
            return fail_at(text_template, found, fmt::format("the placeholder '{}' has no value", name));
        }
        result += value->second;
        position = end + closing.size();
    }
    result += text.substr(position);
    return result;
}

}  // namespace gobo
