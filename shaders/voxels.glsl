// Voxels with edges that stay a pixel or so wide at every zoom, and darker where other voxels keep the light away.
// valueless_colours[2] (surface, stripes), nook_darkness and pixel_scale are set by ui/layers/octree_layer.cpp.
in vec2 face_position;
flat in vec4 face_colour;
flat in vec4 face_open;

const float edge_width = 0.9;  // [px] of the half of an edge that lies in this face
const float edge_darkness = 0.4;
const float stripe_spacing = 7.0;  // [px] of the picture, from lower left to upper right

// 1 on an edge, 0 inside the face. Edges fade out where voxels are but a few pixels large, and would hide their colours.
float edge() {
  vec2 change = max(fwidth(face_position) * pixel_scale, vec2(1e-6));  // per pixel
  vec2 distance = min(face_position, 1.0 - face_position) / change;
  float line = 1.0 - smoothstep(edge_width - 0.5, edge_width + 0.5, min(distance.x, distance.y));
  return line * (1.0 - smoothstep(0.08, 0.3, max(change.x, change.y)));
}

// Between the corners' values: the same whichever way the face is cut into triangles.
float open() {
  vec2 across = mix(face_open.xw, face_open.yz, clamp(face_position.x, 0.0, 1.0));
  float share = mix(across.x, across.y, clamp(face_position.y, 0.0, 1.0));
  return 1.0 - nook_darkness * (1.0 - share);
}

// Striped, so that nobody takes it for a colour of the map in the shade.
vec3 valueless_colour() {
  float across = abs(mod((gl_FragCoord.x - gl_FragCoord.y) / pixel_scale, stripe_spacing) - 0.5 * stripe_spacing);
  return mix(valueless_colours[1], valueless_colours[0], smoothstep(0.3, 1.1, across));
}

vec3 voxel_shade() {
  vec3 colour = face_colour.rgb;
  if (face_colour.a < 0.5) colour *= valueless_colour();
  return colour * (open() * (1.0 - edge_darkness * edge()));
}
