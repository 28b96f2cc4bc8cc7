// Hands a vertex's paint to shaders/mesh_paint.glsl: (place in the range from 0 to 1, 1), or (0, 0) without a value.
in vec2 paint;
out vec2 paint_at_vertex;

void pass_paint() { paint_at_vertex = paint; }
