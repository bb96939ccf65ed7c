#include "mesh.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <tuple>

#include <glm/geometric.hpp>

namespace teapot {
namespace {

/// Points at one place are one vertex: the teapot's patches repeat those along their seams.
class Welder {
  public:
    unsigned vertex_at(glm::vec3 position) {
        const auto [found, is_new] = numbers_.try_emplace(std::tuple(position.x, position.y, position.z),
                                                          static_cast<unsigned>(mesh.vertices.size()));
        if (is_new) mesh.vertices.push_back({position, glm::vec3(0)});
        return found->second;
    }
    Mesh mesh;

  private:
    std::map<std::tuple<float, float, float>, unsigned> numbers_;
};

/// The cross product weighs each triangle by its area.
void average_normals(Mesh& mesh) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        Vertex* corners[3];
        for (std::size_t corner = 0; corner < 3; ++corner)
            corners[corner] = &mesh.vertices[mesh.indices[i + corner]];
        const glm::vec3 normal = glm::cross(corners[1]->position - corners[0]->position,
                                            corners[2]->position - corners[0]->position);
        for (Vertex* corner : corners) corner->normal += normal;
    }
    for (Vertex& vertex : mesh.vertices) vertex.normal = glm::normalize(vertex.normal);
}

void place(Mesh& mesh, float height) {
    glm::vec3 low = mesh.vertices.front().position;
    glm::vec3 high = low;
    for (const Vertex& vertex : mesh.vertices) {
        low = glm::min(low, vertex.position);
        high = glm::max(high, vertex.position);
    }
    const glm::vec3 foot((low.x + high.x) / 2, low.y, (low.z + high.z) / 2);
    for (Vertex& vertex : mesh.vertices)
        vertex.position = (vertex.position - foot) * (height / (high.y - low.y));
}

}  // namespace

Mesh read_obj(const std::string& path, float height) {
    std::ifstream file(path);
    std::vector<glm::vec3> positions;
    Welder welder;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "v") {
            glm::vec3& position = positions.emplace_back();
            words >> position.x >> position.y >> position.z;
        } else if (kind == "f") {
            for (std::size_t number = 0; words >> number;)
                welder.mesh.indices.push_back(welder.vertex_at(positions.at(number - 1)));
        }
    }
    if (welder.mesh.indices.empty()) throw std::runtime_error(path + " holds no triangles");
    average_normals(welder.mesh);
    place(welder.mesh, height);
    return std::move(welder.mesh);
}

Mesh floor_tiles(bool odd) {
    constexpr int tiles = 40;
    constexpr int divisions = 4;
    Mesh mesh;
    for (int tile = 0; tile < tiles * tiles; ++tile) {
        const int column = tile % tiles - tiles / 2;
        const int row = tile / tiles - tiles / 2;
        if ((std::abs(column + row) % 2 == 1) != odd) continue;
        for (int cell = 0; cell < divisions * divisions; ++cell) {
            const auto first = static_cast<unsigned>(mesh.vertices.size());
            for (int corner = 0; corner < 4; ++corner) {
                const int x = cell % divisions + corner % 2;
                const int z = cell / divisions + corner / 2;
                const glm::vec3 inside(static_cast<float>(x) / divisions, 0,
                                       static_cast<float>(z) / divisions);
                mesh.vertices.push_back({glm::vec3(column, 0, row) + inside, glm::vec3(0, 1, 0)});
            }
            for (const unsigned corner : {0U, 2U, 1U, 1U, 2U, 3U}) mesh.indices.push_back(first + corner);
        }
    }
    return mesh;
}

Mesh sphere(float radius) {
    constexpr unsigned rings = 16;
    constexpr unsigned sectors = 32;
    constexpr float pi = 3.14159265f;
    Mesh mesh;
    for (unsigned i = 0; i <= rings; ++i) {
        for (unsigned j = 0; j <= sectors; ++j) {
            const float polar = pi * static_cast<float>(i) / rings;
            const float around = 2 * pi * static_cast<float>(j) / sectors;
            const glm::vec3 normal(std::sin(polar) * std::sin(around), std::cos(polar),
                                   std::sin(polar) * std::cos(around));
            mesh.vertices.push_back({radius * normal, normal});
        }
    }
    for (unsigned i = 0; i < rings; ++i) {
        for (unsigned j = 0; j < sectors; ++j) {
            const unsigned at = i * (sectors + 1) + j;
            const unsigned below = at + sectors + 1;
            for (const unsigned corner : {at, below, at + 1, at + 1, below, below + 1})
                mesh.indices.push_back(corner);
        }
    }
    return mesh;
}

}  // namespace teapot
