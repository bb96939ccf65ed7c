#include "lab/verify/switched_feed.hpp"

#include "lab/verify/uber_ports.hpp"

namespace gobo::verify {
namespace {

/// Zeros where the light's kind has no such member.
std::vector<double> numbers_of(const Sample& sample, const UberPort& port) {
    if (port.lit_name.empty()) return {port.number};
    const std::optional<Field> field = field_of(port.lit_name);
    return field ? field->get(sample) : std::vector<double>{};
}

}  // namespace

std::optional<Field> switched_field(const std::string& name) {
    if (!is_uber_port(name)) return std::nullopt;
    return Field{[name](const Sample& sample) {
                     const auto port = uber_port(sample.model, name);
                     return port ? numbers_of(sample, *port) : std::vector<double>{};
                 },
                 [](Sample&, const std::vector<double>&) {}};
}

}  // namespace gobo::verify
