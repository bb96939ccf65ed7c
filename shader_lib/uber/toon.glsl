// What all laws of cartoon shading are described by, in one block (L8): with a block for each law an ubershader
// would need more than the 12 of a stage that OpenGL guarantees.
//
// Model:  the N, thresholds and tones of the laws.
// Source: Lighthouse3D's toon tutorial.
// Ranges: levels 1 to 64 (S7); thresholds and tones 0 to 1, the highest threshold first (S8).
// Edges:  as the laws'.

/// The number of bands; cosines, and the tone above each.
BLOCK(7, Toon) {
    int levels;
    vec3 thresholds;
    vec3 tones;
} toon;
