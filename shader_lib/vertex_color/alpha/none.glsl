// The surface is opaque.

/// How opaque the vertices' colour is, 0 to 1.
float surfaceAlpha() { return 1.0; }
