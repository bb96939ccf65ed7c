// Arrays of blocks take one binding each in Vulkan, here numbers that follow one another.
#version 450
layout(std430, set = 0, binding = 0) readonly buffer Records { vec4 record; } records[3];
layout(std140, set = 0, binding = 1) uniform Tints { vec4 tint; } tints[4];
layout(std140, set = 1, binding = 0) uniform Scales { vec4 scale; } scales[2];
layout(std140, set = 1, binding = 1) uniform Bias { vec4 bias; };
layout(location = 0) out vec4 color;
void main() {
    color = records[2].record + tints[3].tint * scales[1].scale + bias;
}
