// What an ubershader does, chosen at run time (L8).
//
// Model:  a number for each choice.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Multiple Lights and Materials, for switches in uniforms.
// Range:  each the number of a value of the feature of that name, from 0, as the family `lit` lists them; of
//         a kind of light, how many there are.
// Edges:  an unknown number is the default of its feature.

/// Which value of each feature is meant.
BLOCK(22, Switches) {
    int ambient;
    int cutout;
    int diffuse;
    int directional;
    int fog;
    int homogeneous;
    int light_ambient;
    int lighting;
    int material;
    int point;
    int reflection;
    int sides;
    int specular;
    int spot;
    int vertex_color;
} switches;
