// The number of tones of cartoon shading in bands (S7).
//
// Model:  the N of N tones.
// Source: Lighthouse3D's toon tutorial; OpenGL 4 Shading Language Cookbook, ch. 2.
// Range:  1 to 64.
// Edges:  1 is a single tone.

/// The number of tones.
BLOCK(7, Toon) {
    int levels;
} toon;
