// Hands a vertex's class to shaders/mesh_classes.glsl: 1 for its class, 0 for the others.
in vec4 class_weights;
out vec4 class_weights_at_vertex;

void pass_paint() { class_weights_at_vertex = class_weights; }
