// Which side of the surface is asked for, in the vertex stage, where both are shaded (S11).

/// Set to ask for the back's radiance.
bool backIsAsked = false;

/// Whether the surface's back is seen.
bool isBackVisible() { return backIsAsked; }
