// The light of a whole environment: radiance by direction, as a latitude-longitude map holds it, as nine
// coefficients of spherical harmonics, as the six faces of a cube, and seen through a lobe.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/diagnostic.hpp"
#include "lab/render/image.hpp"

namespace gobo::probe {

/// A latitude-longitude map as OpenEXR's ImfEnvmap.h defines it: +y is up and in the top row, the middle of
/// the picture looks along +z, its left half along +x. Twice as wide as high; radiance linear, finite, not
/// negative.
struct Environment {
    int width = 0;
    int height = 0;
    std::vector<glm::dvec3> texels;  ///< rows from the top
    int negatives = 0;               ///< channels of texels that were negative in the picture, and are 0
    double most_negative = 0;        ///< the least of them

    [[nodiscard]] const glm::dvec3& at(int column, int row) const {
        return texels[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(column)];
    }
};

/// The unit vector of a texel's centre.
[[nodiscard]] glm::dvec3 direction_of(const Environment& environment, int column, int row);

/// The solid angle of each texel of a row, exactly: 2 pi / width times the difference of the sines of its
/// latitudes.
[[nodiscard]] double solid_angle(const Environment& environment, int row);

/// A picture with at least three channels as an environment. Errors, at `path`: another shape than 2 : 1,
/// less than 4 x 2 texels, texels that are no numbers or infinite (negative ones, which lossy compression
/// leaves in dark places, count as 0), with the first one's place.
[[nodiscard]] Result<Environment> environment_of(const Image& image, const std::string& path);

/// The same environment with half as many texels each way, each the mean of four weighted by solid angle.
/// Width and height must be even.
[[nodiscard]] Environment halved(const Environment& environment);

/// Coefficients of the radiance, in the order L00, L1-1, L10, L11, L2-2, L2-1, L20, L21, L22. The axes are
/// those of the environment: x, y and z of the polynomials are its own, y is up.
using Harmonics = std::array<glm::dvec3, 9>;

/// The integrals of L(w) Y(w) over all directions, over the texels' exact solid angles (Ramamoorthi and
/// Hanrahan, An Efficient Representation for Irradiance Environment Maps, SIGGRAPH 2001, equation 3).
[[nodiscard]] Harmonics project(const Environment& environment);

/// Nine rows "probe,coefficient,red,green,blue" under a heading, as the published probes are kept.
[[nodiscard]] std::string to_csv(const Harmonics& harmonics, std::string_view name);

/// The unit vector of a texel's centre on a face of `side` texels: faces +x -x +y -y +z -z, columns along s,
/// rows along t, as OpenGL 4.5 has them in table 8.19. Row 0 is the first that glTexImage2D takes.
[[nodiscard]] glm::dvec3 cube_direction(int face, int side, int column, int row);

/// A picture of side x 6 side texels, the faces one below the other, with what `radiance` gives for each
/// direction. It is called by `jobs` threads.
[[nodiscard]] Image make_cube_map(int side, int jobs,
                                  const std::function<glm::dvec3(const glm::dvec3&)>& radiance);

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

    /// The mean around a unit vector; the nearest texel where the lobe is so narrow that it falls between
    /// them.
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

    friend std::vector<Image> roughness_maps(const Environment&, int, int, int);
    /// A lobe of any shape, given at cosines from `least_cosine` to 1; `width` is its angle, about, in
    /// radians.
    Lobe(const Environment& environment, double width, double least_cosine,
         const std::function<double(double)>& shape);
    void tabulate(double needed_rows, const std::function<double(double)>& shape);

    [[nodiscard]] double weight(double cosine) const;
    [[nodiscard]] glm::dvec3 nearest(const glm::dvec3& direction) const;

    Environment environment_;
    double exponent_;
    double least_cosine_;         ///< up to here the lobe is below 1e-7 of its peak
    std::vector<double> powers_;  ///< from there to 1, evenly
    std::vector<Row> rows_;
    std::vector<double> sines_, cosines_;  ///< of the longitude of each column
};

/// What a metallic-roughness surface mirrors of the environment, as the split sum has it: level by level of a
/// cube map, `levels` of them from roughness 0 to 1 evenly, `side` texels wide and each half of that before.
/// The mean of the radiance around a direction, weighted by n.l D(h) with the normal along it (Karis, Real
/// Shading in Unreal Engine 4, SIGGRAPH 2013 course notes).
[[nodiscard]] std::vector<Image> roughness_maps(const Environment& environment, int side, int levels,
                                                int jobs);

/// The cube map of what a lobe shows of the environment.
[[nodiscard]] Image lobe_map(const Environment& environment, double exponent, int side, int jobs);

}  // namespace gobo::probe
