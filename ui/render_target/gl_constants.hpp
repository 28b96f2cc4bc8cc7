#pragma once

namespace nextview {

/// What is asked of OpenGL itself, by the names of its specification: VTK keeps its header to itself.
inline constexpr unsigned int gl_back = 0x0405, gl_linear = 0x2601, gl_unsigned_byte = 0x1401, gl_rgba = 0x1908,
                              gl_renderer = 0x1F01, gl_nearest = 0x2600, gl_color_buffer_bit = 0x4000,
                              gl_depth_buffer_bit = 0x0100, gl_point_sprite_coord_origin = 0x8CA0,
                              gl_upper_left = 0x8CA2, gl_read_framebuffer = 0x8CA8, gl_draw_framebuffer = 0x8CA9;

}  // namespace nextview
