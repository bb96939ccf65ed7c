// The surface is lit: litSurface() is the whole lighting model (L7).
#include "lighting/radiance.glsl"
