// What the cross-check's limits pay for, measured on the renderer: how far its own functions, its
// interpolation and its filtering are from exact. Each row prints what it found, and holds the limit between
// that and four times that.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lab/evaluate/images.hpp"
#include "lab/raster/compare_picture.hpp"
#include "lab/raster/random.hpp"
#include "lab/render/render.hpp"
#include "lab/render/texture.hpp"

namespace gobo {
namespace {

constexpr int kSide = 64;

/// A triangle that covers every pixel, drawn by a fragment stage that sets `result`. x runs from 0 to 1 over
/// all pixels, in steps that floats hold; random is a vector with components in [-1, 1] of its own.
std::vector<StageText> stages(const std::string& declarations, const std::string& result) {
    const std::string vertex =
        "#version 450\nlayout(location = 0) in vec3 position;\nvoid main() { gl_Position = vec4(position, "
        "1.0); }\n";
    const std::string fragment =
        "#version 450\n" + declarations +
        "layout(location = 0) out vec4 color;\n"
        "float x = (gl_FragCoord.x - 0.5 + 64.0 * (gl_FragCoord.y - 0.5) + 1.0) / 4096.0;\n"
        "void main() { color = vec4(" +
        result + "); }\n";
    return {stage_text(StageKind::vertex, "precision.vert", vertex),
            stage_text(StageKind::fragment, "precision.frag", fragment)};
}

Interface interface_of(const std::string& sampler_type) {
    Interface interface;
    Variable position;
    position.name = "position";
    position.type = "vec3";
    position.location = 0;
    interface.inputs.push_back(position);
    if (!sampler_type.empty()) {
        Sampler sampler;
        sampler.name = "map";
        sampler.type = sampler_type;
        sampler.binding = 0;
        interface.samplers.push_back(sampler);
    }
    return interface;
}

Object triangle() {
    Object object;
    object.mesh.positions = {{-1, -1, 0}, {3, -1, 0}, {-1, 3, 0}};
    object.mesh.normals.assign(3, glm::vec3(0, 0, 1));
    object.mesh.texcoords.assign(3, glm::vec2(0));
    object.mesh.indices = {0, 1, 2};
    return object;
}

Image draw(const Context& context, const std::string& declarations, const std::string& result,
           const std::string& sampler_type = {}, const GivenTextures& textures = {}) {
    View view;
    view.width = view.height = kSide;
    const auto picture = render_permutation(context, stages(declarations, result), interface_of(sampler_type),
                                            {triangle()}, {{"position", "position", {}, {}}}, view, textures);
    EXPECT_TRUE(picture) << to_text(picture.error().front());
    return picture ? picture->color : Image(kSide, kSide, 4);
}

/// Calls `visit(x, color)` for each pixel.
template <class Visit>
void for_each_pixel(const Image& image, const Visit& visit) {
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const int up = kSide - 1 - y;
            visit((x + kSide * up + 1) / 4096.0,
                  glm::dvec4(image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2), image.at(x, y, 3)));
        }
}

struct FunctionRow {
    const char* name;
    const char* expression;
    double (*exact)(double x);
    double limit;  ///< relative to the result, where that exceeds a thousandth
};

const FunctionRow kFunctions[] = {
    {"a highlight's power: exp(m log(c))", "exp(90.0 * log(0.9 + 0.1 * x))",
     [](double x) {
         return std::exp(90 * std::log(static_cast<double>(0.9F + 0.1F * static_cast<float>(x))));
     },
     raster::kPowerError},
    {"exp(-x)", "exp(-7.0 * x)", [](double x) { return std::exp(-7 * x); }, raster::kPowerError},
    {"pow(x, 48)", "pow(0.875 + 0.125 * x, 48.0)", [](double x) { return std::pow(0.875 + 0.125 * x, 48); },
     raster::kPowerError},
    {"atan(y, x)", "atan(x, 1.0 - x)", [](double x) { return std::atan2(x, 1 - x); }, raster::kPowerError},
    {"sin", "sin(1.5 * x)", [](double x) { return std::sin(1.5 * x); }, raster::kPowerError},
    {"inversesqrt", "inversesqrt(x)", [](double x) { return 1 / std::sqrt(x); }, raster::kArithmeticError},
    {"sqrt", "sqrt(x)", [](double x) { return std::sqrt(x); }, raster::kArithmeticError},
    {"division", "1.0 / (x + 1.0)", [](double x) { return 1 / (x + 1); }, raster::kArithmeticError},
};

TEST(RendererPrecision, OfFunctionsIsWithinTheLimits) {
    const Context context = open_context(Backend::osmesa).value();
    for (const FunctionRow& row : kFunctions) {
        double largest = 0;
        for_each_pixel(draw(context, "", row.expression), [&](double x, const glm::dvec4& color) {
            const double exact = row.exact(x);
            if (exact > 1e-3) largest = std::max(largest, std::abs(color.x - exact) / exact);
        });
        fmt::print("{}: {:.1e} of the result\n", row.name, largest);
        EXPECT_LE(largest, row.limit) << row.name;
    }
}

/// Every texel another colour, from 0 to 1.
Image patchwork(int width, int height) {
    Image image(width, height, 4);
    Random random(5);
    for (float& value : image.values) value = static_cast<float>(random.unit());
    return image;
}

std::vector<std::array<float, 4>> texels_of(const Image& image) {
    std::vector<std::array<float, 4>> texels(image.values.size() / 4);
    for (std::size_t i = 0; i < image.values.size(); ++i) texels[i / 4][i % 4] = image.values[i];
    return texels;
}

/// The texels' alpha in every channel.
std::vector<std::array<float, 4>> alphas_of(const Image& image) {
    std::vector<std::array<float, 4>> texels = texels_of(image);
    for (std::array<float, 4>& texel : texels) texel.fill(texel[3]);
    return texels;
}

/// The largest error of a channel over all pixels, whose colours run from 0 to 1. `place` gives the
/// coordinates, which floats hold.
template <class Texels, class Place>
double filtering_error(const Image& drawn, const Texels& texels, const Place& place) {
    double largest = 0;
    for_each_pixel(drawn, [&](double x, const glm::dvec4& color) {
        evaluate::ImageRequest request;
        request.coordinates = place(x);
        const std::array<double, 4> exact = answer(texels, request);
        for (int channel = 0; channel < 3; ++channel)
            largest = std::max(largest, std::abs(color[channel] - exact[static_cast<std::size_t>(channel)]));
    });
    return largest;
}

TEST(RendererPrecision, OfFilteringIsWithinTheLimits) {
    const Context context = open_context(Backend::osmesa).value();
    const TextureSource lattice{"texture_lattice", {}};
    const Texture texture = make_texture(context, "sampler2D", lattice, TextureLevels::one).value();
    const double of_flat = filtering_error(
        draw(context, "uniform sampler2D map;\n", "texture(map, vec2(5.0 * x - 2.0, 37.0 * x)).a",
             "sampler2D", {{"map", texture}}),
        evaluate::ColorTexels{64, 64, alphas_of(texture_texels(lattice))}, [](double x) {
            return std::array<double, 4>{5 * x - 2, 37 * x, 0, 0};
        });
    context.gl().DeleteTextures(1, &texture.name);
    const Image faces = patchwork(32, 6 * 32);
    EnvironmentMaps cubes(context);
    ASSERT_TRUE(cubes.add("map", faces));
    const auto fraction = [](double x) { return x - std::floor(x); };
    const double of_cube =
        filtering_error(draw(context, "uniform samplerCube map;\n",
                             "textureLod(map, 2.0 * fract(vec3(x, 37.0 * x, 91.0 * x)) - 1.0, 0.0)",
                             "samplerCube", cubes.textures()),
                        evaluate::CubeTexels{32, texels_of(faces)}, [&](double x) {
                            return std::array<double, 4>{2 * fraction(x) - 1, 2 * fraction(37 * x) - 1,
                                                         2 * fraction(91 * x) - 1, 0};
                        });
    fmt::print("between texels: {:.1e} of their contrast; of a cube's: {:.1e}\n", of_flat, of_cube);
    EXPECT_LE(of_flat, raster::kFilteringError);
    EXPECT_LE(of_cube, raster::kFilteringError);
}

}  // namespace
}  // namespace gobo
