// A number per vertex as colours. Interpolated before it becomes a colour, so the map's colours appear in their order.
// range_colours[17], no_value_colours[2] (surface, stripes) and pixel_scale are set by ui/layers/mesh_layer.cpp.
in vec2 paint_at_vertex;  // sum of the places in the range over the corners with a value, and their share

const float stripe_spacing = 7.0;  // [px] of the picture, from lower left to upper right

vec3 range_colour(float place) {
  float stop = clamp(place, 0.0, 1.0) * 16.0;
  int lower = min(int(stop), 15);
  return mix(range_colours[lower], range_colours[lower + 1], stop - float(lower));
}

// Striped, so that nobody takes it for a colour of the map in the shade.
vec3 no_value_colour() {
  float across = abs(mod((gl_FragCoord.x - gl_FragCoord.y) / pixel_scale, stripe_spacing) - 0.5 * stripe_spacing);
  return mix(no_value_colours[1], no_value_colours[0], smoothstep(0.3, 1.1, across));
}

vec3 paint_colour() {
  // Divided by their share: corners without a value have no say in the colour.
  return paint_at_vertex.y > 0.5 ? range_colour(paint_at_vertex.x / paint_at_vertex.y) : no_value_colour();
}
