// Arrays of blocks take one binding each in Vulkan, here numbers that follow one another; and one descriptor of each other kind.
#version 450
layout(std430, set = 0, binding = 0) readonly buffer Records { vec4 record; } records[3];
layout(std140, set = 0, binding = 1) uniform Tints { vec4 tint; } tints[4];
layout(std140, set = 1, binding = 0) uniform Scales { vec4 scale; } scales[2];
layout(std140, set = 1, binding = 1) uniform Bias { vec4 bias; };
layout(set = 2, binding = 0) uniform sampler2D maps[5];
layout(set = 2, binding = 1) uniform texture2D plain;
layout(set = 2, binding = 2) uniform sampler filtering;
layout(set = 2, binding = 3, rgba8) readonly uniform image2D grid;
layout(set = 2, binding = 4) uniform samplerBuffer row;
layout(set = 2, binding = 5, r32f) readonly uniform imageBuffer noise;
layout(input_attachment_index = 0, set = 2, binding = 6) uniform subpassInput drawn;
layout(push_constant) uniform Pushed { vec4 tilt; float gain; } pushed;
layout(location = 0) out vec4 color;
void main() {
    color = records[2].record + tints[3].tint * scales[1].scale + bias;
    color += texture(maps[4], color.xy) + texture(sampler2D(plain, filtering), color.xy) + imageLoad(grid, ivec2(0));
    color += texelFetch(row, 0) + imageLoad(noise, 0) + subpassLoad(drawn) + pushed.tilt * pushed.gain;
}
