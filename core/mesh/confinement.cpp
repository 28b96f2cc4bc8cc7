#include "core/mesh/confinement.hpp"

#include <fcntl.h>
#include <seccomp.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>

#include "core/mesh/mesh_types.hpp"

#if defined(__clang__)  // the macros of seccomp.h are C
#pragma clang diagnostic ignored "-Wc99-extensions"
#pragma clang diagnostic ignored "-Wmissing-field-initializers"
#endif

namespace nextview {
namespace {

/// For Assimp's own tables and small files.
constexpr std::uint64_t min_memory = 512u << 20;  // [bytes]
/// Of a file's size, for Assimp's scene and the triangles made of it. Measured with Debian's Assimp 5.2 on a million
/// vertices: PLY and OFF 5, STL 6, OBJ and DAE 8; of compressed files 3MF 75. Three times that is for files less plain.
constexpr std::uint64_t memory_per_byte = 30, memory_per_packed_byte = 250;
/// Assimp reads 3 to 100 MB per second; where many programs run, a tenth of that.
constexpr std::chrono::milliseconds min_time = std::chrono::minutes(5), time_per_megabyte = std::chrono::seconds(1);

constexpr scmp_datum_t max_descriptors = 64;

/// Never above what was set before.
void limit(__rlimit_resource what, rlim_t now, rlim_t at_most) {
  rlimit old{};
  ::getrlimit(what, &old);
  const rlimit wanted = {std::min(now, old.rlim_cur), std::min(at_most, old.rlim_max)};
  ::setrlimit(what, &wanted);
}

void raise(__rlimit_resource what, rlim_t by) {
  rlimit old{};
  if (::getrlimit(what, &old) != 0 || old.rlim_cur == RLIM_INFINITY) return;
  old.rlim_cur = std::min(old.rlim_cur + by, old.rlim_max);
  ::setrlimit(what, &old);
}

using Filter = std::unique_ptr<void, void (*)(scmp_filter_ctx)>;

/// Allows a call if all of the conditions hold.
template <class... Conditions>
bool allow(const Filter& filter, int call, Conditions... conditions) {
  const int error = seccomp_rule_add(filter.get(), SCMP_ACT_ALLOW, call, sizeof...(conditions), conditions...);
  return error == 0 || error == -EDOM;  // -EDOM: this processor's kernel has no such call
}

bool allow_computing(const Filter& filter) {
  bool good = true;
  for (const int call :
       {SCMP_SYS(brk), SCMP_SYS(munmap), SCMP_SYS(mremap), SCMP_SYS(madvise), SCMP_SYS(futex), SCMP_SYS(sched_yield),
        SCMP_SYS(rt_sigreturn), SCMP_SYS(rt_sigprocmask), SCMP_SYS(getpid), SCMP_SYS(gettid), SCMP_SYS(clock_gettime),
        SCMP_SYS(getrandom), SCMP_SYS(exit), SCMP_SYS(exit_group)})
    good &= allow(filter, call);
  for (const int call : {SCMP_SYS(mmap), SCMP_SYS(mprotect)})
    good &= allow(filter, call, SCMP_A2(SCMP_CMP_MASKED_EQ, PROT_EXEC, 0));
  const auto self = static_cast<scmp_datum_t>(::getpid());
  // abort() sends itself a signal, and memory limits move with the files that are read.
  return good && allow(filter, SCMP_SYS(tgkill), SCMP_A0(SCMP_CMP_EQ, self)) &&
         allow(filter, SCMP_SYS(prlimit64), SCMP_A0(SCMP_CMP_EQ, 0));
}

bool allow_reading(const Filter& filter) {
  bool good = true;
  for (const int call : {SCMP_SYS(read), SCMP_SYS(readv), SCMP_SYS(pread64), SCMP_SYS(lseek), SCMP_SYS(fstat),
                         SCMP_SYS(newfstatat), SCMP_SYS(close)})
    good &= allow(filter, call);
  // AT_FDCWD is beyond all descriptors, whether it comes as 32 or as 64 bits.
  return good && allow(filter, SCMP_SYS(openat), SCMP_A0(SCMP_CMP_LT, max_descriptors),
                       SCMP_A2(SCMP_CMP_MASKED_EQ, O_ACCMODE | O_CREAT | O_TRUNC | O_APPEND, O_RDONLY));
}

}  // namespace

ReadingLimits reading_limits(std::string_view extension, std::uint64_t size, std::uint64_t largest_file) {
  const bool packed = extension == ".3mf" || extension == ".fbx";
  const std::uint64_t companions = has_companions(extension) ? largest_file - std::min(size, largest_file) : 0;
  const auto megabytes = static_cast<std::int64_t>((size + companions) >> 20);
  return {min_memory + (packed ? memory_per_packed_byte : memory_per_byte) * size, companions,
          min_time + time_per_megabyte * megabytes};
}

HeldMemory held_memory() {
  unsigned long long size = 0, resident = 0, shared, text, library, data = 0;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen("/proc/self/statm", "re"), std::fclose);
  if (!file ||
      std::fscanf(file.get(), "%llu %llu %llu %llu %llu %llu", &size, &resident, &shared, &text, &library, &data) != 6)
    return {};
  const auto page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  return {size * page, resident * page, data * page};
}

void limit_memory(const ReadingLimits& limits) {
  const HeldMemory now = held_memory();
  if (!can_confine || now.address_space == 0) return;
  const rlim_t more = limits.memory, most = more + memory_per_byte * limits.companions;
  limit(RLIMIT_AS, now.address_space + more, now.address_space + most);
  limit(RLIMIT_DATA, now.data + more, now.data + most);
}

void allow_memory_for(std::uint64_t bytes) {
  raise(RLIMIT_AS, memory_per_byte * bytes);
  raise(RLIMIT_DATA, memory_per_byte * bytes);
}

bool confine(int pipe) {
  limit(RLIMIT_FSIZE, 0, 0);
  limit(RLIMIT_NOFILE, max_descriptors, max_descriptors);
  if (!can_confine) return false;
  const Filter filter(seccomp_init(SCMP_ACT_ERRNO(EPERM)), seccomp_release);
  return filter && allow_computing(filter) && allow_reading(filter) &&
         allow(filter, SCMP_SYS(write), SCMP_A0(SCMP_CMP_EQ, static_cast<scmp_datum_t>(pipe))) &&
         seccomp_load(filter.get()) == 0;
}

}  // namespace nextview
