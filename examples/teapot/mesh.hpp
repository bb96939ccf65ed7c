// Triangles with normals.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

namespace teapot {

struct Vertex {
    glm::vec3 position;
    glm::vec3 normal;
};

struct Mesh {
    std::vector<Vertex> vertices;
    std::vector<unsigned> indices;
};

}  // namespace teapot
