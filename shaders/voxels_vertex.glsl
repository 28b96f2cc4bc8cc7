// Hands a voxel's attributes to shaders/voxels.glsl: position in the face (u, v), probability, class.
in vec4 voxel;
out vec4 voxel_at_vertex;

void pass_voxel() { voxel_at_vertex = voxel; }
