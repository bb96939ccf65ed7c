// An environment seen through a lobe: what a dull or a shiny surface shows of it.
#pragma once

#include <vector>

#include "lab/probe/environment.hpp"

namespace gobo::probe {

/// The mean of the environment's radiance around a direction d, weighted by max(d.w, 0)^exponent over all
/// directions w: (m + 1) / (2 pi) times the integral of L(w) max(d.w, 0)^m. At exponent 1 it is the radiance
/// that a white surface facing d scatters, irradiance / pi; at a shininess m the highlight by Phong's model
/// (Miller and Hoffman, Illumination and Reflection Maps, SIGGRAPH 1984 course notes).
class Lobe {
  public:
    /// Reduces the environment to what the lobe can tell apart: at least 128 rows and six to the lobe's width
    /// of 1 / sqrt(exponent), if it has them. A bright texel then counts as up to a twelfth of that width
    /// elsewhere. `exponent` is at least 1.
    Lobe(const Environment& environment, double exponent);

    /// The mean around a unit vector.
    [[nodiscard]] glm::dvec3 around(const glm::dvec3& direction) const;

    /// The rows of the reduced environment.
    [[nodiscard]] int rows() const { return environment_.height; }

  private:
    /// Texels of one row: what they have in common, and where they stand.
    struct Row {
        double solid_angle = 0;
        double sine = 0;  ///< of the latitude
        double cosine = 0;
    };

    [[nodiscard]] double weight(double cosine) const;

    Environment environment_;
    double exponent_;
    double least_cosine_;         ///< up to here the lobe is below 1e-7 of its peak
    std::vector<double> powers_;  ///< from there to 1, evenly
    std::vector<Row> rows_;
    std::vector<double> sines_, cosines_;  ///< of the longitude of each column
};

}  // namespace gobo::probe
