// The fragment stage of the depth pass: the depth that the rasteriser gives is all that is wanted. Polygon
// offset belongs to the pass, not to the shader, which knows no slope.

void main() {}
