// A class a vertex as colours: each place takes the class that weighs most there, so that no triangle shows a mixture
// that the legend does not know. mesh_class_colours[4] is set by ui/layers/mesh_layer.cpp.
in vec4 class_weights_at_vertex;

vec3 paint_colour() {
  vec4 weights = class_weights_at_vertex, change = fwidth(weights);
  int first = 0, second = 1;
  for (int i = 1; i < 4; ++i) {
    if (weights[i] > weights[first]) {
      second = first;
      first = i;
    } else if (i != first && (second == first || weights[i] > weights[second])) {
      second = i;
    }
  }
  // The border itself is a pixel wide, so that it is not jagged.
  float lead = (weights[first] - weights[second]) / max(change[first] + change[second], 1e-6);
  return mix(mesh_class_colours[second], mesh_class_colours[first], min(0.5 + lead, 1.0));
}
