// Depth images of every kind, as frames, as masks, and as a session or a driver has them.
#include "core/file/npy_file.hpp"
#include "core/recording/depth_image_file.hpp"
#include "tests/fuzz/fuzzed_input.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nextview;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto file = fuzzed_file(bytes.starts_with("\x1f\x8b") ? "image.gz" : "image", bytes);
  const PinholeCamera intrinsics{0, 0, 10.0, 10.0, 2.0, 1.5};
  const DepthFormat plain{.width = 4, .height = 3};
  const DepthFormat rotated{.width = 3,
                            .height = 2,
                            .type = RawType::float32,
                            .offset = 8,
                            .measures = DepthMeasures::range,
                            .zero = ZeroDepth::beyond,
                            .encoding = DepthEncoding::rotate3};
  for (const DepthFormat& format : {plain, rotated})
    is_read([&] {
      const DepthImage image = read_depth_image(file, format, intrinsics);
      require(image.range.size() == std::size_t(image.camera.width) * std::size_t(image.camera.height),
              "a range a pixel");
      for (const float range : image.range) require(!(range < 0.0f), "no range is negative");
    });
  is_read([&] { read_mask(file); });
  is_read([&] { read_npy(file); });
  return 0;
}
