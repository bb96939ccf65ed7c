#include "lab/verify/random_points.hpp"

#include <algorithm>
#include <cmath>

#include "lab/raster/random.hpp"

namespace gobo::verify {
namespace {

constexpr double kLargestOrdinary = 1e3;

/// Draws values of ports.
class Drawer {
  public:
    Drawer(const std::vector<Domain>& domains, std::uint64_t seed) : domains_(domains), random_(seed) {}

    /// The values of one port for all invocations, as floats hold them.
    std::vector<double> draw(const evaluate::Port& port, std::size_t count) {
        std::vector<double> values(port.components * count);
        const auto domain =
            std::find_if(domains_.begin(), domains_.end(),
                         [name = without_subscripts(port.name)](const Domain& d) { return d.name == name; });
        for (std::size_t i = 0; i < count; ++i) {
            const double scale = domain != domains_.end() && domain->of_length ? length(*domain, port) : 1;
            for (std::size_t c = 0; c < port.components; ++c) {
                double value = domain != domains_.end() && !domain->of_length
                                   ? component(domain->low, domain->high)
                                   : scale * component(-1, 1);
                if (port.name == "gl_FragCoord") value = c < 2 ? random_.whole(0, 63) + 0.5 : random_.unit();
                if (port.scalar != evaluate::Scalar::float32) value = std::floor(value);
                if (port.scalar == evaluate::Scalar::boolean) value = random_.whole(0, 1);
                values[c * count + i] = static_cast<float>(value);
            }
        }
        return values;
    }

  private:
    /// Vectors whose length is bounded: components that give about such a length.
    double length(const Domain& domain, const evaluate::Port& port) {
        return component(domain.low, domain.high) / std::sqrt(static_cast<double>(port.components) / 3);
    }

    /// Half of them spread evenly, half over the powers of ten.
    double component(double low, double high) {
        low = std::max(low, -kLargestOrdinary);
        high = std::clamp(high, low, kLargestOrdinary);
        if (high <= 0 || random_.one_in(2)) return random_.between(low, high);
        const double size = random_.across(std::max(low, high * 1e-4), high);
        return low < 0 && random_.one_in(2) ? std::max(-size, low) : size;
    }

    const std::vector<Domain>& domains_;
    Random random_;
};

/// Every number of type float moved up or down, at random, by `step` relative to itself.
evaluate::Invocations moved(const std::vector<evaluate::Port>& ports, const evaluate::Invocations& base,
                            double step, std::uint64_t seed) {
    Random random(seed);
    evaluate::Invocations result = base;
    for (const evaluate::Port& port : ports) {
        if (port.scalar != evaluate::Scalar::float32) continue;
        const auto values = result.values.find(port.name);
        if (values == result.values.end()) continue;
        for (double& value : values->second) value *= random.one_in(2) ? 1 + step : 1 - step;
    }
    return result;
}

}  // namespace

std::string without_subscripts(const std::string& name) {
    std::string result;
    bool is_inside = false;
    for (const char character : name) {
        if (character == ']') is_inside = false;
        if (!is_inside) result += character;
        if (character == '[') is_inside = true;
    }
    return result;
}

evaluate::Invocations draw_points(const evaluate::Program& program, const std::vector<Domain>& domains,
                                  std::size_t count, std::uint64_t seed) {
    Drawer drawer(domains, seed);
    evaluate::Invocations invocations;
    invocations.count = count;
    for (const auto* ports : {&program.inputs, &program.uniforms})
        for (const evaluate::Port& port : *ports) invocations.values[port.name] = drawer.draw(port, count);
    // A smooth picture, the same in every texture: one that has no texels has no edges.
    const evaluate::Image smooth = [](const evaluate::ImageRequest& request) {
        const double x = request.coordinates[0];
        const double y = request.coordinates[1];
        return std::array<double, 4>{0.5 + 0.5 * std::sin(x), 0.5 + 0.5 * std::cos(y), 0.5, 1};
    };
    for (const evaluate::ImagePort& image : program.images) invocations.images[image.name] = smooth;
    return invocations;
}

Result<NamedValues> spread(const std::vector<evaluate::Port>& ports, const evaluate::Invocations& base,
                           const NamedValues& outputs, double step, std::uint64_t seed,
                           const std::function<Result<NamedValues>(const evaluate::Invocations&)>& run) {
    constexpr std::uint64_t kMoves = 6;  // each input goes either way in some of them
    NamedValues widest;
    for (std::uint64_t i = 0; i < kMoves; ++i) {
        GOBO_TRY(const NamedValues there, run(moved(ports, base, step, seed + i)));
        for (const auto& [name, values] : outputs) {
            std::vector<double>& most = widest[name];
            most.resize(values.size());
            const std::vector<double>& other = there.at(name);
            for (std::size_t k = 0; k < values.size(); ++k)
                most[k] = std::max(most[k], std::abs(other[k] - values[k]));
        }
    }
    return widest;
}

}  // namespace gobo::verify
