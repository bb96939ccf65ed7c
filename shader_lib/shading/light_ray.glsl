// How a light reaches the surface: from which side, and how much of it (L3, L4, L5).
//
// Model:  s, the attenuation, and the share.
// Source: OpenGL Programming Guide, 9th ed., ch. 7, Point Lights, Spotlights.
// Space:  eye. Ranges: fading and share 0 to 1e18.
// Edges:  a direction of zero is a light from nowhere (H-L1).

/// The direction to the light, unit where the key has directions made so (zero: from nowhere); its attenuation,
/// by which its own ambient light fades; and the share of its light that arrives, its cone counted in.
struct LightRay {
    vec3 toLight;
    float fading;
    float share;
};
