#include <algorithm>
#include <array>
#include <cctype>

#include "lab/render/source.hpp"

namespace gobo {
namespace {

struct Spelling {
    std::string_view name;  ///< in lower case, without prefix, underscores and "matrix"
    std::string_view source;
};

constexpr auto uniform_spellings = std::to_array<Spelling>({
    {"model", "model"},
    {"modeltoworld", "model"},
    {"world", "model"},
    {"objecttoworld", "model"},
    {"view", "view"},
    {"worldtoview", "view"},
    {"worldtoeye", "view"},
    {"projection", "projection"},
    {"proj", "projection"},
    {"viewtoclip", "projection"},
    {"modelview", "model_view"},
    {"mv", "model_view"},
    {"worldview", "model_view"},
    {"viewprojection", "view_projection"},
    {"viewproj", "view_projection"},
    {"vp", "view_projection"},
    {"worldtoclip", "view_projection"},
    {"modelviewprojection", "model_view_projection"},
    {"modelviewproj", "model_view_projection"},
    {"mvp", "model_view_projection"},
    {"worldviewprojection", "model_view_projection"},
    {"wvp", "model_view_projection"},
    {"normal", "normal_matrix"},
    {"normals", "normal_matrix"},
    {"modelviewinversetranspose", "normal_matrix"},
    {"inverseview", "inverse_view"},
    {"viewinverse", "inverse_view"},
    {"cameraposition", "camera_position"},
    {"camerapos", "camera_position"},
    {"campos", "camera_position"},
    {"eyeposition", "camera_position"},
    {"eyepos", "camera_position"},
    {"viewposition", "camera_position"},
    {"viewpos", "camera_position"},
    {"viewport", "viewport"},
    {"viewportsize", "viewport"},
    {"resolution", "viewport"},
});

constexpr auto attribute_spellings = std::to_array<Spelling>({
    {"position", "position"},
    {"pos", "position"},
    {"vertex", "position"},
    {"vertexposition", "position"},
    {"normal", "normal"},
    {"vertexnormal", "normal"},
    {"texcoord", "texcoord"},
    {"texcoords", "texcoord"},
    {"texcoord0", "texcoord"},
    {"texturecoordinate", "texcoord"},
    {"texturecoord", "texcoord"},
    {"textureuv", "texcoord"},
    {"uv", "texcoord"},
    {"uv0", "texcoord"},
    {"color", "color"},
    {"colour", "color"},
    {"color0", "color"},
    {"vertexcolor", "color"},
});

bool is_upper(char character) {
    return std::isupper(static_cast<unsigned char>(character)) != 0;
}

/// Takes off `u_`, `in_` and the like, and a lower-case letter or "in" before a capital.
std::string_view without_prefix(std::string_view name) {
    for (const std::string_view prefix : {"in", "attr", "u", "a", "v", "i", "m", "g", "vs"}) {
        if (!name.starts_with(prefix) || name.size() <= prefix.size()) continue;
        const char next = name[prefix.size()];
        if (next == '_') return name.substr(prefix.size() + 1);
        if (is_upper(next)) return name.substr(prefix.size());
    }
    return name;
}

std::string plain_spelling(std::string_view name) {
    const std::size_t dot = name.rfind('.');
    if (dot != std::string_view::npos) name.remove_prefix(dot + 1);
    std::string plain;
    for (const char character : without_prefix(name))
        if (character != '_') plain += static_cast<char>(std::tolower(static_cast<unsigned char>(character)));
    for (const std::string_view ending : {"matrix", "mat"})
        if (plain.ends_with(ending) && plain.size() > ending.size())
            plain.erase(plain.size() - ending.size());
    return plain;
}

template <std::size_t size>
std::string_view look_up(const std::array<Spelling, size>& spellings, std::string_view name) {
    const std::string plain = plain_spelling(name);
    const auto found = std::find_if(spellings.begin(), spellings.end(),
                                    [&](const Spelling& spelling) { return spelling.name == plain; });
    return found == spellings.end() ? std::string_view() : found->source;
}

}  // namespace

std::string_view uniform_source_of(std::string_view name) {
    return look_up(uniform_spellings, name);
}

std::string_view attribute_source_of(std::string_view name) {
    return look_up(attribute_spellings, name);
}

const std::vector<std::string>& uniform_sources() {
    static const std::vector<std::string> sources = {"model",
                                                     "view",
                                                     "projection",
                                                     "model_view",
                                                     "view_projection",
                                                     "model_view_projection",
                                                     "inverse_view",
                                                     "normal_matrix",
                                                     "world_normal_matrix",
                                                     "camera_position",
                                                     "eye_point",
                                                     "eye_direction",
                                                     "viewport"};
    return sources;
}

const std::vector<std::string>& attribute_sources() {
    static const std::vector<std::string> sources = {"position", "normal",          "texcoord", "color",
                                                     "tint",     "material_number", "tile"};
    return sources;
}

const std::vector<std::string>& texture_sources() {
    static const std::vector<std::string> sources = {"texture_checker", "texture_white", "texture_ramp",
                                                     "texture_normal", "texture_lattice"};
    return sources;
}

}  // namespace gobo
