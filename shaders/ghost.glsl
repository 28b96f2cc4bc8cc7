// An object that hides nothing: clear where its surface faces the viewer, denser towards its outline.
// The normal and the position are in the camera's frame.
vec4 ghost(vec3 normal, vec3 position, vec3 colour) {
  float facing = abs(dot(normalize(normal), normalize(position)));
  return vec4(colour, 0.07 + 0.55 * pow(1.0 - facing, 2.5));
}
