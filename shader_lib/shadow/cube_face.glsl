// The face of a cube that a direction meets, as six layers of an array hold them (S15).
//
// Model:  the face of the largest component; s and t along its sides.
// Source: OpenGL 4.5 core specification, table 8.19, whose faces and senses of s and t these are.
// Space:  any. Range: any vector.
// Edges:  between faces the first of x, y, z is taken, and of two sides the negative one; the zero vector
//         lies on the last face with a size of zero.

/// s and t in xy, the size of the largest component in z: all to be divided by it; in w the face's number.
vec4 cubeFace(vec3 v) {
    vec3 size = abs(v);
    if (size.x >= size.y && size.x >= size.z && size.x > 0.0)
        return v.x > 0.0 ? vec4(-v.z, -v.y, v.x, 0.0) : vec4(v.z, -v.y, -v.x, 1.0);
    if (size.y >= size.z && size.y > 0.0)
        return v.y > 0.0 ? vec4(v.x, v.z, v.y, 2.0) : vec4(v.x, -v.z, -v.y, 3.0);
    return v.z > 0.0 ? vec4(v.x, -v.y, v.z, 4.0) : vec4(-v.x, -v.y, -v.z, 5.0);
}
