#include "lab/study/worst_inputs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include <glm/geometric.hpp>
#include <gobo/environment_brdf.hpp>

#include "core/text.hpp"
#include "lab/oracle/oracle.hpp"
#include "lab/verify/random_points.hpp"

namespace gobo::study {
namespace {

using verify::Sample;

/// Turns the whole scene about the viewer, so that the point stands at an angle from the middle of the view.
void turn_into_view(Sample& sample, SearchRandom& random) {
    const double distance = glm::length(sample.surface.position);
    if (distance == 0) return;
    const double angle = random.across(1e-3, std::numbers::pi / 2);
    const double around = random.between(0, 2 * std::numbers::pi);
    const glm::dvec3 from = sample.surface.position / distance;
    const glm::dvec3 to{std::sin(angle) * std::cos(around), std::sin(angle) * std::sin(around),
                        -std::cos(angle)};
    const glm::dvec3 between = from + to;
    if (glm::length(between) < 1e-6) return;
    // Mirrored at the middle of the two and at `to`: together a turn.
    const glm::dvec3 middle = glm::normalize(between);
    const auto turn = [&](glm::dvec3& vector) {
        vector = 2 * glm::dot(vector, middle) * middle - vector;
        const double length = glm::dot(vector, to);
        vector = 2 * length * to - vector;
    };
    turn(sample.surface.position);
    turn(sample.surface.normal);
    for (oracle::DirectionalLight& light : sample.scene.directional) turn(light.direction);
    for (oracle::PointLight& light : sample.scene.point) turn(light.position);
    for (oracle::SpotLight& light : sample.scene.spot) {
        turn(light.position);
        turn(light.axis);
    }
    for (oracle::DirectionalOrPointLight& light : sample.scene.directional_or_point) {
        glm::dvec3 position(light.position);
        turn(position);
        light.position = glm::dvec4(position, light.position.w);
    }
}

double nearest_in(const Domain& domain, double number) {
    return std::ranges::find(domain.also, number) != domain.also.end()
               ? number
               : std::clamp(number, domain.low, domain.high);
}

}  // namespace

std::vector<SearchedField> searched_fields(const evaluate::Program& program,
                                           const std::vector<Domain>& domains) {
    std::vector<SearchedField> fields;
    for (const auto* ports : {&program.inputs, &program.uniforms})
        for (const evaluate::Port& port : *ports) {
            const auto field = verify::field_of(port.name);
            if (!field || port.scalar != evaluate::Scalar::float32) continue;
            const Domain* domain = verify::domain_of(domains, port.name);
            fields.push_back(
                {*field, port.name, domain == nullptr ? std::nullopt : std::optional(*domain), {}});
            const std::string name = without_subscripts(port.name);
            for (std::size_t i = 0; i < port.components; ++i)
                if (const Domain* const own = domain_of_component(domains, name, i))
                    fields.back().parts.emplace_back(i, *own);
        }
    return fields;
}

std::vector<SearchedOrder> searched_orders(const std::vector<SearchedField>& fields,
                                           const std::vector<Domain>& domains) {
    const auto is_named = [&](std::size_t field, const std::string& name) {
        return without_subscripts(fields[field].name) == name;
    };
    std::vector<SearchedOrder> orders;
    for (const Constraint& constraint : constraints_of(domains)) {
        if (!constraint.is_comparison() || constraint.has_number()) continue;
        for (std::size_t less = 0; less < fields.size(); ++less)
            for (std::size_t more = 0; more < fields.size(); ++more)
                if (is_named(less, constraint.names[0]) && is_named(more, constraint.names[1]) &&
                    struct_of(fields[less].name) == struct_of(fields[more].name))  // of the same element
                    orders.push_back({less, more, constraint.kind});
    }
    return orders;
}

bool bring_into_order(const SearchedOrder& order, const std::vector<SearchedField>& fields, Sample& sample) {
    const SearchedField& less = fields[order.less];
    const SearchedField& more = fields[order.more];
    const auto is_kept = [&] {
        const std::vector<double> left = less.field.get(sample);
        const std::vector<double> right = more.field.get(sample);
        for (std::size_t i = 0; i < std::min(left.size(), right.size()); ++i) {
            const auto a = static_cast<float>(left[i]);
            const auto b = static_cast<float>(right[i]);
            if (order.kind == Constraint::Kind::less         ? a >= b
                : order.kind == Constraint::Kind::less_equal ? a > b
                                                             : a == b)
                return false;
        }
        return true;
    };
    if (is_kept()) return true;
    std::vector<double> left = less.field.get(sample);
    std::vector<double> right = more.field.get(sample);
    for (std::size_t i = 0; i < std::min(left.size(), right.size()); ++i) {
        if (left[i] > right[i]) std::swap(left[i], right[i]);
        if (left[i] == right[i]) right[i] = std::nextafter(static_cast<float>(right[i]), HUGE_VALF);
    }
    less.field.set(sample, left);
    more.field.set(sample, right);
    bring_into_domain(less, sample);
    bring_into_domain(more, sample);
    return is_kept();
}

void bring_to_edges(Sample& sample, SearchRandom& random) {
    if (random.one_in(4)) turn_into_view(sample, random);
    sample.scene.material.shininess = random.one_in(2) ? random.across(1e-3, 10) : random.across(1e-3, 1e6);
    for (oracle::SpotLight& light : sample.scene.spot) {
        const double outer = random.across(1e-3, std::numbers::pi);
        const double inner = outer * (random.one_in(2) ? random.unit() : 1 - random.across(1e-3, 1));
        light.outer_one_minus_cosine = 2 * std::pow(std::sin(outer / 2), 2);
        light.inner_one_minus_cosine = 2 * std::pow(std::sin(inner / 2), 2);
        const glm::dvec3 ray = sample.surface.position - light.position;
        if (glm::length(ray) == 0) continue;
        // Turned away from the point by an angle within the soft edge.
        const double angle = inner + (outer - inner) * random.unit();
        const glm::dvec3 to_point = glm::normalize(ray);
        glm::dvec3 aside{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
        aside = glm::cross(to_point, aside);
        if (glm::length(aside) == 0) continue;
        light.axis = std::cos(angle) * to_point + std::sin(angle) * glm::normalize(aside);
    }
}

void bring_near(Sample& sample, SearchRandom& random) {
    const auto step = [&] {
        const glm::dvec3 direction{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
        return direction * random.across(1e-20, 1e-3);
    };
    sample.surface.position = random.one_in(4) ? glm::dvec3(0) : step();
    const auto move = [&](glm::dvec3& position) {
        if (random.one_in(2)) position = sample.surface.position + step();
    };
    for (oracle::PointLight& light : sample.scene.point) move(light.position);
    for (oracle::SpotLight& light : sample.scene.spot) move(light.position);
    for (oracle::DirectionalOrPointLight& light : sample.scene.directional_or_point) {
        glm::dvec3 position(light.position);
        move(position);
        light.position = glm::dvec4(position, light.position.w);
    }
}

void leave_one_light(oracle::Scene& scene, SearchRandom& random) {
    std::vector<glm::dvec3*> colors;
    for (oracle::DirectionalLight& light : scene.directional) colors.push_back(&light.color);
    for (oracle::PointLight& light : scene.point) colors.push_back(&light.color);
    for (oracle::SpotLight& light : scene.spot) colors.push_back(&light.color);
    for (oracle::DirectionalOrPointLight& light : scene.directional_or_point) colors.push_back(&light.color);
    if (colors.empty()) return;
    const std::size_t lit = random.index(colors.size());
    for (std::size_t i = 0; i < colors.size(); ++i)
        if (i != lit) *colors[i] = glm::dvec3(0);
    scene.ambient = scene.material.emission = glm::dvec3(0);
    std::ranges::fill(scene.light_ambients, glm::dvec3(0));
    scene.fog.density = 0;
}

bool is_of_dark_light(const SearchedField& field, const oracle::Scene& scene) {
    const auto element = verify::element_name(field.name);
    if (!element) return false;
    const auto is_dark = [&](const auto& lights) {
        return element->index < lights.size() && lights[element->index].color == glm::dvec3(0);
    };
    if (element->array == "DirectionalLights.lights") return is_dark(scene.directional);
    if (element->array == "PointLights.lights") return is_dark(scene.point);
    if (element->array == "SpotLights.lights") return is_dark(scene.spot);
    return element->array == "DirectionalOrPointLights.lights" && is_dark(scene.directional_or_point);
}

/// A domain's length is of all numbers but a last one that has a range of its own.
void bring_into_domain(const SearchedField& field, Sample& sample) {
    if (!field.domain) return;
    const Domain& domain = *field.domain;
    std::vector<double> numbers = field.field.get(sample);
    const std::span<double> first(numbers.data(), numbers.size() - (domain.last.empty() ? 0 : 1));
    if (domain.of_length) {
        double square = 0;
        for (const double number : first) square += number * number;
        const double length = std::sqrt(square);
        if (length > 0)
            for (double& number : first) number *= nearest_in(domain, length) / length;
    } else {
        for (double& number : first) number = nearest_in(domain, number);
        for (const auto& [component, own] : field.parts) first[component] = nearest_in(own, first[component]);
    }
    if (!domain.last.empty()) numbers.back() = std::clamp(numbers.back(), domain.last[0], domain.last[1]);
    field.field.set(sample, numbers);
}

void bring_to_end(const SearchedField& field, Sample& sample, SearchRandom& random) {
    if (!field.domain) return;
    std::vector<double> numbers = field.field.get(sample);
    if (numbers.empty()) return;
    std::vector<double> ends = field.domain->also;
    ends.push_back(field.domain->low);
    ends.push_back(field.domain->high);
    const double end = random.pick(ends);
    if (field.is_of_length())
        for (double& number : numbers) number *= end;
    else
        numbers[random.index(numbers.size())] = end;
    field.field.set(sample, numbers);
}

void look_up_table(const oracle::Model& model, Sample& sample) {
    constexpr int kSize = 32;
    static const std::vector<float> kTexels = environment_brdf_table(kSize);
    const double nv = glm::dot(oracle::shading_direction(model, sample.surface.normal),
                               oracle::to_viewer(model, sample.surface.position));
    const auto place = [](double coordinate) {
        return static_cast<std::size_t>(std::clamp(coordinate * kSize, 0.0, kSize - 1.0));
    };
    const std::size_t texel = kSize * place(sample.scene.material.roughness) + place(std::abs(nv));
    sample.scene.environment_brdf = {kTexels[2 * texel], kTexels[2 * texel + 1]};
}

}  // namespace gobo::study
