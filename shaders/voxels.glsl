// Voxels by class or by probability, with edges that stay a pixel or so wide at every zoom.
// class_colours[3], probability_colours[9] and by_probability are set by ui/layers/octree_layer.cpp.
in vec4 voxel_at_vertex;  // position in the face (u, v), probability, class

const float edge_width = 0.9;     // [px] of the half of an edge that lies in this face
const float edge_darkness = 0.4;

vec3 probability_colour(float probability) {
  float stop = clamp(probability, 0.0, 1.0) * 8.0;
  int lower = min(int(stop), 7);
  return mix(probability_colours[lower], probability_colours[lower + 1], stop - float(lower));
}

// 1 on an edge, 0 inside the face. Edges fade out where voxels are but a few pixels large, and would hide their colours.
float edge() {
  vec2 position = voxel_at_vertex.xy;
  vec2 change = max(fwidth(position), vec2(1e-6));  // per pixel
  vec2 distance = min(position, 1.0 - position) / change;
  float line = 1.0 - smoothstep(edge_width - 0.5, edge_width + 0.5, min(distance.x, distance.y));
  return line * (1.0 - smoothstep(0.08, 0.3, max(change.x, change.y)));
}

vec3 voxel_colour() {
  vec3 colour = by_probability == 1 ? probability_colour(voxel_at_vertex.z) : class_colours[int(voxel_at_vertex.w + 0.5)];
  return colour * (1.0 - edge_darkness * edge());
}
