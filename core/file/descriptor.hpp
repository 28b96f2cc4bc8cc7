#pragma once
#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace nextview {

/// An open file of the operating system, closed at the end.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept : number_(other.release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    close();
    number_ = other.release();
    return *this;
  }

  bool is_open() const { return number_ >= 0; }
  int get() const { return number_; }
  int release() { return std::exchange(number_, -1); }
  void close() {
    if (is_open()) ::close(release());
  }

 private:
  int number_;
};

/// Writes all of it. Returns 0, or an errno: then a part of it may have been written.
int write_all(int descriptor, std::string_view bytes);

/// "FILE: cannot be VERB: the reason that stands for `error`", an errno, and what to do where that is known.
std::runtime_error file_error(const std::filesystem::path& file, const char* verb, int error);

}  // namespace nextview
