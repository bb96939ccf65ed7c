// The normal that the surface is shaded with: its own, or one of a picture. Source: glTF 2.0, 3.9.3.

#include <normal_map/shaded>
