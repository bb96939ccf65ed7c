// Where the vertex is, in the space of the object.

ATTRIBUTE(0) vec3 position;
