// Triangles with normals: the teapot from its file, the floor and the lamp by formula.
#pragma once

#include <string>
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

/// Reads the positions and triangles of an OBJ file; normals are averaged over the triangles around a point.
/// The mesh stands on y = 0, centred, of the given height. Throws std::runtime_error if there is no mesh.
Mesh read_obj(const std::string& path, float height);

/// The tiles of one colour of a chequered floor at y = 0: squares of size 1 whose column and row add up to an
/// even number, or to an odd one. Each is divided further, so that lights computed per vertex look right.
Mesh floor_tiles(bool odd);

/// A sphere around the origin.
Mesh sphere(float radius);

}  // namespace teapot
