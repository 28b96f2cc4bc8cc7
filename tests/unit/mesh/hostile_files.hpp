#pragma once
#include <cmath>
#include <string>

#include "tests/unit/mesh/tetrahedron_files.hpp"

/// Files that ask for more than they are worth, each made here byte by byte.
namespace nextview::hostile_files {

/// The tetrahedron as a glTF whose numbers lie in the file of this name.
inline std::string gltf_with_buffer(const std::string& uri) {
  return tetrahedron_files::gltf("\"uri\": \"" + uri + "\", ", R"([{"mesh": 0}])");
}

/// `levels` nodes, each of which has the next one twice as a child: 2^levels tetrahedra.
inline std::string gltf_doubling(int levels) {
  std::string nodes = "[";
  for (int i = 1; i <= levels; ++i) nodes += "{\"children\": [" + std::to_string(i) + ", " + std::to_string(i) + "]}, ";
  return tetrahedron_files::gltf(R"("uri": "buffer.bin", )", nodes + R"({"mesh": 0}])");
}

/// One triangle; the file says how many numbers and triangles it has.
inline std::string dae(const std::string& numbers = "9", const std::string& triangles = "1") {
  return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset/>)"
         R"(<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count=")" +
         numbers +
         R"(">0 0 0 1 0 0 0 1 0</float_array><technique_common><accessor source="#a" count="3" stride="3">)"
         R"(<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>)"
         R"(</technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>)"
         R"(<triangles count=")" +
         triangles +
         R"("><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry>)"
         R"(</library_geometries><library_visual_scenes><visual_scene id="s"><node id="n">)"
         R"(<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>)"
         R"(<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

/// One star-shaped face, an OBJ: cutting it into triangles takes time with the square of its corners, and more.
inline std::string obj_with_huge_face(int corners) {
  std::string vertices, face = "f";
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * M_PI * i / corners, radius = i % 2 ? 1.5 : 1.0;
    vertices +=
        "v " + std::to_string(radius * std::cos(angle)) + " " + std::to_string(radius * std::sin(angle)) + " 0\n";
    face += " " + std::to_string(i + 1);
  }
  return vertices + face + "\n";
}

}  // namespace nextview::hostile_files
