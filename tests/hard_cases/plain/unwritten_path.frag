#version 450
// A colour that only those who look get.
layout(location = 0) in float cosine;
layout(location = 0) out vec4 color;

void main() {
    if (cosine > 0.0) {
        color = vec4(cosine);  // trap: the output 'color' is not written on some path
    }
}
