// The surface has no holes.

/// Discards the fragment where the surface has a hole: nowhere.
void cutOut() {}
