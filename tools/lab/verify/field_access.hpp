// How fields of samples are read and written as lists of numbers. For the pages that name them (feed*.cpp).
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <glm/gtc/type_ptr.hpp>

#include "lab/verify/feed.hpp"

namespace gobo::verify {

inline std::vector<double> numbers(double value) {
    return {value};
}
inline std::vector<double> numbers(int value) {
    return {static_cast<double>(value)};
}
inline std::vector<double> numbers(bool value) {
    return {value ? 1.0 : 0.0};
}
template <glm::length_t size>
std::vector<double> numbers(const glm::vec<size, double>& value) {
    return {glm::value_ptr(value), glm::value_ptr(value) + size};
}
template <glm::length_t columns, glm::length_t rows>
std::vector<double> numbers(const glm::mat<columns, rows, double>& value) {
    return {glm::value_ptr(value), glm::value_ptr(value) + columns * rows};
}

template <class Number>
void assign(Number& target, const std::vector<double>& values) requires std::is_arithmetic_v<Number> {
    target = static_cast<Number>(values.at(0));
}
template <class Vector>
void assign(Vector& target, const std::vector<double>& values) {
    auto* first = glm::value_ptr(target);
    std::copy_n(values.begin(), std::min(values.size(), numbers(target).size()), first);
}

/// The field that `access` gives a reference to.
template <class Access>
Field field(Access access) {
    return {[access](const Sample& sample) { return numbers(access(sample)); },
            [access](Sample& sample, const std::vector<double>& values) { assign(access(sample), values); }};
}

using Fields = std::map<std::string, Field, std::less<>>;

/// "PointLights.lights[2].color" after "PointLights.lights": 2 and "color"; "Harmonics.coefficients[3]": 3
/// and nothing.
struct ElementName {
    std::size_t index = 0;
    std::string_view member;
};
[[nodiscard]] std::optional<ElementName> element_name(std::string_view name, std::string_view array);

}  // namespace gobo::verify
