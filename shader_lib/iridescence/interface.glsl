// What becomes of light at the surface, with the film that may lie on it. Source: KHR_materials_iridescence.

#include <iridescence/reflected>
