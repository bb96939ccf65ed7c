// The number of tones of cartoon shading in bands (S7).
//
// Range:  1 to 64.

/// The number of tones.
BLOCK(7, Toon) {
    int levels;
} toon;
