#include "lab/render/texture.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include <fmt/format.h>
#include <gobo/environment_brdf.hpp>

#include "core/text.hpp"

namespace gobo {
namespace {

constexpr int kSide = 64;
using Texel = std::array<float, 4>;

struct SamplerTarget {
    std::string_view sampler_type;
    GLenum target;
    bool is_shadow;
};
constexpr auto kTargets = std::to_array<SamplerTarget>({
    {"sampler2D", GL_TEXTURE_2D, false},
    {"sampler2DArray", GL_TEXTURE_2D_ARRAY, false},
    {"sampler3D", GL_TEXTURE_3D, false},
    {"samplerCube", GL_TEXTURE_CUBE_MAP, false},
    {"sampler2DShadow", GL_TEXTURE_2D, true},
    {"sampler2DArrayShadow", GL_TEXTURE_2D_ARRAY, true},
});

/// The middle of a texel, 0 to 1.
float middle(int texel) {
    return (static_cast<float>(texel) + 0.5F) / kSide;
}

Texel grey(float value) {
    return {value, value, value, 1};
}

constexpr Texel kUndisturbed = {0.5F, 0.5F, 1, 1};

struct Pattern {
    const char* name;
    Texel (*texel)(int x, int y);
};
constexpr std::array<Pattern, 5> kPatterns = {{
    {"texture_checker",
     [](int x, int y) { return grey((x * 8 / kSide + y * 8 / kSide) % 2 == 0 ? 0.25F : 1.0F); }},
    {"texture_white", [](int, int) { return grey(1); }},
    {"texture_ramp", [](int x, int) { return grey(middle(x)); }},
    {"texture_normal", [](int, int) { return kUndisturbed; }},
    {"texture_lattice",
     [](int x, int y) {
         const float from_centre = std::hypot(middle(x) - 0.5F, middle(y) - 0.5F);
         return Texel{1, 1, 1, std::clamp(4 * from_centre - 0.7F, 0.0F, 1.0F)};
     }},
}};

/// What stands in a sampler's place where the family does not say.
std::string usual_texture(std::string_view sampler) {
    std::string name(sampler);
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    const auto mentions = [&](const char* word) { return name.find(word) != std::string::npos; };
    if (mentions("normal")) return "texture_normal";
    return mentions("ramp") || mentions("lut") ? "texture_ramp" : "texture_checker";
}

void fill_color(const GladGLContext& gl, GLenum target, const TextureSource& source, TextureLevels levels) {
    const Image image = texture_texels(source);
    const float* const texels = image.values.data();
    if (target == GL_TEXTURE_2D_ARRAY || target == GL_TEXTURE_3D) {
        gl.TexImage3D(target, 0, GL_RGBA32F, kSide, kSide, 1, 0, GL_RGBA, GL_FLOAT, texels);
    } else {
        const bool cube = target == GL_TEXTURE_CUBE_MAP;
        const GLenum first = cube ? GL_TEXTURE_CUBE_MAP_POSITIVE_X : target;
        for (GLenum face = first; face < first + (cube ? 6U : 1U); ++face)
            gl.TexImage2D(face, 0, GL_RGBA32F, kSide, kSide, 0, GL_RGBA, GL_FLOAT, texels);
    }
    if (levels == TextureLevels::all) gl.GenerateMipmap(target);
    gl.TexParameteri(target, GL_TEXTURE_MIN_FILTER,
                     levels == TextureLevels::all ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
}

void fill_depth(const GladGLContext& gl, GLenum target, const std::vector<double>& numbers) {
    const float depth = numbers.empty() ? 1.0F : static_cast<float>(numbers.front());
    // One layer of an array: OpenGL clamps what is asked of later ones to it.
    if (target == GL_TEXTURE_2D_ARRAY)
        gl.TexImage3D(target, 0, GL_DEPTH_COMPONENT32F, 1, 1, 1, 0, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
    else
        gl.TexImage2D(target, 0, GL_DEPTH_COMPONENT32F, 1, 1, 0, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
    gl.TexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TexParameteri(target, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl.TexParameteri(target, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
}

}  // namespace

const RenderValue* find_value(const std::vector<RenderValue>& values, std::string_view name) {
    for (const std::string& wanted : {std::string(name), without_subscripts(name)}) {
        const auto found = std::find_if(values.rbegin(), values.rend(),
                                        [&](const RenderValue& value) { return value.name == wanted; });
        if (found != values.rend()) return &*found;
    }
    return nullptr;
}

std::string combined_type(std::string_view type) {
    constexpr std::string_view kApart = "texture";
    return type.starts_with(kApart) ? fmt::format("sampler{}", type.substr(kApart.size()))
                                    : std::string(type);
}

bool has_texture(std::string_view sampler_type) {
    return std::ranges::count(kTargets, combined_type(sampler_type), &SamplerTarget::sampler_type) > 0;
}

TextureSource texture_source_of(const std::string& sampler, const std::vector<RenderValue>& values) {
    const RenderValue* value = find_value(values, sampler);
    if (value == nullptr) return {usual_texture(sampler), {}};
    return {value->source, value->numbers};
}

const std::vector<std::string>& texture_sources() {
    static const std::vector<std::string> sources = [] {
        std::vector<std::string> names;
        for (const Pattern& pattern : kPatterns) names.emplace_back(pattern.name);
        return names;
    }();
    return sources;
}

Image texture_texels(const TextureSource& source) {
    const auto* const pattern = std::find_if(kPatterns.begin(), kPatterns.end(),
                                             [&](const Pattern& one) { return one.name == source.name; });
    Texel color = {0, 0, 0, 1};
    std::copy_n(source.numbers.begin(), std::min<std::size_t>(source.numbers.size(), 4), color.begin());
    Image image(kSide, kSide, 4);
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const Texel texel = pattern != kPatterns.end() ? pattern->texel(x, y) : color;
            std::copy(texel.begin(), texel.end(), &image.at(x, y, 0));
        }
    }
    return image;
}

std::optional<Texture> make_texture(const Context& context, const std::string& sampler_type,
                                    const TextureSource& source, TextureLevels levels) {
    const auto* const row = std::find_if(kTargets.begin(), kTargets.end(), [&](const SamplerTarget& known) {
        return known.sampler_type == sampler_type;
    });
    if (row == kTargets.end()) return std::nullopt;
    context.make_current();
    const GladGLContext& gl = context.gl();
    Texture texture{0, row->target};
    gl.GenTextures(1, &texture.name);
    gl.BindTexture(texture.target, texture.name);
    gl.TexParameteri(texture.target, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    if (row->is_shadow)
        fill_depth(gl, texture.target, source.numbers);
    else
        fill_color(gl, texture.target, source, levels);
    return texture;
}

Image environment_brdf_image() {
    constexpr int kTableSide = 32;
    const std::vector<float> table = environment_brdf_table(kTableSide);
    Image image(kTableSide, kTableSide, 4);
    for (int y = 0; y < kTableSide; ++y)
        for (int x = 0; x < kTableSide; ++x) {
            const auto entry = 2 * static_cast<std::size_t>(y * kTableSide + x);
            const Texel texel = {table[entry], table[entry + 1], 0, 1};
            std::copy(texel.begin(), texel.end(), &image.at(x, y, 0));
        }
    return image;
}

void EnvironmentMaps::add_table(const std::string& sampler, const Image& table) {
    const Context& context = resources_.context();
    context.make_current();
    const GladGLContext& gl = context.gl();
    const Texture texture{resources_.make(&GladGLContext::GenTextures, &GladGLContext::DeleteTextures),
                          GL_TEXTURE_2D};
    gl.BindTexture(texture.target, texture.name);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl.TexImage2D(texture.target, 0, GL_RGBA32F, table.width, table.height, 0, GL_RGBA, GL_FLOAT,
                  table.values.data());
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        gl.TexParameteri(texture.target, filter, GL_LINEAR);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        gl.TexParameteri(texture.target, wrap, GL_CLAMP_TO_EDGE);
    textures_[sampler] = texture;
}

Result<void> EnvironmentMaps::add(const std::string& sampler, const std::vector<Image>& levels) {
    for (const Image& faces : levels)
        if (faces.height != 6 * faces.width || faces.width < 1 || faces.channels < 3) {
            return fail(Fault::input,
                        fmt::format("a picture of {} x {} texels in {} channels is not a cube map for '{}'",
                                    faces.width, faces.height, faces.channels, sampler),
                        "give six square faces in colour, one below the other, as gobo probe writes them");
        }
    const Context& context = resources_.context();
    context.make_current();
    const GladGLContext& gl = context.gl();
    const Texture texture{resources_.make(&GladGLContext::GenTextures, &GladGLContext::DeleteTextures),
                          GL_TEXTURE_CUBE_MAP};
    gl.BindTexture(texture.target, texture.name);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    for (std::size_t level = 0; level < levels.size(); ++level) {
        const Image& faces = levels[level];
        const auto face_size = static_cast<std::size_t>(faces.width) * static_cast<std::size_t>(faces.width) *
                               static_cast<std::size_t>(faces.channels);
        const GLenum format = faces.channels == 4 ? GL_RGBA : GL_RGB;
        for (GLenum face = 0; face < 6; ++face)
            gl.TexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, static_cast<GLint>(level), GL_RGBA32F,
                          faces.width, faces.width, 0, format, GL_FLOAT,
                          faces.values.data() + face * face_size);
    }
    const bool has_levels = levels.size() > 1;
    gl.TexParameteri(texture.target, GL_TEXTURE_MAX_LEVEL, static_cast<GLint>(levels.size()) - 1);
    gl.TexParameteri(texture.target, GL_TEXTURE_MIN_FILTER, has_levels ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
    gl.TexParameteri(texture.target, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    textures_[sampler] = texture;
    return {};
}

}  // namespace gobo
