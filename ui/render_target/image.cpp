#include "ui/render_target/image.hpp"

#include <fmt/format.h>
#include <stb/stb_image.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "core/file/atomic_file.hpp"
#include "core/file/png_text.hpp"
#include "ui/render_target/png_chunk.hpp"

namespace nextview {
namespace {

/// VTK's rows go from bottom to top.
vtkNew<vtkImageData> to_vtk(const Image& image, int channels) {
  vtkNew<vtkImageData> result;
  result->SetDimensions(image.width, image.height, 1);
  result->AllocateScalars(VTK_UNSIGNED_CHAR, channels);
  auto* target = static_cast<std::uint8_t*>(result->GetScalarPointer());
  for (int y = image.height; y-- > 0;) {
    const std::uint8_t* const row = &image.rgba[std::size_t(y) * image.width * 4];
    if (channels == 4)
      target = std::copy_n(row, std::size_t(image.width) * 4, target);
    else
      for (int x = 0; x < image.width; ++x) target = std::copy_n(row + std::size_t(x) * 4, channels, target);
  }
  return result;
}

/// Of zlib's 1 to 9. VTK's own, 5, takes more than twice as long, for files that are a tenth smaller.
constexpr int compression_level = 2;
constexpr std::size_t end_of_header = 33;  // signature and first chunk, IHDR [bytes]

/// VTK's writer does not write it.
std::string resolution_chunk(double dpi) {
  const std::string pixels_per_metre = png_number(std::uint32_t(std::lround(dpi / 0.0254)));
  return png_chunk("pHYs" + pixels_per_metre + pixels_per_metre + png_number(1, 1));  // 1: the unit is the metre
}

}  // namespace

Image side_by_side(const Image& left, const Image& right) {
  Image both{left.width + right.width, left.height, {}};
  both.rgba.reserve(left.rgba.size() + right.rgba.size());
  for (int y = 0; y < both.height; ++y)
    for (const Image* half : {&left, &right}) {
      const auto row = half->rgba.begin() + std::ptrdiff_t(4) * half->width * y;
      both.rgba.insert(both.rgba.end(), row, row + std::ptrdiff_t(4) * half->width);
    }
  return both;
}

std::string png_bytes(const Image& image, const std::string& configuration, int channels) {
  vtkNew<vtkPNGWriter> writer;
  writer->WriteToMemoryOn();
  writer->SetCompressionLevel(compression_level);
  writer->SetInputData(to_vtk(image, channels));
  if (!configuration.empty()) writer->AddText(png_configuration_keyword, configuration.c_str());
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  return {reinterpret_cast<const char*>(bytes->GetPointer(0)), std::size_t(bytes->GetNumberOfValues())};
}

void write_png(const Image& image, const std::filesystem::path& file, const std::string& configuration, double dpi) {
  if (image.rgba.empty()) throw std::runtime_error(fmt::format("{}: the picture is empty", file.string()));
  std::string bytes = png_bytes(image, configuration);
  if (dpi > 0.0) bytes.insert(end_of_header, resolution_chunk(dpi));
  write_file(file, bytes);
}

Image read_png(const std::filesystem::path& file) {
  const auto cannot_read = [&](const std::string& reason) {
    return std::runtime_error(fmt::format("{}: cannot read the picture: {}", file.string(), reason));
  };
  if (!std::filesystem::is_regular_file(file)) throw cannot_read("no such file");
  // stb's reader and not VTK's, which ends the program when a file is truncated.
  Image image;
  int channels = 0;
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
      stbi_load(file.c_str(), &image.width, &image.height, &channels, 4), stbi_image_free);
  if (!pixels) throw cannot_read(stbi_failure_reason());
  image.rgba.assign(pixels.get(), pixels.get() + std::size_t(image.width) * image.height * 4);
  return image;
}

}  // namespace nextview
