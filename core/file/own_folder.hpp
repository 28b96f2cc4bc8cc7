#pragma once
#include <filesystem>
#include <string_view>

namespace nextview {

/// Makes a folder whose name begins so, and which nobody else may look into. @throws std::system_error naming it
std::filesystem::path make_own_folder(std::string_view beginning,
                                      const std::filesystem::path& in = std::filesystem::temp_directory_path());

/// Such a folder, which goes with this, and its content with it.
class OwnFolder {
 public:
  OwnFolder() : path_(make_own_folder("nextview-")) {}
  ~OwnFolder();
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace nextview
