#version 450
// Values that are filled part by part, and only then read.
layout(location = 0) in vec3 light;
layout(location = 0) out vec4 color;

struct Surface {
    vec3 diffuse;
    float weight;
};

Surface surfaceOf(vec3 radiance) {
    Surface surface;
    surface.diffuse.xy = radiance.xy;
    surface.diffuse.z = 0.5 * radiance.z;
    if (radiance.x > 1.0)
        surface.weight = 1.0;
    else
        surface.weight = 0.5;
    return surface;
}

void main() {
    Surface surface = surfaceOf(light);
    vec3 samples[3];
    for (int i = 0; i < 3; ++i) samples[i] = light * float(i);
    vec3 total = vec3(0.0);
    for (int i = 0; i < 3; ++i) total += samples[i] * surface.weight;
    color.rgb = total + surface.diffuse;
    color.a = 1.0;
}
