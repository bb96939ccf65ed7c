#version 450
// grazing shadow: a slope seen from the light, as texels of its map hold it: it shades itself.
layout(location = 0) in float along;
uniform float slope;
uniform float texels;
layout(location = 0) out vec4 color;

void main() {
    float count = max(texels, 1.0);
    float middle = (floor(along * count) + 0.5) / count;
    color = vec4(slope * along <= slope * middle ? 1.0 : 0.0);  // wrong at along = 0.24; slope = 8; texels = 4: 0, not 1
}
