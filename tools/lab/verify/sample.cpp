#include "lab/verify/sample.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include "lab/oracle/oracle.hpp"
#include "lab/verify/sample_effects.hpp"
#include "lab/verify/sample_members.hpp"

namespace gobo::verify {
namespace {

/// Makes the samples of one stage, one after the other.
class SampleMaker {
  public:
    SampleMaker(const oracle::Model& model, StageKind stage, std::uint64_t seed)
        : model_(model), stage_(stage), is_vertex_(stage == StageKind::vertex), random_(seed) {}

    Sample make() {
        Sample sample;
        if (is_vertex_)
            place_vertex(sample);
        else
            place_fragment(sample);
        fill_draw(sample);
        return sample;
    }

    Sample make_draw(const Mesh& mesh) {
        Sample sample;
        place_mesh(sample, mesh);
        fill_draw(sample);
        return sample;
    }

  private:
    /// All that is the same for every point of a draw.
    void fill_draw(Sample& sample) {
        sample.model = model_;
        choose_side(model_, stage_, random_, sample);
        if (mesh_ != nullptr)
            for (const glm::vec3& position : mesh_->positions)
                vertices_.emplace_back(sample.model_view * glm::dvec4(position, 1));
        fill_surface(model_, stage_, random_, sample);
        normal_ = glm::normalize(sample.surface.is_back ? -sample.surface.normal : sample.surface.normal);
        const glm::dvec3 to_viewer = oracle::to_viewer(model_, sample.surface.position);
        mirrored_ = 2 * glm::dot(normal_, to_viewer) * normal_ - to_viewer;
        fill_materials(sample);
        sample.scene.ambient = random_.components(0, 1);
        add_lights(sample);
        if (!is_vertex_) interpolate_lights(model_, sample.scene, random_, sample.surface);
        sample.scene.toon_levels = random_.whole(1, 8);
        fill_fog(sample.scene.fog, glm::length(sample.surface.position));
        sample.scene.depth_offset = random_.between(-0.6, 0.6);
        fill_effects(model_, random_, sample);
        if (model_.output_range == oracle::OutputRange::half_float && random_.one_in(4))
            scale_beyond_half_float(sample);
    }

    void place_fragment(Sample& sample) {
        const double size = random_.across(0.1, 1e3);
        sample.surface.position = random_.direction() * size;
        if (!random_.one_in(8)) sample.surface.position.z = -std::abs(sample.surface.position.z);
        is_along_axis_ = random_.one_in(16);
        const glm::dvec3 normal = is_along_axis_ ? glm::dvec3(0, 0, 1) : facing(sample.surface.position);
        sample.surface.normal = normal * random_.between(0.3, 1);
        nearest_light_ = 1e-2;
        farthest_light_ = 1e3;
        sample.lit_radiance = random_.components(-0.1, 4);  // interpolation may leave the range a little
        sample.depth = random_.unit();
    }

    void place_vertex(Sample& sample) {
        const double size = random_.across(0.1, 1e3);
        glm::dmat4 matrix = glm::translate(glm::dmat4(1), random_.direction() * size);
        matrix *= random_.rotation(0, 6.28);
        matrix = glm::scale(matrix, random_.components(0.5, 2));
        sample.model_view = matrix;
        sample.object_position = random_.components(-size, size);
        sample.normal_matrix = glm::transpose(glm::inverse(glm::dmat3(matrix)));
        sample.surface.position = glm::dvec3(matrix * glm::dvec4(sample.object_position, 1));
        const glm::dvec3 eye_normal = facing(sample.surface.position) * random_.across(0.1, 10);
        sample.object_normal = glm::transpose(glm::dmat3(matrix)) * eye_normal;
        sample.surface.normal = sample.normal_matrix * sample.object_normal;
        for (int column = 0; column < 4; ++column)
            sample.projection[column] = {random_.components(-2, 2), random_.between(-2, 2)};
        nearest_light_ = std::max(0.3 * size, 1e-2);
        farthest_light_ = 10 * size;
    }

    /// Whether a light there would be nearer to a vertex of the mesh than lights are to points: the rounding
    /// of the vertex would turn its ray by more than an edge is wide.
    [[nodiscard]] bool is_near_a_vertex(const glm::dvec3& position) const {
        return std::any_of(vertices_.begin(), vertices_.end(), [&](const glm::dvec3& vertex) {
            return glm::distance(vertex, position) < nearest_light_;
        });
    }

    /// Turned, stretched and moved to two to six times its size before the viewer; lit at one vertex.
    void place_mesh(Sample& sample, const Mesh& mesh) {
        const double size = random_.across(0.1, 100);
        glm::dmat4 matrix = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, -4 * size));
        matrix *= random_.rotation(0, 6.28);
        sample.model_view = glm::scale(matrix, random_.components(0.5, 2) * size);
        sample.normal_matrix = glm::transpose(glm::inverse(glm::dmat3(sample.model_view)));
        sample.projection = glm::perspective(0.9, 1.0, size, 8 * size);
        const auto last = static_cast<int>(mesh.positions.size()) - 1;
        sample = at_vertex(sample, mesh, static_cast<std::size_t>(random_.whole(0, last)));
        sample.surface.position = glm::dvec3(sample.model_view * glm::dvec4(sample.object_position, 1));
        sample.surface.normal = sample.normal_matrix * sample.object_normal;
        mesh_ = &mesh;
        nearest_light_ = std::max(0.3 * size, 1e-2);
        farthest_light_ = 10 * size;
    }

    /// A normal, three times out of four on the viewer's side.
    glm::dvec3 facing(const glm::dvec3& position) {
        const glm::dvec3 normal = random_.direction();
        return random_.one_in(4) || glm::dot(normal, position) < 0 ? normal : -normal;
    }

    void fill_materials(Sample& sample) {
        if (model_.material == oracle::MaterialChoice::array)
            for (oracle::Material& material : sample.scene.materials) fill_material(material);
        else
            fill_material(sample.scene.material);
        const double shininess = oracle::material_of(model_, sample.scene, sample.surface).shininess;
        lobe_width_ = 1 / std::sqrt(std::max(shininess, 1.0));
        if (!model_.is_physical()) return;
        fill_metallic_roughness(random_, sample);
        lobe_width_ = oracle::alpha_of_roughness(sample.scene.material.roughness);
    }

    void fill_material(oracle::Material& material) {
        material.emission = random_.one_in(2) ? glm::dvec3(0) : random_.components(0, 1);
        material.ambient = random_.components(0, 1);
        material.diffuse = random_.components(0, 1);
        material.specular = random_.components(0, 1);
        material.strength = random_.across(0.1, 4);
        material.shininess = random_.one_in(16) ? 0 : random_.across(0.1, 1e3);
    }

    /// The direction of a light: anywhere, in front of the surface, behind it, or where the highlight is.
    glm::dvec3 to_light() {
        const glm::dvec3 anywhere = random_.direction();
        switch (random_.whole(0, 3)) {
            case 0:
                return anywhere;
            case 1:
                return glm::dot(anywhere, normal_) > 0 ? anywhere : -anywhere;
            default:
                return glm::normalize(mirrored_ + random_.across(0.1, 4) * lobe_width_ * anywhere);
        }
    }

    /// Coefficients of which some are 0, and a colour that brings some radiance to the point.
    void set_brightness(oracle::PointLight& light, double distance) {
        for (int i = 0; i < 3; ++i) light.attenuation[i] = random_.one_in(4) ? 0 : random_.across(1e-3, 1);
        if (light.attenuation == glm::dvec3(0)) light.attenuation.x = 1;
        if (model_.light_range == oracle::LightRange::windowed)
            light.nearness = random_.one_in(8) ? 0 : 1 / (distance * random_.across(0.9, 10));
        const glm::dvec3& k = light.attenuation;
        const double brightness = std::min(k.x + distance * (k.y + distance * k.z), 1e5);
        light.color = random_.components(0, 2) * brightness;
    }

    /// Places the light and returns the unit vector to it.
    glm::dvec3 place(oracle::PointLight& light, const glm::dvec3& surface) {
        glm::dvec3 direction = to_light();
        double distance = random_.across(nearest_light_, farthest_light_);
        while (is_near_a_vertex(surface + direction * distance)) {
            direction = to_light();
            distance = random_.across(nearest_light_, farthest_light_);
        }
        light.position = surface + direction * distance;
        set_brightness(light, distance);
        return direction;
    }

    void aim(oracle::SpotLight& light, const glm::dvec3& direction) {
        const double outer = random_.one_in(8) ? 1.5707963267948966 : random_.across(0.01, 1.5);
        light.outer_one_minus_cosine = random_.one_in(16) ? 2 : 1 - std::cos(outer);
        light.inner_one_minus_cosine =
            light.outer_one_minus_cosine * (random_.one_in(4) ? 1 : random_.between(0, 0.9));
        light.exponent = random_.one_in(4) ? 0 : random_.across(0.1, 1e3);
        // Seen from the light, the point lies somewhere from the axis to a little outside the cone.
        const glm::dvec3 aside = glm::normalize(glm::cross(direction, random_.direction()));
        const double angle = outer * random_.between(0, 1.2);
        light.axis = -std::cos(angle) * direction + std::sin(angle) * aside;
        if (light.outer_one_minus_cosine == 2 && random_.one_in(2)) {  // it holds even the ray straight back
            light.axis = direction;
            light.inner_one_minus_cosine = 2;
            light.exponent = 0;
        }
    }

    /// A direction of any length, a point, or a point times some w: a power of two, so that a float holds the
    /// same place.
    oracle::DirectionalOrPointLight either_kind(const glm::dvec3& surface) {
        oracle::PointLight local;
        const glm::dvec3 direction = place(local, surface);
        if (random_.one_in(2)) {
            const glm::dvec3 color = random_.components(0, 2);
            return {glm::dvec4(direction * random_.across(0.1, 10), 0), color, local.attenuation};
        }
        const int exponent = random_.one_in(2) ? 0 : random_.whole(-3, 3);
        const double w = std::ldexp(random_.one_in(4) ? -1 : 1, exponent);
        return {glm::dvec4(local.position * w, w), local.color, local.attenuation};
    }

    void add_lights(Sample& sample) {
        for (int i = 0; i < model_.directional; ++i) {
            const bool is_straight = is_along_axis_ && random_.one_in(2);  // a cosine of exactly 1
            sample.scene.directional.push_back(
                {is_straight ? normal_ : to_light(), random_.components(0, 2)});
        }
        for (int i = 0; i < model_.point; ++i)
            (void)place(sample.scene.point.emplace_back(), sample.surface.position);
        for (int i = 0; i < model_.spot; ++i) {
            oracle::SpotLight& light = sample.scene.spot.emplace_back();
            aim(light, place(light, sample.surface.position));
        }
        for (int i = 0; i < model_.directional_or_point; ++i)
            sample.scene.directional_or_point.push_back(either_kind(sample.surface.position));
    }

    /// Fog that is thin, thick or in between at the point's distance.
    void fill_fog(oracle::FogParameters& fog, double distance) {
        fog.color = random_.components(0, 1);
        fog.density = std::min(random_.between(0, 3) / distance, 1e3);
        fog.start = distance * random_.between(0, 1.5);
        fog.end = random_.one_in(8) ? fog.start : fog.start + distance * random_.between(0.1, 2);
    }

    /// Radiances around the largest that a 16-bit float holds.
    void scale_beyond_half_float(Sample& sample) {
        const double factor = random_.across(1e4, 1e5);
        for (glm::dvec3* color :
             {&sample.lit_radiance, &sample.scene.material.emission, &sample.scene.fog.color})
            *color *= factor;
    }

    const oracle::Model& model_;
    StageKind stage_;
    bool is_vertex_;
    bool is_along_axis_ = false;
    Random random_;
    const Mesh* mesh_ = nullptr;
    std::vector<glm::dvec3> vertices_;  ///< of the mesh, in eye space
    glm::dvec3 normal_{0};
    glm::dvec3 mirrored_{0};
    double lobe_width_ = 1;
    double nearest_light_ = 0;
    double farthest_light_ = 0;
};

/// Rounds every number to a float.
template <class Value>
void round_to_float(Value& value) {
    if constexpr (std::is_same_v<Value, double>)
        value = static_cast<float>(value);
    else if constexpr (std::is_arithmetic_v<Value>)
        return;  // ints and bools
    else if constexpr (requires { value.begin(); })
        for (auto& element : value) round_to_float(element);
    else if constexpr (kIsNumbers<Value>)
        for (glm::length_t i = 0; i < Value::length(); ++i) round_to_float(value[i]);
    else
        for_each_member<Value>([&](const auto&, auto member) { round_to_float(value.*member); });
}

}  // namespace

std::vector<Sample> make_samples(const oracle::Model& model, StageKind stage, int count, std::uint64_t seed) {
    SampleMaker maker(model, stage, seed);
    std::vector<Sample> samples;
    samples.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) samples.push_back(maker.make());
    return samples;
}

Sample make_draw(const oracle::Model& model, const Mesh& mesh, std::uint64_t seed) {
    return SampleMaker(model, StageKind::vertex, seed).make_draw(mesh);
}

Sample at_vertex(const Sample& draw, const Mesh& mesh, std::size_t vertex) {
    Sample sample = draw;
    sample.object_position = glm::dvec3(mesh.positions[vertex]);
    sample.object_normal = glm::dvec3(mesh.normals[vertex]);
    vary_surface(vertex, sample);
    return sample;
}

Sample rounded_to_float(Sample sample) {
    round_to_float(sample);
    round_to_float(sample.depth);
    round_to_float(sample.surface.opacity);
    round_to_float(sample.surface.cosines);
    round_to_float(sample.scene.maps.depths);
    round_to_float(sample.scene.environment_brdf);
    for (oracle::EvenPicture& picture : sample.scene.pictures)
        for (glm::dvec4* part : {&picture.even, &picture.along_s, &picture.along_t}) round_to_float(*part);
    return sample;
}

std::vector<Sample> rounded_to_float(std::vector<Sample> samples) {
    for (Sample& sample : samples) sample = rounded_to_float(std::move(sample));
    return samples;
}

}  // namespace gobo::verify
