// Which light is being added: hybrid shading is handed a half vector for each, directional lights first, then
// point lights, then spot lights.

/// The number of the light that was asked for last.
int lightNumber;
