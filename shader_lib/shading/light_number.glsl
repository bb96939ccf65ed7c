// Which light is being added (E3): hybrid shading is handed a half vector for each, directional lights first, then
// point lights, then spot lights.
//
// Model:  i among all lights.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Moving Calculations to the Vertex Shader.
// Range:  0 to the number of lights, less 1.
// Edges:  a light is asked for its ray before its half vector.

/// The number of the light that was asked for last.
int lightNumber;
