#include "settings.hpp"

#include <array>

namespace viewer {
namespace {

struct Toggle {
    char key;
    const char* name;
    bool Settings::*value;
};

constexpr std::array toggles = {Toggle{'f', "fog", &Settings::fog}, Toggle{'t', "toon", &Settings::toon},
                                Toggle{'1', "directional lights", &Settings::directional},
                                Toggle{'2', "point lights", &Settings::point},
                                Toggle{'3', "spot lights", &Settings::spot}};

/// The next one in the order of the header, which lists the most accurate first.
lit::Shading after(lit::Shading shading) {
    lit::Key key;
    key.shading = static_cast<lit::Shading>(static_cast<int>(shading) + 1);
    return lit::detail::in_range(key) ? key.shading : lit::Shading::fragment;
}

std::string name_of(lit::Shading shading) {
    lit::Key key;
    key.directional = 1;  // without a light the shading rate cannot matter, and its name would be left out
    key.shading = shading;
    const std::string text = lit::key_text(key);
    const std::size_t at = text.find("shading=");
    return at == std::string::npos ? "fragment" : text.substr(at + 8, text.find(' ', at) - at - 8);
}

}  // namespace

std::string press(char key, Settings& settings) {
    for (const Toggle& toggle : toggles) {
        if (toggle.key != key) continue;
        bool& value = settings.*toggle.value;
        value = !value;
        return std::string(toggle.name) + (value ? " on" : " off");
    }
    if (key != 's') return {};
    settings.shading = after(settings.shading);
    return "shading per " + name_of(settings.shading);
}

std::string help_text() {
    std::string text;
    for (const Toggle& toggle : toggles) text += std::string(1, toggle.key) + ": " + toggle.name + "; ";
    return text + "s: shading rate; left and right: orbit; escape: quit";
}

}  // namespace viewer
