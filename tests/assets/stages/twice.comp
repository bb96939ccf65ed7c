#version 430 core
layout(local_size_x = 4) in;
layout(std430, binding = 1) buffer Values {
    float values[];
};

void main() {
    values[gl_GlobalInvocationID.x] *= 2.0;
}
