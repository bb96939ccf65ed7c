#version 450
// outside the shadow map: a shadow looked up behind the light, and beside it.
layout(location = 0) in vec4 onMap;
uniform sampler2D shadowMap;
layout(location = 0) out vec4 color;

void main() {
    vec3 place = onMap.xyz / onMap.w;  // trap: division by zero
    float nearest = texture(shadowMap, place.xy).r;
    color = vec4(place.z <= nearest ? 1.0 : 0.0);  // wrong at onMap = (-0.5, -0.5, -0.5, -1); shadowMap = (0, 0, 0, 0): 0, not 1
}
