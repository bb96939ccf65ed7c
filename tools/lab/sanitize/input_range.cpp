#include "lab/sanitize/input_range.hpp"

#include <algorithm>
#include <cmath>

namespace gobo::sanitize {
namespace {

Domain plain_domain(const std::string& name, double low, double high) {
    Domain domain;
    domain.name = name;
    domain.low = low;
    domain.high = high;
    return domain;
}

constexpr double kAboveOne = 1.00000012;  // a float's neighbours of 1
constexpr double kBelowOne = 0.99999994;

}  // namespace

std::string name_of_domain(const std::string& name) {
    std::string result;
    bool is_inside = false;
    for (const char character : name) {
        if (character == ']') is_inside = false;
        if (!is_inside) result += character;
        if (character == '[') is_inside = true;
    }
    return result;
}

Domain range_of(const evaluate::Port& port, const std::vector<Domain>& domains) {
    const std::string name = name_of_domain(port.name);
    const auto declared =
        std::find_if(domains.begin(), domains.end(), [&](const Domain& d) { return d.name == name; });
    if (declared != domains.end()) return *declared;
    if (port.scalar == evaluate::Scalar::boolean) return plain_domain(name, 0, 1);
    if (port.scalar == evaluate::Scalar::uint32) return plain_domain(name, 0, 100);
    if (name == "gl_FragCoord" || name == "gl_PointCoord" || name == "gl_SamplePosition")
        return plain_domain(name, 0, 1);
    if (name.starts_with("gl_")) return plain_domain(name, 0, 100);
    return plain_domain(name, -100, 100);
}

bool holds(const Domain& domain, double number) {
    return (number >= domain.low && number <= domain.high) ||
           std::find(domain.also.begin(), domain.also.end(), number) != domain.also.end();
}

std::vector<double> hard_numbers(const Domain& domain) {
    std::vector<double> numbers;
    for (const double size : {kSmallest, 0.25, 0.5, 0.75, kBelowOne, 1.0, kAboveOne, 2.0, 1e3})
        for (const double number : {size, -size})
            if (holds(domain, number)) numbers.push_back(number);
    numbers.insert(numbers.end(), {domain.low, domain.high});
    numbers.insert(numbers.end(), domain.also.begin(), domain.also.end());
    if (holds(domain, 0)) numbers.insert(numbers.end(), {0, 0, 0});  // the hardest of all
    return numbers;
}

double ordinary_number(const Domain& domain, Random& random) {
    if (random.one_in(2)) return random.between(domain.low, domain.high);
    const double largest = std::max(std::abs(domain.low), std::abs(domain.high));
    const double smallest = domain.low > 0 ? domain.low : std::min(kSmallest, largest);
    if (smallest <= 0) return domain.low;
    const double size = smallest * std::pow(largest / smallest, random.unit());
    const double number = domain.low < 0 && random.one_in(2) ? -size : size;
    return std::clamp(number, domain.low, domain.high);
}

void hard_direction(std::span<double> direction, Random& random) {
    const std::size_t components = direction.size();
    std::fill(direction.begin(), direction.end(), 0.0);
    switch (random.index(4)) {
        case 0:
            direction[random.index(components)] = random.one_in(2) ? 1 : -1;
            break;
        case 1:
            for (double& component : direction) component = random.one_in(2) ? 1 : -1;
            break;
        case 2:
            for (double& component : direction) component = random.between(-1e-6, 1e-6);
            direction[random.index(components)] = random.one_in(2) ? 1 : -1;
            break;
        default:
            for (double& component : direction) component = random.between(-1, 1);
            break;
    }
    double square = 0;
    for (const double component : direction) square += component * component;
    for (double& component : direction) component /= std::sqrt(square);
}

}  // namespace gobo::sanitize
