#include "tests/fuzz/fuzzed_input.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <system_error>

#include "core/file/own_folder.hpp"

namespace nextview {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void end(const char* what, const char* more) {
  std::fprintf(stderr, "fuzzer: %s: %s\n", what, more);
  std::abort();
}

}  // namespace

fs::path fuzzed_file(const std::string& name, std::string_view bytes) {
  static const OwnFolder folder;
  const fs::path file = folder.path() / name;
  int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (descriptor < 0) {
    fs::create_directories(file.parent_path());
    descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  }
  if (::write(descriptor, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
    end("cannot write", file.c_str());
  ::close(descriptor);
  return file;
}

bool is_read(const std::function<void()>& read) {
  try {
    read();
    return true;
  } catch (const std::runtime_error& error) {
    require(*error.what() != 0, "an error without a reason");
  } catch (const std::invalid_argument& error) {
    require(*error.what() != 0, "an error without a reason");
  } catch (const std::exception& error) {
    end("an exception that no declaration names", error.what());
  }
  return false;
}

void require(bool holds, const char* what) {
  if (!holds) end("it does not hold", what);
}

std::string_view next_part(std::string_view& rest) {
  constexpr std::string_view between = "\n%%%\n";
  const std::size_t found = rest.find(between), end = std::min(found, rest.size());
  const std::string_view part = rest.substr(0, end);
  rest.remove_prefix(found == rest.npos ? rest.size() : end + between.size());
  return part;
}

}  // namespace nextview
