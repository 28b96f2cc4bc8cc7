#include "core/mesh/served_files.hpp"

#include <assimp/MemoryIOWrapper.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <assimp/IOSystem.hpp>

#include "core/file/descriptor.hpp"

namespace nextview {
namespace {

/// Goes down name by name, so that no link in between leads elsewhere. @return a descriptor; -1 if this is no regular
/// file below the folder
int open_below(int folder, std::string_view name) {
  if (name.empty() || name.front() == '/') return -1;
  int at = ::openat(folder, ".", O_PATH | O_DIRECTORY | O_CLOEXEC);
  while (at >= 0 && !name.empty()) {
    const Descriptor here(at);
    const std::string part(name.substr(0, name.find('/')));
    name.remove_prefix(std::min(name.size(), part.size() + 1));
    if (part == "..") return -1;
    const int kind = name.empty() ? O_RDONLY | O_NONBLOCK | O_NOCTTY : O_PATH | O_DIRECTORY;
    at = ::openat(here.get(), part.empty() ? "." : part.c_str(), kind | O_NOFOLLOW | O_CLOEXEC);
  }
  return at;
}

class ServingSystem : public Assimp::IOSystem {
 public:
  ServingSystem(ServedFiles& files, void (*served)(std::uint64_t)) : files_(files), served_(served) {}

  bool Exists(const char* name) const override { return name == files_.name || Companion(*this, name).regular(); }
  char getOsSeparator() const override { return '/'; }
  void Close(Assimp::IOStream* stream) override { delete stream; }

  Assimp::IOStream* Open(const char* name, const char* mode) override {
    if (std::string_view(mode).find_first_of("wa+") != std::string_view::npos) return nullptr;
    if (name == files_.name)
      return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(files_.bytes.data()),
                                        files_.bytes.size());
    const Companion file(*this, name);
    Assimp::IOStream* stream = file.regular() && file.size() <= files_.max_bytes ? read(file) : nullptr;
    if (!stream && files_.refused.empty()) files_.refused = name;
    return stream;
  }

 private:
  class Companion {
   public:
    Companion(const ServingSystem& system, const char* name)
        : file_(system.files_.folder < 0 ? -1 : open_below(system.files_.folder, name)) {
      known_ = file_.get() >= 0 && ::fstat(file_.get(), &about_) == 0;
    }
    bool regular() const { return known_ && S_ISREG(about_.st_mode); }
    std::uint64_t size() const { return static_cast<std::uint64_t>(about_.st_size); }
    int number() const { return file_.get(); }

   private:
    Descriptor file_;
    struct stat about_ {};
    bool known_ = false;
  };

  Assimp::IOStream* read(const Companion& file) {
    files_.max_bytes -= file.size();
    served_(file.size());
    auto bytes = std::make_unique<std::uint8_t[]>(file.size());
    for (std::uint64_t done = 0; done < file.size();) {
      const ssize_t count = ::read(file.number(), bytes.get() + done, file.size() - done);
      if (count <= 0) return nullptr;
      done += static_cast<std::uint64_t>(count);
    }
    return new Assimp::MemoryIOStream(bytes.release(), file.size(), true);
  }

  ServedFiles& files_;
  void (*served_)(std::uint64_t);
};

}  // namespace

std::unique_ptr<Assimp::IOSystem> io_system(ServedFiles& files, void (*served)(std::uint64_t)) {
  return std::make_unique<ServingSystem>(files, served);
}

}  // namespace nextview
