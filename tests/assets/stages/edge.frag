#version 430 core
in Corner {
    vec2 place;
    vec3 distances;
} corner;

float edge() {
    return min(min(corner.distances.x, corner.distances.y), corner.distances.z);
}
