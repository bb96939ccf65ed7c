#include "scene_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

namespace teapot {
namespace {

using Json = nlohmann::json;

std::string content_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error("there is no " + path);
    std::ostringstream content;
    content << file.rdbuf();
    return content.str();
}

glm::vec3 vector_of(const Json& numbers) {
    return {numbers.at(0), numbers.at(1), numbers.at(2)};
}

glm::vec3 vector_of(const Json& object, const char* name, glm::vec3 otherwise) {
    return object.contains(name) ? vector_of(object.at(name)) : otherwise;
}

/// The members that glTF has no words for; empty where there are none.
Json gobo_extras(const Json& object) {
    return object.value("extras", Json::object()).value("gobo", Json::object());
}

template <class Enum>
Enum named(const std::string& name, const std::map<std::string, Enum>& values) {
    const auto found = values.find(name);
    if (found == values.end()) throw std::runtime_error("this program knows no '" + name + "'");
    return found->second;
}

glm::mat4 transform_of(const Json& node) {
    glm::quat rotation(1, 0, 0, 0);
    if (const auto r = node.find("rotation"); r != node.end())
        rotation = glm::quat(r->at(3), r->at(0), r->at(1), r->at(2));
    const glm::mat4 moved = glm::translate(glm::mat4(1), vector_of(node, "translation", glm::vec3(0)));
    return glm::scale(moved * glm::mat4_cast(rotation), vector_of(node, "scale", glm::vec3(1)));
}

/// The file's buffers, and the arrays in them.
class Arrays {
  public:
    Arrays(const Json& file, const std::string& folder) : file_(file) {
        for (const Json& buffer : file.at("buffers"))
            contents_.push_back(content_of(folder + buffer.at("uri").get<std::string>()));
    }
    std::vector<glm::vec3> vectors(int accessor) const { return read<glm::vec3>(accessor); }
    /// Indices are 16 bits wide in these files.
    std::vector<unsigned> indices(int accessor) const {
        const std::vector<std::uint16_t> narrow = read<std::uint16_t>(accessor);
        return {narrow.begin(), narrow.end()};
    }

  private:
    template <class Value>
    std::vector<Value> read(int number) const {
        const Json& accessor = file_.at("accessors").at(static_cast<std::size_t>(number));
        const Json& view = file_.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
        const std::string& bytes = contents_.at(view.at("buffer").get<std::size_t>());
        std::vector<Value> values(accessor.at("count").get<std::size_t>());
        const auto offset = view.value("byteOffset", std::size_t{0});
        if (offset + values.size() * sizeof(Value) > bytes.size())
            throw std::runtime_error("an accessor reaches beyond its buffer");
        std::memcpy(values.data(), bytes.data() + offset, values.size() * sizeof(Value));
        return values;
    }

    const Json& file_;
    std::vector<std::string> contents_;
};

Mesh mesh_of(const Json& primitive, const Arrays& arrays) {
    const std::vector<glm::vec3> positions = arrays.vectors(primitive.at("attributes").at("POSITION"));
    const std::vector<glm::vec3> normals = arrays.vectors(primitive.at("attributes").at("NORMAL"));
    Mesh mesh;
    for (std::size_t i = 0; i < positions.size(); ++i) mesh.vertices.push_back({positions[i], normals.at(i)});
    mesh.indices = arrays.indices(primitive.at("indices"));
    return mesh;
}

/// The mesh once for each place where EXT_mesh_gpu_instancing puts it.
Mesh instanced(const Mesh& mesh, const Json& node, const Arrays& arrays) {
    const Json extensions = node.value("extensions", Json::object());
    const auto found = extensions.find("EXT_mesh_gpu_instancing");
    if (found == extensions.end()) return mesh;
    Mesh all;
    for (const glm::vec3& place : arrays.vectors(found->at("attributes").at("TRANSLATION"))) {
        const auto first = static_cast<unsigned>(all.vertices.size());
        for (const Vertex& vertex : mesh.vertices)
            all.vertices.push_back({place + vertex.position, vertex.normal});
        for (const unsigned index : mesh.indices) all.indices.push_back(first + index);
    }
    return all;
}

/// The reflection model as `extras.gobo.model` states it, and what the surface emits.
lit::Material material_of(const Json& material) {
    const Json model = gobo_extras(material).at("model");
    lit::Material block{};
    block.diffuse = vector_of(model.at("diffuse"));
    block.ambient = vector_of(model, "ambient", block.diffuse);
    block.specular = vector_of(model.at("specular"));
    block.strength = model.value("strength", 1.0F);
    block.shininess = model.value("shininess", 0.0F);
    const Json strength =
        material.value("extensions", Json::object()).value("KHR_materials_emissive_strength", Json::object());
    block.emission =
        strength.value("emissiveStrength", 1.0F) * vector_of(material, "emissiveFactor", glm::vec3(0));
    return block;
}

Light light_of(const Json& light, const glm::mat4& world) {
    Light result;
    result.kind = named<Light::Kind>(light.at("type"), {{"directional", Light::Kind::directional},
                                                        {"point", Light::Kind::point},
                                                        {"spot", Light::Kind::spot}});
    result.color = light.value("intensity", 1.0F) * vector_of(light, "color", glm::vec3(1));
    const Json cone = light.value("spot", Json::object());
    result.inner_angle = cone.value("innerConeAngle", 0.0F);
    result.outer_angle = cone.value("outerConeAngle", 0.7853982F);
    const Json extras = gobo_extras(light);
    result.attenuation = vector_of(extras, "attenuation", result.attenuation);
    result.exponent = extras.value("exponent", 0.0F);
    result.position = world[3];
    result.shines_along = -glm::normalize(glm::vec3(world[2]));
    return result;
}

void read_camera(const Json& camera, const glm::mat4& world, Scene& scene) {
    const Json& perspective = camera.at("perspective");
    scene.view = glm::inverse(world);
    scene.vertical_angle = perspective.at("yfov");
    scene.near_plane = perspective.at("znear");
    scene.far_plane = perspective.at("zfar");
}

/// What the scene itself says: fog, tones, highlights, quality, and the light that is everywhere.
void read_look(const Json& gobo, Scene& scene) {
    scene.ambient = vector_of(gobo, "ambient", glm::vec3(0));
    scene.background = vector_of(gobo, "background", glm::vec3(0));
    const Json fog = gobo.value("fog", Json{{"kind", "none"}});
    scene.fog.color = vector_of(fog, "color", glm::vec3(0));
    scene.fog.density = fog.value("density", 0.0F);
    scene.fog.start = fog.value("near", 0.0F);
    scene.fog.end = fog.value("far", 0.0F);
    scene.look.fog =
        named<lit::Fog>(fog.at("kind"), {{"none", lit::Fog::none},
                                         {"linear", lit::Fog::linear},
                                         {"exponential", lit::Fog::exponential},
                                         {"exponential_squared", lit::Fog::exponential_squared}});
    const int levels = gobo.value("toon", 0);
    scene.toon.levels = static_cast<float>(std::max(levels, 1));
    if (levels > 0) scene.look.diffuse = lit::Diffuse::toon;
    scene.look.specular = named<lit::Specular>(
        gobo.value("specular", "blinn"),
        {{"none", lit::Specular::none}, {"phong", lit::Specular::phong}, {"blinn", lit::Specular::blinn}});
    const Json quality = gobo.value("quality", Json::object());
    scene.look.shading =
        named<lit::Shading>(quality.value("shading", "fragment"),
                            {{"fragment", lit::Shading::fragment}, {"vertex", lit::Shading::vertex}});
}

/// Roots alone: these files have no hierarchies.
void read_node(const Json& file, const Json& node, const Arrays& arrays, Scene& scene) {
    const glm::mat4 world = transform_of(node);
    if (node.contains("mesh")) {
        for (const Json& primitive :
             file.at("meshes").at(node.at("mesh").get<std::size_t>()).at("primitives")) {
            const Json& material = file.at("materials").at(primitive.at("material").get<std::size_t>());
            scene.parts.push_back(
                {instanced(mesh_of(primitive, arrays), node, arrays), world, material_of(material)});
        }
    }
    if (node.contains("camera"))
        read_camera(file.at("cameras").at(node.at("camera").get<std::size_t>()), world, scene);
    const Json extensions = node.value("extensions", Json::object());
    if (const auto found = extensions.find("KHR_lights_punctual"); found != extensions.end()) {
        const Json& lights = file.at("extensions").at("KHR_lights_punctual").at("lights");
        scene.lights.push_back(light_of(lights.at(found->at("light").get<std::size_t>()), world));
    }
}

}  // namespace

Scene read_scene(const std::string& path) {
    const auto slash = path.rfind('/');
    const std::string folder = slash == std::string::npos ? "" : path.substr(0, slash + 1);
    try {
        const Json file = Json::parse(content_of(path));
        const Arrays arrays(file, folder);
        const Json& scene_json = file.at("scenes").at(file.value("scene", std::size_t{0}));
        Scene scene;
        read_look(gobo_extras(scene_json), scene);
        for (const Json& node : scene_json.at("nodes"))
            read_node(file, file.at("nodes").at(node.get<std::size_t>()), arrays, scene);
        return scene;
    } catch (const Json::exception& error) {
        throw std::runtime_error(path + ": " + error.what());
    }
}

}  // namespace teapot
