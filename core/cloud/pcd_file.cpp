// PCL's own writer is in its io library, which links VTK's readers and writers; the format is a header of ten lines.
#include <bit>

#include "core/cloud/point_cloud.hpp"
#include "core/file/atomic_file.hpp"

namespace nextview {

static_assert(std::endian::native == std::endian::little, "PCD is written as the memory lies");
static_assert(sizeof(Eigen::Vector3f) == 12, "points are written as they lie in memory");

void write_pcd(const PointCloud& cloud, const std::filesystem::path& file) {
  AtomicFile out(file);
  out.stream() << "# .PCD v0.7 - Point Cloud Data file format\n# points [m, world]\nVERSION 0.7\nFIELDS x y z\n"
               << "SIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " << cloud.size()
               << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " << cloud.size() << "\nDATA binary\n";
  out.stream().write(reinterpret_cast<const char*>(cloud.data()), static_cast<std::streamsize>(cloud.size() * 12));
  out.commit();
}

}  // namespace nextview
