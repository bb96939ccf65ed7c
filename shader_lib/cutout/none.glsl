// The surface has no holes (S16 is not asked for).

/// Discards the fragment where the surface has a hole: nowhere.
void cutOut() {}
