#version 430 core
#extension GL_ARB_gpu_shader_int64 : require
struct Particle {
    vec3 position;
    float mass;
    vec2 tint;
    bool awake;
};
layout(std430, binding = 1) buffer Particles {
    uint count;
    bool awake;
    Particle first;
    Particle particles[];
};
layout(std140, binding = 2) readonly buffer Table {
    float cells[4];
    mat2 turn;
    Particle last;
};
layout(std430, binding = 5) readonly buffer Samples {
    mat3 turns[2];
    bool on[3];
    float samples[];
} samples;
layout(std430, binding = 6) readonly buffer Wide {
    int64_t least;
    u64vec3 most;
    uint64_t masks[];
};
#ifdef HEAVY
#define SHADOWS 3
#else
#define SHADOWS 2
#endif
layout(std140) uniform Shadows {
    mat4 view;
#ifdef HEAVY
    vec4 bias;
#endif
} shadows[SHADOWS];
out vec4 color;

void main() {
    vec2 sum = first.tint + last.tint + turn * vec2(cells[0], cells[3]);
    if (awake && particles[count].awake) sum += particles[count].tint;
#ifdef HEAVY
    sum *= particles[count].mass * shadows[2].view[0].x * shadows[2].bias.x;
#endif
    if (samples.on[1]) sum += (samples.turns[1] * particles[0].position).xy * samples.samples[2];
    if (masks[1] > most.y && least < 0L) sum += vec2(1.0);
    color = vec4(sum, 0.0, 1.0) * (shadows[0].view + shadows[1].view);
}
