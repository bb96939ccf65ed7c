#include "lab/verify/random_points.hpp"

#include <algorithm>
#include <cmath>

#include "core/text.hpp"
#include "family/constraint.hpp"
#include "lab/raster/random.hpp"

namespace gobo::verify {
namespace {

constexpr double kLargestOrdinary = 1e3;

/// Half of them spread evenly, half over the powers of ten.
double component(double low, double high, Random& random) {
    low = std::max(low, -kLargestOrdinary);
    high = std::clamp(high, low, kLargestOrdinary);
    if (high <= 0 || random.one_in(2)) return random.between(low, high);
    const double size = random.across(std::max(low, high * 1e-4), high);
    return low < 0 && random.one_in(2) ? std::max(-size, low) : size;
}

/// The values of one port for all invocations, as floats hold them. Vectors whose length is bounded get
/// components that give about such a length.
std::vector<double> draw(const evaluate::Port& port, const std::vector<Domain>& domains, std::size_t count,
                         Random& random) {
    const Domain* const domain = domain_of(domains, port.name);
    const std::string name = without_subscripts(port.name);
    std::vector<const Domain*> own;
    for (std::size_t c = 0; c < port.components; ++c) own.push_back(domain_of_component(domains, name, c));
    std::vector<double> values(port.components * count);
    const bool is_length = domain != nullptr && domain->of_length;
    for (std::size_t i = 0; i < count; ++i) {
        const double scale = is_length ? component(domain->low, domain->high, random) /
                                             std::sqrt(static_cast<double>(port.components) / 3)
                                       : 1;
        for (std::size_t c = 0; c < port.components; ++c) {
            double value = domain != nullptr && !is_length ? component(domain->low, domain->high, random)
                                                           : scale * component(-1, 1, random);
            if (own[c] != nullptr) value = component(own[c]->low, own[c]->high, random);
            if (port.name == "gl_FragCoord") value = c < 2 ? random.whole(0, 63) + 0.5 : random.unit();
            if (!evaluate::is_float(port.scalar)) value = std::floor(value);
            if (port.scalar == evaluate::Scalar::boolean) value = random.whole(0, 1);
            values[c * count + i] = static_cast<float>(value);
        }
    }
    return values;
}

/// Every number of type float moved up or down, at random, by `step` relative to itself.
evaluate::Invocations moved(const std::vector<evaluate::Port>& ports, const evaluate::Invocations& base,
                            double step, std::uint64_t seed) {
    Random random(seed);
    evaluate::Invocations result = base;
    for (const evaluate::Port& port : ports) {
        if (!evaluate::is_float(port.scalar)) continue;
        const auto values = result.values.find(port.name);
        if (values == result.values.end()) continue;
        for (double& value : values->second) value *= random.one_in(2) ? 1 + step : 1 - step;
    }
    return result;
}

}  // namespace

const Domain* domain_of(const std::vector<Domain>& domains, const std::string& name) {
    const auto found = std::find_if(
        domains.begin(), domains.end(),
        [plain = without_subscripts(name)](const Domain& domain) { return domain.name == plain; });
    return found == domains.end() ? nullptr : &*found;
}

evaluate::Invocations draw_points(const evaluate::Program& program, const std::vector<Domain>& domains,
                                  std::size_t count, std::uint64_t seed) {
    Random random(seed);
    evaluate::Invocations invocations;
    invocations.count = count;
    for (const auto* ports : {&program.inputs, &program.uniforms})
        for (const evaluate::Port& port : *ports)
            invocations.values[port.name] = draw(port, domains, count, random);
    // A smooth picture, the same in every texture: one that has no texels has no edges.
    const evaluate::Image smooth = [](const evaluate::ImageRequest& request) {
        const double x = request.coordinates[0];
        const double y = request.coordinates[1];
        return std::array<double, 4>{0.5 + 0.5 * std::sin(x), 0.5 + 0.5 * std::cos(y), 0.5, 1};
    };
    for (const evaluate::ImagePort& image : program.images) invocations.images[image.name] = smooth;
    return invocations;
}

double largest_component(const std::vector<double>& values, std::size_t count, std::size_t index) {
    double size = 0;
    for (std::size_t k = index; k < values.size(); k += count) size = std::max(size, std::abs(values[k]));
    return size;
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

Result<NamedValues> in_double(const evaluate::Program& program, const evaluate::Invocations& points) {
    GOBO_TRY(auto outputs, evaluate::run<double>(program, points));
    return std::move(outputs.values);
}

Result<NamedValues> spread(const evaluate::Program& program, const evaluate::Invocations& base,
                           const NamedValues& outputs, double step, std::uint64_t seed) {
    std::vector<evaluate::Port> ports = program.inputs;
    ports.insert(ports.end(), program.uniforms.begin(), program.uniforms.end());
    return spread(ports, base, outputs, step, seed,
                  [&](const evaluate::Invocations& moved) { return in_double(program, moved); });
}

}  // namespace gobo::verify
