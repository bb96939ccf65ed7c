// The surface is opaque (S17 is not asked for).

/// How opaque the vertices' colour is, 0 to 1.
float surfaceAlpha() { return 1.0; }
