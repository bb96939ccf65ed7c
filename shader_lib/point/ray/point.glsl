// How a point light reaches a vertex, where there are point lights: pointRay().
#include <shading/point_ray>
