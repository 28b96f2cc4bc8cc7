/* Loaded before a program, it makes the N-th call of one kind fail, once, in all of the program's processes together:
 * NEXTVIEW_FAIL names the kind (memory, open, read, write, sync, rename), NEXTVIEW_FAIL_AT is N, counted from 1; 0
 * fails none. Files below /proc, /sys, /dev and /usr count for nothing but memory: the system's libraries read those for
 * themselves. With NEXTVIEW_FAIL_COUNT the number of calls is written to that file at the end. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

enum kind { none, memory, opening, reading, writing, syncing, renaming };
static enum kind chosen;
static long at, calls;

__attribute__((constructor)) static void begin(void) {
  static const char* const names[] = {"none", "memory", "open", "read", "write", "sync", "rename"};
  const char *name = getenv("NEXTVIEW_FAIL"), *number = getenv("NEXTVIEW_FAIL_AT");
  at = number ? atol(number) : 0;
  for (int i = 0; name && i < 7; ++i)
    if (strcmp(name, names[i]) == 0) chosen = (enum kind)i;
}

__attribute__((destructor)) static void tell(void) {
  const char* name = getenv("NEXTVIEW_FAIL_COUNT");
  const long count = __atomic_load_n(&calls, __ATOMIC_SEQ_CST);
  chosen = none;
  FILE* file = name ? fopen(name, "w") : NULL;
  if (!file) return;
  fprintf(file, "%ld\n", count);
  fclose(file);
}

/* What is before main(), in the initialisers of libraries, nobody can handle. */
static int in_main;
static int (*real_main)(int, char**, char**);
static int counted_main(int count, char** arguments, char** variables) {
  in_main = 1;
  return real_main(count, arguments, variables);
}
int __libc_start_main(int (*main)(int, char**, char**), int count, char** arguments, void (*init)(void), void (*fini)(void),
                      void (*linker_fini)(void), void* stack_end) {
  static int (*real)(int (*)(int, char**, char**), int, char**, void (*)(void), void (*)(void), void (*)(void), void*);
  if (!real) real = (__typeof__(real))dlsym(RTLD_NEXT, "__libc_start_main");
  real_main = main;
  return real(counted_main, count, arguments, init, fini, linker_fini, stack_end);
}

static int fails(enum kind kind) {
  return kind == chosen && in_main && __atomic_add_fetch(&calls, 1, __ATOMIC_SEQ_CST) == at;
}

static int is_ours(const char* path) {
  static const char* const others[] = {"/proc", "/sys", "/dev", "/usr", "/etc", "/lib"};
  for (int i = 0; i < 6; ++i)
    if (strncmp(path, others[i], strlen(others[i])) == 0) return 0;
  return 1;
}

static int is_our_file(int file) {
  char link[64], path[PATH_MAX];
  snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const ssize_t length = readlink(link, path, sizeof path - 1);
  if (length < 0) return 0;
  path[length] = 0;
  return path[0] == '/' && is_ours(path);
}

#define REAL(type, name, ...)                          \
  static type (*real)(__VA_ARGS__);                    \
  if (!real) real = (type(*)(__VA_ARGS__))dlsym(RTLD_NEXT, #name)

/* dlsym itself may take memory before the real function is known: glibc has it by this name. */
extern void* __libc_malloc(size_t);
extern void* __libc_calloc(size_t, size_t);
extern void* __libc_realloc(void*, size_t);
extern void* __libc_memalign(size_t, size_t);

static int no_memory(void) {
  if (chosen != memory || !fails(memory)) return 0;
  errno = ENOMEM;
  return 1;
}
void* malloc(size_t size) { return no_memory() ? NULL : __libc_malloc(size); }
void* calloc(size_t count, size_t size) { return no_memory() ? NULL : __libc_calloc(count, size); }
void* realloc(void* old, size_t size) { return size > 0 && no_memory() ? NULL : __libc_realloc(old, size); }
void* memalign(size_t alignment, size_t size) { return no_memory() ? NULL : __libc_memalign(alignment, size); }
void* aligned_alloc(size_t alignment, size_t size) { return memalign(alignment, size); }
int posix_memalign(void** result, size_t alignment, size_t size) {
  void* memory_ = memalign(alignment, size);
  if (!memory_) return ENOMEM;
  *result = memory_;
  return 0;
}

static int bad(int error) {
  errno = error;
  return -1;
}

#define OPEN(name)                                                       \
  int name(const char* path, int flags, ...) {                           \
    REAL(int, name, const char*, int, ...);                              \
    va_list more;                                                        \
    va_start(more, flags);                                               \
    const mode_t mode = flags & (O_CREAT | __O_TMPFILE) ? va_arg(more, mode_t) : 0; \
    va_end(more);                                                        \
    return is_ours(path) && fails(opening) ? bad(EMFILE) : real(path, flags, mode); \
  }
OPEN(open)
OPEN(open64)

#define FOPEN(name)                                          \
  FILE* name(const char* path, const char* mode) {           \
    REAL(FILE*, name, const char*, const char*);             \
    if (!is_ours(path) || !fails(opening)) return real(path, mode); \
    errno = EMFILE;                                          \
    return NULL;                                             \
  }
FOPEN(fopen)
FOPEN(fopen64)

#define READ(name, ...) (chosen == reading && is_our_file(file) && fails(reading) ? bad(EIO) : real(__VA_ARGS__))
ssize_t read(int file, void* bytes, size_t count) {
  REAL(ssize_t, read, int, void*, size_t);
  return READ(read, file, bytes, count);
}
ssize_t pread(int file, void* bytes, size_t count, off_t offset) {
  REAL(ssize_t, pread, int, void*, size_t, off_t);
  return READ(pread, file, bytes, count, offset);
}
ssize_t write(int file, const void* bytes, size_t count) {
  REAL(ssize_t, write, int, const void*, size_t);
  return chosen == writing && is_our_file(file) && fails(writing) ? bad(ENOSPC) : real(file, bytes, count);
}
ssize_t writev(int file, const struct iovec* parts, int count) {
  REAL(ssize_t, writev, int, const struct iovec*, int);
  return chosen == writing && is_our_file(file) && fails(writing) ? bad(ENOSPC) : real(file, parts, count);
}
int fsync(int file) {
  REAL(int, fsync, int);
  return fails(syncing) ? bad(EIO) : real(file);
}
int fdatasync(int file) {
  REAL(int, fdatasync, int);
  return fails(syncing) ? bad(EIO) : real(file);
}
int rename(const char* from, const char* to) {
  REAL(int, rename, const char*, const char*);
  return fails(renaming) ? bad(EACCES) : real(from, to);
}
int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) {
  REAL(int, linkat, int, const char*, int, const char*, int);
  return fails(renaming) ? bad(EACCES) : real(from_folder, from, to_folder, to, flags);
}
int mkdir(const char* path, mode_t mode) {
  REAL(int, mkdir, const char*, mode_t);
  return is_ours(path) && fails(opening) ? bad(EMFILE) : real(path, mode);
}
int ftruncate(int file, off_t size) {
  REAL(int, ftruncate, int, off_t);
  return is_our_file(file) && fails(writing) ? bad(EIO) : real(file, size);
}
