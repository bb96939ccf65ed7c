// The depth of the surface itself, tested whenever the driver likes (D1).

/// Writes the fragment's depth: left to the driver.
void writeDepth() {}
