#include "validate/glsl_version.hpp"

#include <charconv>

#include "common/text.hpp"

namespace gobo {

GlslVersion version_of(std::string_view prologue) {
    GlslVersion version;
    constexpr std::string_view directive = "#version ";
    if (!prologue.starts_with(directive)) return version;
    const std::string_view line =
        trim(prologue.substr(directive.size(), prologue.find('\n') - directive.size()));
    const auto parsed = std::from_chars(line.data(), line.data() + line.size(), version.number);
    version.profile = trim(line.substr(static_cast<std::size_t>(parsed.ptr - line.data())));
    version.es = version.profile == "es" || version.number == 100;
    return version;
}

bool makes_spirv(const GlslVersion& version) {
    return version.number >= (version.es ? 310 : 330) && version.profile != "compatibility";
}

std::string raised_for_spirv(std::string_view prologue) {
    const GlslVersion version = version_of(prologue);
    const auto end = prologue.find('\n');
    const std::string_view rest =
        prologue.starts_with("#version") && end != std::string_view::npos ? prologue.substr(end) : "\n";
    return (version.es ? "#version 310 es" : "#version 330 core") + std::string(rest);
}

}  // namespace gobo
