/* Loaded before a program, it ends it (SIGKILL) at the N-th call that changes a file below a folder: half of a write is
 * done, anything else is not. NEXTVIEW_KILL_BELOW names the folder, NEXTVIEW_KILL_AT is N. At a normal end the number of
 * calls is written to the file NEXTVIEW_KILL_COUNT. With NEXTVIEW_FULL_AT = N the disk is full from that call on: half of
 * a write is done, what makes more of it fails, and what only changes names does not. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static long calls;

static int is_below(const char* path) {
  const char* folder = getenv("NEXTVIEW_KILL_BELOW");
  return folder && strncmp(path, folder, strlen(folder)) == 0;
}

static int is_file_below(int file) {
  char link[64], path[PATH_MAX];
  snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const ssize_t length = readlink(link, path, sizeof path - 1);
  if (length < 0) return 0;
  path[length] = 0;
  return is_below(path);
}

static int full;

/* Whether the program ends at this call; sets whether the disk is full. */
static int counts(void) {
  const char *at = getenv("NEXTVIEW_KILL_AT"), *full_at = getenv("NEXTVIEW_FULL_AT");
  if (!at && !full_at) return 0;
  const long call = __atomic_add_fetch(&calls, 1, __ATOMIC_SEQ_CST);
  if (full_at && call >= atol(full_at)) full = 1;
  return at && call == atol(at);
}

static int no_space(void) {
  errno = ENOSPC;
  return -1;
}

static void end(void) { kill(getpid(), SIGKILL); }

ssize_t write(int file, const void* bytes, size_t count) {
  static ssize_t (*real)(int, const void*, size_t);
  if (!real) real = (ssize_t(*)(int, const void*, size_t))dlsym(RTLD_NEXT, "write");
  if (is_file_below(file) && counts()) {
    real(file, bytes, count / 2);
    end();
  }
  if (full && is_file_below(file)) return count > 1 && full++ == 1 ? real(file, bytes, count / 2) : no_space();
  return real(file, bytes, count);
}

#define ON_FILE(name)                                           \
  int name(int file) {                                          \
    static int (*real)(int);                                    \
    if (!real) real = (int (*)(int))dlsym(RTLD_NEXT, #name);    \
    if (is_file_below(file) && counts()) end();                 \
    return full && is_file_below(file) ? no_space() : real(file); \
  }
ON_FILE(fsync)
ON_FILE(fdatasync)

int ftruncate(int file, off_t size) {
  static int (*real)(int, off_t);
  if (!real) real = (int (*)(int, off_t))dlsym(RTLD_NEXT, "ftruncate");
  if (is_file_below(file) && counts()) end();
  return real(file, size);
}

int rename(const char* from, const char* to) {
  static int (*real)(const char*, const char*);
  if (!real) real = (int (*)(const char*, const char*))dlsym(RTLD_NEXT, "rename");
  if (is_below(to) && counts()) end();
  return real(from, to);
}

int mkdir(const char* path, mode_t mode) {
  static int (*real)(const char*, mode_t);
  if (!real) real = (int (*)(const char*, mode_t))dlsym(RTLD_NEXT, "mkdir");
  if (is_below(path) && counts()) end();
  return full && is_below(path) ? no_space() : real(path, mode);
}

__attribute__((destructor)) static void tell(void) {
  const char* name = getenv("NEXTVIEW_KILL_COUNT");
  FILE* file = name && calls > 0 ? fopen(name, "w") : NULL;
  if (!file) return;
  fprintf(file, "%ld\n", calls);
  fclose(file);
}
