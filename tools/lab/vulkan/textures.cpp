#include <algorithm>

#include "lab/render/texture.hpp"
#include "lab/vulkan/picture.hpp"

namespace gobo::vulkan {

namespace {

Texels shared(TextureTexels texels) {
    return std::make_shared<const TextureTexels>(std::move(texels));
}

constexpr TextureLookup kToItsEdge{TextureLookup::Beyond::edge, TextureLookup::Beyond::edge};

}  // namespace

Texels usual_texels(const std::string& sampler_type, const TextureSource& source, TextureLevels levels) {
    using enum TextureTexels::Shape;
    struct Row {
        std::string_view type;
        TextureTexels::Shape shape;
        bool is_depth;
    };
    constexpr Row kRows[] = {{"sampler2D", flat, false},      {"sampler2DArray", array, false},
                             {"sampler3D", volume, false},    {"samplerCube", cube, false},
                             {"sampler2DShadow", flat, true}, {"sampler2DArrayShadow", array, true}};
    const auto* const row =
        std::ranges::find(std::begin(kRows), std::end(kRows), combined_type(sampler_type), &Row::type);
    if (row == std::end(kRows)) return nullptr;
    TextureTexels texels;
    texels.shape = row->shape;
    texels.is_depth = row->is_depth;
    if (row->is_depth) {
        texels.values = {source.numbers.empty() ? 1.0F : static_cast<float>(source.numbers.front())};
        return shared(std::move(texels));
    }
    const Image image = texture_texels(source);
    texels.width = image.width;
    texels.height = image.height;
    texels.layers = row->shape == cube ? 6 : 1;
    texels.has_levels = levels == TextureLevels::all && row->shape != volume;
    for (int layer = 0; layer < texels.layers; ++layer)
        texels.values.insert(texels.values.end(), image.values.begin(), image.values.end());
    return shared(std::move(texels));
}

Texels cube_texels(const std::vector<Image>& levels) {
    TextureTexels texels;
    texels.shape = TextureTexels::Shape::cube;
    texels.width = texels.height = levels.front().width;
    texels.layers = 6;
    texels.has_levels = levels.size() > 1;
    for (std::size_t i = 0; i < levels.size(); ++i)
        (i == 0 ? texels.values : texels.smaller.emplace_back()) = four_channels(levels[i]);
    return shared(std::move(texels));
}

Texels table_texels(const Image& table) {
    TextureTexels texels;
    texels.lookup = kToItsEdge;
    texels.width = table.width;
    texels.height = table.height;
    texels.values = table.values;
    return shared(std::move(texels));
}

Texels depth_texels(const std::vector<Image>& layers) {
    TextureTexels texels;
    texels.shape = TextureTexels::Shape::array;
    texels.is_depth = true;
    texels.lookup = kToItsEdge;
    texels.width = layers.front().width;
    texels.height = layers.front().height;
    texels.layers = static_cast<int>(layers.size());
    for (const Image& layer : layers)
        texels.values.insert(texels.values.end(), layer.values.begin(), layer.values.end());
    return shared(std::move(texels));
}

}  // namespace gobo::vulkan
