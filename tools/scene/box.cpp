#include "scene/box.hpp"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace gobo::scene {

void Box::add(const glm::dvec3& point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
}

void Box::add(const Box& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
}

glm::dvec3 Box::nearest_to(const glm::dvec3& point) const {
    return glm::clamp(point, low, high);
}

glm::dvec3 Box::corner(int index) const {
    return {(index & 1) != 0 ? high.x : low.x, (index & 2) != 0 ? high.y : low.y,
            (index & 4) != 0 ? high.z : low.z};
}

Box transformed(const glm::dmat4& matrix, const Box& box) {
    Box result;
    if (box.is_empty()) return result;
    for (int i = 0; i < 8; ++i) result.add(glm::dvec3(matrix * glm::dvec4(box.corner(i), 1)));
    return result;
}

Box product(const Box& a, const Box& b) {
    Box result;
    if (a.is_empty() || b.is_empty()) return result;
    for (const glm::dvec3& left : {a.low, a.high}) {
        for (const glm::dvec3& right : {b.low, b.high}) result.add(left * right);
    }
    return result;
}

Box sum(const Box& a, const Box& b) {
    if (a.is_empty() || b.is_empty()) return {};
    return {a.low + b.low, a.high + b.high};
}

Box rotated_anyhow(const Box& box) {
    if (box.is_empty()) return {};
    const double radius = glm::length(glm::max(glm::abs(box.low), glm::abs(box.high)));
    return {glm::dvec3(-radius), glm::dvec3(radius)};
}

double least_distance(const Box& a, const Box& b) {
    return glm::length(glm::max(glm::max(a.low - b.high, b.low - a.high), glm::dvec3(0)));
}

double greatest_distance(const Box& a, const Box& b) {
    return glm::length(glm::max(glm::abs(a.high - b.low), glm::abs(b.high - a.low)));
}

}  // namespace gobo::scene
