#include "lab/oracle/power.hpp"

#include <algorithm>
#include <cmath>

namespace gobo::oracle {
namespace {

/// Models that end at a right angle are 0 from there on; at exponent 0 everything is 1.
double beyond_a_right_angle(double shininess) {
    return shininess > 0 ? 0 : 1;
}

double near_exact(double cosine, double shininess) {
    if (cosine <= 0) return beyond_a_right_angle(shininess);
    const double z = (cosine - 1) / (cosine + 1);
    return std::exp(2 * shininess * (z + z * z * z / 3));
}

double schlick(double cosine, double shininess) {
    if (cosine <= 0) return beyond_a_right_angle(shininess);
    return cosine / (shininess - shininess * cosine + cosine);
}

}  // namespace

double lobe(Power power, double versine, double shininess) {
    const double cosine = 1 - versine;
    switch (power) {
        case Power::exact:
            break;
        case Power::near_exact:
            return near_exact(cosine, shininess);
        case Power::squaring:
            return std::pow(std::max(cosine, 0.0), std::nearbyint(shininess));
        case Power::gaussian_fitted:
            return std::exp((shininess + 0.664) * (cosine - 1));
        case Power::gaussian:
            return std::exp(shininess * (cosine - 1));
        case Power::lyon:
            return std::pow(std::max(1 - shininess * versine / 4, 0.0), 4);
        case Power::schlick:
            return schlick(cosine, shininess);
    }
    return std::pow(std::max(cosine, 0.0), shininess);
}

}  // namespace gobo::oracle
