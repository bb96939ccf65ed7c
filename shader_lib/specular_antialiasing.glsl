// Highlights where normals turn within a pixel: without more they flicker.

#piece none
/// The width of the slopes that a pixel shows of a surface of width `alpha`: that width.
float widenedAlpha(float alpha) { return alpha; }

#piece widened
// alpha^2 + min(2 V, 0.18), V = (|dn/dx|^2 + |dn/dy|^2) / (2 pi) the variance of the mesh's normals over the pixel's filter.
// Source: Tokuyoshi, Kaplanyan, Improved Geometric Specular Antialiasing, I3D 2019; the constants are theirs.
/// The width of the slopes that a pixel shows of a surface of width `alpha`.
float widenedAlpha(float alpha) {
    vec3 alongX = dFdx(eyeNormal);
    vec3 alongY = dFdy(eyeNormal);
    float kernel = min(0.31830987 * (dot(alongX, alongX) + dot(alongY, alongY)), 0.18);
    return sqrt(min(alpha * alpha + kernel, 1.0));
}
