// Unpacks what a corner of a voxel's face carries, and hands it to shaders/voxels.glsl.
in float voxel_corner;  // corner of the face + 4 * (side + 8 * occlusion, two bits for each of the face's corners)
in float voxel_colour;  // 8 bits a channel, red the highest; below 0: no value
uniform mat3 normalMatrix;

out vec2 face_position;             // in the face, 0 to 1
flat out vec3 face_normal;          // in the camera's frame
flat out vec4 face_colour;          // alpha 0: no value
flat out vec4 face_open;            // light that reaches the face's four corners

void pass_voxel() {
  int rest = int(voxel_corner + 0.5);
  int corner = rest & 3, side = rest >> 2 & 7, occlusion = rest >> 5;
  face_position = vec2(corner == 1 || corner == 2 ? 1.0 : 0.0, corner >= 2 ? 1.0 : 0.0);
  vec3 normal = vec3(0.0);
  normal[side >> 1] = (side & 1) == 1 ? 1.0 : -1.0;
  face_normal = normalize(normalMatrix * normal);
  int colour = int(max(voxel_colour, 0.0) + 0.5);
  face_colour = vec4(vec3(colour >> 16, colour >> 8 & 255, colour & 255) / 255.0, voxel_colour < 0.0 ? 0.0 : 1.0);
  face_open = 1.0 - vec4(occlusion & 3, occlusion >> 2 & 3, occlusion >> 4 & 3, occlusion >> 6 & 3) / 3.0;
}
