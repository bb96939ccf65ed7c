#include "lab/evaluate/images.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

namespace gobo::evaluate {
namespace {

using What = ImageRequest::What;
using Color = std::array<double, 4>;

Color all_of(double value) {
    return {value, value, value, value};
}

/// The texel that holds a place, or the one at the edge; the first where it is no number, as its weight is
/// none either.
std::size_t clamped(double place, int count) {
    return place > 0 ? static_cast<std::size_t>(std::min(place, count - 1.0)) : 0;
}

std::size_t repeated(double place, int count) {
    return clamped(place - std::floor(place / count) * count, count);
}

double depth_at(const DepthTexels& texels, double x, double y, double layer) {
    const std::size_t row =
        clamped(std::round(layer), texels.layers) * static_cast<std::size_t>(texels.height) +
        clamped(y, texels.height);
    return texels.depths[row * static_cast<std::size_t>(texels.width) + clamped(x, texels.width)];
}

/// A sum of texels, each by its weight.
class Blend {
  public:
    void add(const std::array<float, 4>& color, double weight) {
        for (std::size_t channel = 0; channel < 4; ++channel) {
            const auto value = static_cast<double>(color[channel]);
            sum_[channel] += weight * value;
            plain_[channel] += value;
        }
        ++count_;
    }
    /// A texel that does not exist: the mean of those that do stands for it.
    void add_missing(double weight) { missing_ = weight; }

    [[nodiscard]] Color color() const {
        Color color = sum_;
        for (std::size_t channel = 0; channel < 4; ++channel)
            color[channel] += missing_ * plain_[channel] / count_;
        return color;
    }

  private:
    Color sum_{};
    Color plain_{};
    int count_ = 0;
    double missing_ = 0;
};

/// The texels on either side of a place along one axis.
struct Around {
    explicit Around(double place) : low(std::floor(place - 0.5)), weight(place - 0.5 - low) {}
    double low;
    double weight;  ///< of the upper one
};

/// Calls `add(column, row, weight)` for the four texels around a place in texels (OpenGL 4.5, 8.14.3).
template <class Add>
void for_each_around(double x, double y, const Add& add) {
    const Around across(x);
    const Around up(y);
    add(across.low, up.low, (1 - across.weight) * (1 - up.weight));
    add(across.low + 1, up.low, across.weight * (1 - up.weight));
    add(across.low, up.low + 1, (1 - across.weight) * up.weight);
    add(across.low + 1, up.low + 1, across.weight * up.weight);
}

/// A face: the axis on which it lies, and the axes along which s and t grow (OpenGL 4.5, table 8.19).
struct Face {
    std::array<double, 3> axis, s, t;
};
constexpr std::array<Face, 6> kFaces = {{{{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                                         {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                                         {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                         {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                                         {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
                                         {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}}};

double dot(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Where a direction meets the cube: the face, and the place on it in texels.
struct OnCube {
    std::size_t face = 0;
    double x = 0;
    double y = 0;
};

OnCube on_cube(const std::array<double, 3>& direction, int side) {
    OnCube place;
    for (std::size_t face = 1; face < kFaces.size(); ++face)
        if (dot(direction, kFaces[face].axis) > dot(direction, kFaces[place.face].axis)) place.face = face;
    const Face& face = kFaces[place.face];
    const double ahead = dot(direction, face.axis);
    place.x = 0.5 * (dot(direction, face.s) / ahead + 1) * side;
    place.y = 0.5 * (dot(direction, face.t) / ahead + 1) * side;
    return place;
}

std::size_t cube_index(const OnCube& place, int side) {
    const auto width = static_cast<std::size_t>(side);
    return (place.face * width + clamped(place.y, side)) * width + clamped(place.x, side);
}

/// The texel beyond the edge of a face: its centre, in the face's plane, seen from the middle of the cube
/// lies in the texel of the next face that touches it.
std::size_t across_edge(std::size_t face, double column, double row, int side) {
    const double s = 2 * (column + 0.5) / side - 1;
    const double t = 2 * (row + 0.5) / side - 1;
    std::array<double, 3> direction{};
    for (std::size_t i = 0; i < 3; ++i)
        direction[i] = kFaces[face].axis[i] + s * kFaces[face].s[i] + t * kFaces[face].t[i];
    return cube_index(on_cube(direction, side), side);
}

constexpr std::array<const char*, 3> kAlong = {".along_x", ".along_y", ".along_z"};

bool changes(const EvenColor& even) {
    return std::any_of(even.along.begin(), even.along.end(), [](const Color& slope) {
        return std::any_of(slope.begin(), slope.end(), [](double number) { return number != 0; });
    });
}

bool is_cube(const spirv::Image& type) {
    return type.dimension == spv::DimCube && !type.depth;
}

Color answer_evenly(const EvenColor& even, const ImageRequest& request, bool is_cube) {
    if (request.what != What::sample || request.compares || !changes(even))
        return answer(even.color, request);
    const auto& at = request.coordinates;
    const double length = is_cube ? std::hypot(at[0], at[1], at[2]) : 1;
    Color color = even.color;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t channel = 0; channel < 4; ++channel)
            color[channel] += even.along[axis][channel] * at[axis] / length;
    return color;
}

/// The six directions of a cube map's axes.
EvenColor along_axes(const Image& image, ImageRequest request) {
    EvenColor even;
    request.dimensions = 3;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        request.coordinates = {};
        request.coordinates[axis] = 1;
        const Color there = image(request);
        request.coordinates[axis] = -1;
        const Color back = image(request);
        for (std::size_t channel = 0; channel < 4; ++channel) {
            even.color[channel] = 0.5 * (there[channel] + back[channel]);
            even.along[axis][channel] = 0.5 * (there[channel] - back[channel]);
        }
    }
    return even;
}

DepthTexels texel_by_texel(const Image& image, ImageRequest request, const Color& size) {
    DepthTexels texels{static_cast<int>(size[0]), static_cast<int>(size[1]), static_cast<int>(size[2]), {}};
    request.what = What::fetch;
    for (int layer = 0; layer < texels.layers; ++layer)
        for (int y = 0; y < texels.height; ++y)
            for (int x = 0; x < texels.width; ++x) {
                request.coordinates = {static_cast<double>(x), static_cast<double>(y),
                                       static_cast<double>(layer), 0};
                texels.depths.push_back(image(request)[0]);
            }
    return texels;
}

}  // namespace

Color answer(const Color& color, const ImageRequest& request, double side) {
    if (request.what == What::size) return all_of(side);
    if (request.what == What::levels) return {std::log2(side) + 1, 0, 0, 0};
    if (request.compares) return all_of(request.reference <= color[0] ? 1 : 0);
    if (request.what == What::gather) return all_of(color[static_cast<std::size_t>(request.component)]);
    return color;
}

Color answer(const DepthTexels& texels, const ImageRequest& request) {
    if (request.what == What::size)
        return {static_cast<double>(texels.width), static_cast<double>(texels.height),
                static_cast<double>(texels.layers), 1};
    if (request.what == What::levels) return {1, 0, 0, 0};
    const auto& place = request.coordinates;
    if (!request.compares) return all_of(depth_at(texels, place[0], place[1], place[2]));
    double passed = 0;
    for_each_around(place[0] * texels.width, place[1] * texels.height,
                    [&](double x, double y, double weight) {
                        if (request.reference <= depth_at(texels, x, y, place[2])) passed += weight;
                    });
    return all_of(passed);
}

Color answer(const ColorTexels& texels, const ImageRequest& request) {
    const auto at = [&](double x, double y) {
        return texels.colors[repeated(y, texels.height) * static_cast<std::size_t>(texels.width) +
                             repeated(x, texels.width)];
    };
    const auto& place = request.coordinates;
    if (request.what == What::size)
        return {static_cast<double>(texels.width), static_cast<double>(texels.height), 1, 1};
    if (request.what == What::levels) return {1, 0, 0, 0};
    Blend blend;
    if (request.what == What::fetch)
        blend.add(at(place[0], place[1]), 1);
    else
        for_each_around(place[0] * texels.width + request.offset[0],
                        place[1] * texels.height + request.offset[1],
                        [&](double x, double y, double weight) { blend.add(at(x, y), weight); });
    return blend.color();
}

Color answer(const CubeTexels& texels, const ImageRequest& request) {
    const auto side = static_cast<double>(texels.side);
    if (request.what == What::size) return {side, side, 1, 1};
    if (request.what == What::levels) return {1, 0, 0, 0};
    const auto& to = request.coordinates;
    const OnCube place = on_cube({to[0], to[1], to[2]}, texels.side);
    Blend blend;
    for_each_around(place.x, place.y, [&](double x, double y, double weight) {
        const bool is_across = x < 0 || x >= side;
        const bool is_above = y < 0 || y >= side;
        if (is_across && is_above) return blend.add_missing(weight);  // in a corner three faces meet
        const std::size_t index = is_across || is_above ? across_edge(place.face, x, y, texels.side)
                                                        : cube_index({place.face, x, y}, texels.side);
        blend.add(texels.colors[index], weight);
    });
    return blend.color();
}

int TexelPattern::known_levels() const {
    return levels > 0 ? levels : std::bit_width(static_cast<unsigned>(known_side()));
}

namespace {

/// Mixes a whole number into a hash (splitmix64).
std::uint64_t mixed(std::uint64_t hash, std::int64_t number) {
    hash += static_cast<std::uint64_t>(number) + 0x9e3779b97f4a7c15U;
    hash = (hash ^ (hash >> 30U)) * 0xbf58476d1ce4e5b9U;
    hash = (hash ^ (hash >> 27U)) * 0x94d049bb133111ebU;
    return hash ^ (hash >> 31U);
}

/// The texel that holds a place, 0 where that is no number.
std::int64_t texel_at(double place, int side) {
    if (!(std::fabs(place) < 1e15)) return 0;
    return static_cast<std::int64_t>(place - std::floor(place / side) * side);
}

const Color& texel_of(const TexelPattern& pattern, const std::array<std::int64_t, 4>& place) {
    std::uint64_t hash = static_cast<std::uint64_t>(pattern.seed);
    for (const std::int64_t number : place) hash = mixed(hash, number);
    return pattern.colors[hash % pattern.colors.size()];
}

}  // namespace

Color answer(const TexelPattern& pattern, const ImageRequest& request, bool is_cube) {
    const bool has_level = request.has_lod && std::isfinite(request.lod);
    const double last = pattern.known_levels() - 1.0;
    const auto level = has_level ? static_cast<int>(std::clamp(std::round(request.lod), 0.0, last)) : 0;
    const int side = std::max(pattern.known_side() >> level, 1);
    if (request.what == What::size) return all_of(side);
    if (request.what == What::levels) return all_of(pattern.known_levels());
    if (request.what == What::lod) return {};
    std::array<double, 3> place{};
    for (std::size_t axis = 0; axis < place.size(); ++axis) {
        const double given = request.coordinates[axis];
        const bool is_layer = axis >= static_cast<std::size_t>(request.dimensions);
        place[axis] = is_layer || request.what == What::fetch ? std::round(given) : given * side;
        if (!is_layer) place[axis] += request.offset[axis];
    }
    std::int64_t face = 0;
    if (is_cube) {
        const auto& to = request.coordinates;
        const OnCube on = on_cube({to[0], to[1], to[2]}, side);
        place = {on.x, on.y, to[3]};
        face = static_cast<std::int64_t>(on.face) + 1;
    }
    const auto at = [&](double right, double up) -> const Color& {
        return texel_of(pattern, {texel_at(place[0] + right, side), texel_at(place[1] + up, side),
                                  texel_at(place[2], std::max(side, 4096)), face * 64 + level});
    };
    if (request.compares && request.what != What::gather)
        return all_of(request.reference <= at(0, 0)[0] ? 1 : 0);
    if (request.what != What::gather) return at(0, 0);
    constexpr std::array<std::array<double, 2>, 4> kAround = {{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
    Color gathered{};
    for (std::size_t i = 0; i < kAround.size(); ++i) {
        const Color& texel = at(kAround[i][0], kAround[i][1]);
        gathered[i] = request.compares ? static_cast<double>(request.reference <= texel[0])
                                       : texel[static_cast<std::size_t>(request.component)];
    }
    return gathered;
}

const TexelPattern* pattern_of(const Image& image, std::size_t invocation) {
    const auto* const patterns = image.target<PatternImage>();
    return patterns == nullptr ? nullptr : &patterns->at(invocation);
}

void add_numbers(const std::string& sampler, const TexelPattern& pattern, SamplerNumbers& numbers) {
    const bool is_plain = std::ranges::all_of(
        pattern.colors, [&](const Color& color) { return color == pattern.colors.front(); });
    std::vector<double>& texels = numbers[sampler + ".texels"];
    for (const Color& color : pattern.colors) {
        texels.insert(texels.end(), color.begin(), color.end());
        if (is_plain) break;
    }
    if (!is_plain) numbers[sampler + ".seed"] = {static_cast<double>(pattern.seed)};
    if (pattern.side > 0) numbers[sampler + ".side"] = {static_cast<double>(pattern.side)};
    if (pattern.levels > 0) numbers[sampler + ".levels"] = {static_cast<double>(pattern.levels)};
}

Image image_of(TextureContent content, const spirv::Image& type) {
    if (auto* texels = std::get_if<DepthTexels>(&content))
        return [texels = std::move(*texels)](const ImageRequest& request) { return answer(texels, request); };
    return [even = std::get<EvenColor>(content), is_cube = is_cube(type)](const ImageRequest& request) {
        return answer_evenly(even, request, is_cube);
    };
}

TextureContent content_of(const Image& image, const ImagePort& port, std::size_t invocation) {
    ImageRequest request;
    request.invocation = invocation;
    if (is_cube(port.type)) return along_axes(image, request);
    if (port.type.depth) {
        ImageRequest about_size = request;
        about_size.what = What::size;
        const Color size = image(about_size);
        const bool is_plain =  // a texture of one colour is as large in every direction
            std::all_of(size.begin(), size.end(), [&](double extent) { return extent == size[0]; });
        if (!is_plain) return texel_by_texel(image, request, size);
    }
    return EvenColor{image(request), {}};
}

void add_numbers(const std::string& sampler, const TextureContent& content, SamplerNumbers& numbers) {
    if (const auto* texels = std::get_if<DepthTexels>(&content)) {
        numbers[sampler + ".size"] = {static_cast<double>(texels->width), static_cast<double>(texels->height),
                                      static_cast<double>(texels->layers)};
        numbers[sampler + ".depths"] = texels->depths;
        return;
    }
    const auto& even = std::get<EvenColor>(content);
    const std::vector<double> color(even.color.begin(), even.color.end());
    if (!changes(even)) {
        numbers[sampler] = color;
        return;
    }
    numbers[sampler + ".color"] = color;
    for (std::size_t axis = 0; axis < 3; ++axis)
        numbers[sampler + kAlong[axis]].assign(even.along[axis].begin(), even.along[axis].end());
}

}  // namespace gobo::evaluate
