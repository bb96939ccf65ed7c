// Where `lit` takes a ray to a spot light: as far as the light reaches. Source: KHR_lights_punctual.

#include <light_range/spot_ray>
