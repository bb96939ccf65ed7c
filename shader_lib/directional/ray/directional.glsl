// The direction of a directional light, where there are any: directionalRay().
#include <shading/directional_ray>
