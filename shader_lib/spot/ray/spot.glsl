// How a spot light reaches a vertex, where there are spot lights: spotRay().
#include <shading/spot_ray>
