// Lines at 45 degrees, as drawings have them where a part is cut. `place` in pixels; pixel_scale is set by
// ui/layers/section_layer.cpp.
vec3 hatched(vec3 colour, vec2 place) {
  float along = mod((place.x + place.y) / pixel_scale, 9.0);
  float line = 1.0 - smoothstep(0.8, 1.6, min(along, 9.0 - along));
  return mix(colour, vec3(0.36, 0.40, 0.46), line);
}
