#include "core/text_template.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace gobo {
namespace {

constexpr std::string_view opening = "{{";
constexpr std::string_view closing = "}}";

tl::unexpected<Diagnostics> fail_at(const TextTemplate& text_template, std::size_t position,
                                    std::string message) {
    const std::string& text = text_template.text;
    const auto before = text.begin() + static_cast<std::ptrdiff_t>(position);
    const int line = 1 + static_cast<int>(std::count(text.begin(), before, '\n'));
    return fail({.fault = Fault::internal,
                 .place = {text_template.name, line},
                 .message = std::move(message),
                 .quoted_line = std::string(line_of(text, line))});
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
        if (value == values.end())
            return fail_at(text_template, found, fmt::format("the placeholder '{}' has no value", name));
        result += value->second;
        position = end + closing.size();
    }
    result += text.substr(position);
    return result;
}

}  // namespace gobo
