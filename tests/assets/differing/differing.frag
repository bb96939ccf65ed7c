#version 330 core
layout(std140) uniform Material {
#ifdef GLOW
    vec4 glow;
#endif
    vec4 tint;
};
#ifdef COMPARE
uniform sampler2DShadow shadow;
#else
uniform sampler2D shadow;
#endif
#if LIGHTS > 0
struct Light {
    vec3 direction;
#ifdef GLOW
    float halo;
#endif
};
uniform Light lights[LIGHTS];
uniform float weights[LIGHTS];
uniform sampler2D masks[LIGHTS];
#endif
uniform mat3 turn;
uniform bool inverted;
in vec4 vertexColor;
out vec4 fragmentColor;

void main() {
    vec3 sum = turn * tint.rgb;
#ifdef COMPARE
    sum *= texture(shadow, vec3(0.5));
#else
    sum *= texture(shadow, vec2(0.5)).rgb;
#endif
#if LIGHTS > 0
    sum += weights[0] * lights[0].direction * texture(masks[0], vec2(0.5)).rgb;
#if LIGHTS > 1
    sum += weights[1] * lights[1].direction * texture(masks[1], vec2(0.5)).rgb;
#endif
#if LIGHTS > 2
    sum += weights[2] * lights[2].direction * texture(masks[2], vec2(0.5)).rgb;
#endif
#ifdef GLOW
    sum += lights[LIGHTS - 1].halo;
#endif
#endif
#ifdef GLOW
    sum += glow.rgb;
#endif
    if (inverted) sum = vec3(1.0) - sum;
    fragmentColor = vec4(sum, 1.0) * vertexColor;
}
