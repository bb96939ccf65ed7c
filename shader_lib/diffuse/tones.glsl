// The thresholds and tones of cartoon shading in three tones (S8).
//
// Model:  the thresholds and tones.
// Source: Lighthouse3D's toon tutorial.
// Range:  0 to 1, the highest threshold first.
// Edges:  below the last threshold there is no tone; a threshold of 0 is exceeded by every light in front.

/// Cosines, the highest first (0.95, 0.5, 0.25), and the tone above each (1, 0.6, 0.4).
BLOCK(14, ToonThresholds) {
    vec3 thresholds;
    vec3 tones;
} toon;
