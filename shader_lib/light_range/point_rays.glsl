// Where `lit` takes a ray to a point light: as far as the light reaches. Source: KHR_lights_punctual.

#include <light_range/point_ray>
