// Extensions of glTF's material that change what a surface mirrors, each a feature of `pbr` with a uniform
// block of its own: all that the oracle knows of one stands in a row.
#pragma once

#include <vector>

#include "lab/oracle/microfacets.hpp"

namespace gobo::oracle {

/// A number of the extension's block, and between what it is tried.
struct ExtensionNumber {
    const char* uniform;  ///< "Iridescence.factor"
    double low;
    double high;
};

/// What takes the place of Fresnel's reflectance, and how much of it.
struct ReplacedReflectance {
    double share = 0;
    glm::dvec3 value{0};
};

struct ReflectanceExtension {
    const char* feature;
    const char* value;
    std::vector<ExtensionNumber> numbers;
    /// At a cosine to the normal, or to the half vector.
    ReplacedReflectance (*at)(const std::vector<double>& numbers, const Reflectance& surface, double cosine,
                              Roundings& roundings);
};

/// In the order in which they change what a surface mirrors.
[[nodiscard]] const std::vector<ReflectanceExtension>& reflectance_extensions();

/// The numbers of all of them, one extension after the other, as Scene::extension_numbers holds them.
[[nodiscard]] std::vector<ExtensionNumber> extension_numbers();

/// Those of the extension at that place; zero where there are fewer.
[[nodiscard]] std::vector<double> numbers_of(const std::vector<double>& of_all, std::size_t place);

}  // namespace gobo::oracle
