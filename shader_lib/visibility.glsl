// Visibility V = G / (4 n.l n.v): how much of the microfacets light and viewer both see. Results up to 2.5e6.

#piece correlated
// Smith's shadowing and masking, correlated by height: 1 / (2 (n.l sqrt(a^2 + (1 - a^2) (n.v)^2) + n.v sqrt(a^2 + (1 - a^2) (n.l)^2))).
// Source: Heitz, Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, JCGT 3 (2014), eq. 99; glTF 2.0,
//         appendix B.3.
/// V at the cosines `nl`, above 0, to the light and `nv` to the viewer.
float visibilityTerm(float alpha, float nl, float nv, float square) {
    float a2 = alpha * alpha;
    float masking = nl * sqrt(a2 + (1.0 - a2) * nv * nv);
    float shadowing = nv * sqrt(a2 + (1.0 - a2) * nl * nl);
    return 0.5 / (masking + shadowing);
}

#piece interpolated
// Without the square roots: 1 / (2 mix(2 n.l n.v, n.l + n.v, a)), exact at alpha 0 and 1.
// Source: Hammon, PBR Diffuse Lighting for GGX+Smith Microsurfaces, GDC 2017.
/// V at the cosines `nl`, above 0, to the light and `nv` to the viewer.
float visibilityTerm(float alpha, float nl, float nv, float square) { return 0.5 / mix(2.0 * nl * nv, nl + nv, alpha); }

#piece half_angle
// 1 / (4 (l.h)^2) = 1 / |l + v|^2: one division, too bright at grazing angles.
// Source: Kelemen, Szirmay-Kalos, A Microfacet Based Coupled Specular-Matte BRDF Model with Importance Sampling, Eurographics
//         2001, eq. 10, in its simplest form.
/// V where the sum of the directions to light and viewer has the squared length `square`.
float visibilityTerm(float alpha, float nl, float nv, float square) {
    return 1.0 / max(square, 1e-4);  // guard: light nearly behind the viewer's ray
}
