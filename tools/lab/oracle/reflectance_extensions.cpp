#include "lab/oracle/reflectance_extensions.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>

namespace gobo::oracle {
namespace {

/// One peak of the eye's sensitivity, transformed: what interference at an optical path of x micrometres adds
/// is height exp(-fading x^2) cos(2 pi waves x). KHR_materials_iridescence states each in metres, as val,
/// pos and var: height = val sqrt(2 pi var) / 1.0685e-7, waves = pos / 1e6, fading = 4 pi^2 var / 1e12. The
/// numbers are those that a float holds.
struct SensitivityPeak {
    double height;
    double waves;
    double fading;

    [[nodiscard]] double at(double path, Roundings& r) const {
        constexpr double kTurn = 6.2831855;
        const double turns = r(waves * path);
        const double faded = height * std::exp(r(-fading * path * path));
        return r(faded * std::cos(kTurn * (turns - std::floor(turns))), 4 * faded);
    }
};
constexpr SensitivityPeak kOfX = {0.84659, 1.681, 0.1708547};
constexpr SensitivityPeak kOfY = {1.0002218, 1.7953, 0.36733088};
constexpr SensitivityPeak kOfZ = {1.0011225, 2.2084, 0.26103523};
constexpr SensitivityPeak kSecondOfX = {0.1538683, 2.2399, 0.17876618};

/// Red, green and blue of that interference; `phase` is +1, or -1 where reflections turn a wave by half.
glm::dvec3 sensitivity(double path, const glm::dvec3& phase, Roundings& r) {
    const glm::dmat3 kFromXyz(3.2404542, -0.9692660, 0.0556434, -1.5371385, 1.8760108, -0.2040259, -0.4985314,
                              0.0415560, 1.0572252);
    const double x = kOfX.at(path, r) + kSecondOfX.at(path, r);
    return kFromXyz * (phase * glm::dvec3(x, kOfY.at(path, r), kOfZ.at(path, r)));
}

double schlick(double head_on, double cosine) {
    return head_on + (1 - head_on) * std::pow(1 - cosine, 5);
}

/// The reflectance of a thin film over the surface (Belcour and Barla 2017, by KHR_materials_iridescence,
/// "Iridescence Fresnel"): numbers are the factor, the film's index of refraction, and its thickness in
/// nanometres. The base's index comes from its F0; the extension adds 1e-4 to it so that none is infinite.
/// What leaves 0 to 1 is clamped.
ReplacedReflectance thin_film(const std::vector<double>& numbers, const Reflectance& surface, double cosine,
                              Roundings& r) {
    const double film = numbers[1];
    const double thickness = numbers[2] / 1000;
    const double sine_squared = (1 - cosine * cosine) / (film * film);
    const double refracted = std::sqrt(std::max(r(1 - sine_squared, 1), 0.0));
    const double path = r(2 * film * thickness * refracted);
    const auto of_indices = [](double above, double beneath) {
        return std::pow((beneath - above) / (beneath + above), 2);
    };
    const double r12 = r(schlick(of_indices(1, film), cosine), 1);
    const double through = 1 - r12;
    glm::dvec3 returned(0);
    glm::dvec3 both(0);
    glm::dvec3 phase(0);
    const glm::dvec3 f0 = surface.f0();
    for (int i = 0; i < 3; ++i) {
        const double root = std::sqrt(f0[i]);
        const double base = (1 + root) / std::max(1 - root, 1e-300);
        const double r23 = r(schlick(of_indices(film, base), refracted), 1);
        both[i] = std::clamp(r12 * r23, 0.0, 0.9999);
        returned[i] = through * through * r23 / r(1 - both[i], 1);
        phase[i] = base < film ? 1 : -1;
    }
    const glm::dvec3 wave = r(returned - through, 1);
    const glm::dvec3 sum = r12 + returned + 2.0 * wave * glm::sqrt(both) * sensitivity(path, phase, r) +
                           2.0 * wave * both * sensitivity(2 * path, glm::dvec3(1), r);
    return {numbers[0], glm::clamp(sum, 0.0, 1.0)};
}

}  // namespace

const std::vector<ReflectanceExtension>& reflectance_extensions() {
    static const std::vector<ReflectanceExtension> kExtensions = {
        {"iridescence",
         "thin_film",
         {{"Iridescence.factor", 0, 1}, {"Iridescence.ior", 1, 3}, {"Iridescence.thickness", 0, 1200}},
         thin_film}};
    return kExtensions;
}

std::vector<ExtensionNumber> extension_numbers() {
    std::vector<ExtensionNumber> numbers;
    for (const ReflectanceExtension& extension : reflectance_extensions())
        numbers.insert(numbers.end(), extension.numbers.begin(), extension.numbers.end());
    return numbers;
}

std::vector<double> numbers_of(const std::vector<double>& of_all, std::size_t place) {
    const std::vector<ReflectanceExtension>& all = reflectance_extensions();
    std::size_t first = 0;
    for (std::size_t i = 0; i < place; ++i) first += all[i].numbers.size();
    std::vector<double> numbers(all[place].numbers.size());
    for (std::size_t i = 0; i < numbers.size() && first + i < of_all.size(); ++i)
        numbers[i] = of_all[first + i];
    return numbers;
}

}  // namespace gobo::oracle
