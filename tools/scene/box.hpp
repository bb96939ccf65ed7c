// Axis-aligned boxes in double precision, and the interval arithmetic that bounds what moves.
#pragma once

#include <limits>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace gobo::scene {

/// All points between two corners, both included. Empty until a point is added.
struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    [[nodiscard]] bool is_empty() const { return !(low.x <= high.x); }
    void add(const glm::dvec3& point);
    void add(const Box& other);
    /// The point of the box nearest to `point`; the box must not be empty.
    [[nodiscard]] glm::dvec3 nearest_to(const glm::dvec3& point) const;
    /// Corner 0 to 7.
    [[nodiscard]] glm::dvec3 corner(int index) const;

    friend bool operator==(const Box&, const Box&) = default;
};

/// The box of the transformed corners: it contains every transformed point. Affine matrices only.
[[nodiscard]] Box transformed(const glm::dmat4& matrix, const Box& box);

/// The box that holds the componentwise products, or sums, of a point of `a` and one of `b`.
[[nodiscard]] Box product(const Box& a, const Box& b);
[[nodiscard]] Box sum(const Box& a, const Box& b);

/// The box about the origin that holds every rotation of the box's points about the origin.
[[nodiscard]] Box rotated_anyhow(const Box& box);

/// Least and greatest distance between a point of `a` and one of `b`; neither may be empty.
[[nodiscard]] double least_distance(const Box& a, const Box& b);
[[nodiscard]] double greatest_distance(const Box& a, const Box& b);

}  // namespace gobo::scene
