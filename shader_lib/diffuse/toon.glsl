// Diffuse light in bands of equal tone, as in a cartoon (S7).
//
// Model:  floor(N c) / N for N levels, at most (N - 1) / N.
// Source: OpenGL 4 Shading Language Cookbook, ch. 3, Creating a Cartoon Shading Effect.
// Range:  cosine above 0, levels 1 to 64; result 0 to (N - 1) / N.
// Edges:  a cosine of 1 or a rounding above it is in the top band, not in one more (H-T1); within an ulp of
//         k / N it is one of the two neighbouring bands (H-T2).

/// The number of tones, black among them.
BLOCK(7, Toon) {
    int levels;
} toon;

/// The scattered share of a light that arrives at an angle of the given cosine to the normal.
float diffuseFactor(float cosine) {
    float levels = float(toon.levels);
    return min(floor(levels * cosine), levels - 1.0) / levels;  // H-T1
}
