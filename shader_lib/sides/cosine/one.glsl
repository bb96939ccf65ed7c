// A cosine to the surface's normal, from wherever the surface is seen (S1; S11 is not asked for).

/// The cosine as it is.
float cosineOfSide(float cosine) { return cosine; }
