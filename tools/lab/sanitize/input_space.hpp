// All that a stage reads, as one flat list of numbers within the domains of its inputs: what searches draw,
// change, and simplify.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "family/family.hpp"
#include "lab/evaluate/eval_file.hpp"
#include "lab/raster/random_numbers.hpp"
#include "lab/sanitize/constraints.hpp"

namespace gobo::sanitize {

/// The standard library's generators cost more than the shaders they make inputs for.
class Random : public RandomNumbers<Xoshiro256> {
  public:
    using RandomNumbers::RandomNumbers;

    /// True one time in `n`.
    [[nodiscard]] bool one_in(std::size_t n) { return index(n) == 0; }
};

/// Numbers nearer to 0 than this are drawn only where a domain's own bounds are: coordinates and lengths
/// below it occur as exactly 0.
inline constexpr double kSmallest = 1e-6;

/// Whether a component may hold the number. Not for domains of a length.
[[nodiscard]] bool holds(const Domain& domain, double number);

/// The numbers where shaders fail: 0, the bounds, the smallest, 1 and its neighbours, halves, band edges.
/// Of a component, or of a length where the domain is of one.
[[nodiscard]] std::vector<double> hard_numbers(const Domain& domain);

/// A number of the domain: evenly spread, or every power of ten as likely as any other.
[[nodiscard]] double ordinary_number(const Domain& domain, Random& random);

[[nodiscard]] double length_of(std::span<const double> vector);

/// Colours of a texture's texels.
inline constexpr std::size_t kTexelColors = 4;
/// The numbers of a texture in a point: its colours, then its seed, its side and its levels.
inline constexpr std::size_t kTextureNumbers = 4 * kTexelColors + 3;

/// An input, a uniform, or what a texture holds.
struct InputField {
    std::string name;  ///< reflected
    std::string type;  ///< GLSL name; "vec4" of a texture
    evaluate::Scalar scalar = evaluate::Scalar::float32;
    bool is_texture = false;
    int pixel = -1;  ///< of a quad, where each has its own; -1: all share it
    Domain domain;
    std::vector<Domain>
        channels;               ///< of a texture: r, g, b, a, then its side and its levels, 0 where unknown
    std::vector<Domain> parts;  ///< of a vector's components, where one has a range of its own; else empty
    std::vector<double> hard;   ///< hard numbers of the domain
    std::size_t first = 0;      ///< of its numbers in a point
    std::size_t components = 1;

    [[nodiscard]] bool is_float() const { return evaluate::is_float(scalar); }
    [[nodiscard]] bool is_vector() const;
    /// Components that the domain's range is of: all but a last one that is a quantity of its own.
    [[nodiscard]] std::size_t ranged() const { return components - (domain.last.empty() ? 0 : 1); }
    /// The domain of that last component.
    [[nodiscard]] Domain last_domain() const;
    /// The range of a component, which is not one of a length.
    [[nodiscard]] const Domain& domain_of(std::size_t component) const {
        return parts.empty() ? domain : parts[component];
    }
    /// Whether its numbers are x, y, z and w.
    [[nodiscard]] bool has_named_components() const {
        return !is_texture && type.find("vec") != std::string::npos;
    }
    [[nodiscard]] bool is_number() const { return is_float() && components == 1; }
    /// Whether it says where a pixel lies, in its middle, which no search may change.
    [[nodiscard]] bool is_pixel_place() const { return name == "gl_FragCoord"; }
};

/// The fields of a stage.
struct InputSpace {
    std::vector<InputField> fields;
    std::size_t numbers = 0;            ///< of a point
    std::size_t pixels = 1;             ///< invocations of a point: 4 where each point is a quad
    std::vector<std::size_t> vectors;   ///< fields that are vectors of floats
    std::vector<std::size_t> floats;    ///< fields that are single floats
    std::vector<std::size_t> field_of;  ///< of each number of a point
    std::vector<Constraint> constraints;
};

/// Points of one stage, each `InputSpace::numbers` numbers, one after the other.
struct PointSet {
    PointSet(std::size_t numbers_of_point, std::size_t points)
        : numbers(numbers_of_point), count(points), values(numbers * points) {}

    std::size_t numbers;
    std::size_t count;
    std::vector<double> values;

    [[nodiscard]] std::span<const double> operator[](std::size_t index) const {
        return {values.data() + index * numbers, numbers};
    }
    [[nodiscard]] std::span<double> operator[](std::size_t index) {
        return {values.data() + index * numbers, numbers};
    }
};

/// With `in_quads` a point of a stage that needs quads is one: its pixels share uniforms, textures and whole
/// numbers, and have inputs of their own. A texture's domain is that of its name, of "map.r" and so on for
/// one channel; "map.side" and "map.levels" state its size.
[[nodiscard]] InputSpace input_space_of(const evaluate::Program& program, const std::vector<Domain>& domains,
                                        bool in_quads = false);

/// A number of a texture's field; `hardness` is the share of hard ones.
[[nodiscard]] double drawn_texture_number(const InputField& field, std::size_t number, double hardness,
                                          Random& random);

/// The nearest numbers that the field's domain allows, as floats or whole numbers.
void bring_into_domain(const InputField& field, std::span<double> numbers);

/// The points as invocations of the stage, those of a quad one after the other. Each texture has its own
/// texels at every point.
[[nodiscard]] evaluate::Invocations invocations_of(const InputSpace& space, const PointSet& points);

/// One point; what it does not name is 0.
[[nodiscard]] PointSet point_set(const InputSpace& space, const evaluate::EvalPoint& point);

}  // namespace gobo::sanitize
