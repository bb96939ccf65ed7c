// A cosine to the surface's normal, from wherever the surface is seen.

/// The cosine as it is.
float cosineOfSide(float cosine) { return cosine; }
