// Unpacks what a corner of a voxel's face carries, lights the face, and hands it to shaders/voxels.glsl. Light is the
// same all over a flat face, so it is worked out here and not for each pixel.
in float voxel_corner;  // corner of the face + 4 * (side + 8 * occlusion, two bits for each of the face's corners)
in float voxel_colour;  // 8 bits a channel, red the highest; below 0: no value
uniform mat3 normalMatrix;
// VTK's names; the scene has three lights, which travel with the camera.
uniform vec3 lightDirectionVC0, lightDirectionVC1, lightDirectionVC2;
uniform vec3 lightColor0, lightColor1, lightColor2;

out vec2 face_position;     // in the face, 0 to 1
flat out vec4 face_colour;  // lit; alpha 0: no value, and the light alone
flat out vec4 face_open;    // how much of the light reaches the face's four corners

vec3 light_on(vec3 normal) {
  return lightColor0 * max(0.0, dot(normal, -lightDirectionVC0)) +
         lightColor1 * max(0.0, dot(normal, -lightDirectionVC1)) +
         lightColor2 * max(0.0, dot(normal, -lightDirectionVC2));
}

// `towards`: from the camera to the corner, in the camera's frame.
void pass_voxel(vec3 towards) {
  int rest = int(voxel_corner + 0.5);
  int corner = rest & 3, side = rest >> 2 & 7, occlusion = rest >> 5;
  face_position = vec2(corner == 1 || corner == 2 ? 1.0 : 0.0, corner >= 2 ? 1.0 : 0.0);
  float sign = (side & 1) == 1 ? 1.0 : -1.0;
  int axis = side >> 1;
  vec3 normal = normalMatrix * vec3(axis == 0 ? sign : 0.0, axis == 1 ? sign : 0.0, axis == 2 ? sign : 0.0);
  // Clear voxels are seen from behind, too.
  if (dot(normal, towards) > 0.0) normal = -normal;
  vec3 light = 0.4 + 0.75 * light_on(normalize(normal));
  int colour = int(max(voxel_colour, 0.0) + 0.5);
  vec3 rgb = vec3(colour >> 16, colour >> 8 & 255, colour & 255) / 255.0;
  face_colour = voxel_colour < 0.0 ? vec4(light, 0.0) : vec4(light * rgb, 1.0);
  face_open = 1.0 - vec4(occlusion & 3, occlusion >> 2 & 3, occlusion >> 4 & 3, occlusion >> 6 & 3) / 3.0;
}
