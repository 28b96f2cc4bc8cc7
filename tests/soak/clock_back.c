/* Loaded before a program, it sets its clock back by an hour each NEXTVIEW_CLOCK_BACK milliseconds after its start, as
 * an operator or a time server may. What only goes forward (CLOCK_MONOTONIC) is left alone, as it is then. */
#define _GNU_SOURCE
#include <stdlib.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

static long milliseconds(clockid_t clock) {
  struct timespec now;
  syscall(SYS_clock_gettime, clock, &now);
  return now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

static long beginning, every;
__attribute__((constructor)) static void begin(void) {
  const char* text = getenv("NEXTVIEW_CLOCK_BACK");
  beginning = milliseconds(CLOCK_MONOTONIC);
  every = text ? atol(text) : 0;
}

/* Seconds that the clock is behind by now. */
static long behind(void) { return every > 0 ? (milliseconds(CLOCK_MONOTONIC) - beginning) / every * 3600 : 0; }

int clock_gettime(clockid_t clock, struct timespec* now) {
  const int result = (int)syscall(SYS_clock_gettime, clock, now);
  if (result == 0 && (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE)) now->tv_sec -= behind();
  return result;
}

int gettimeofday(struct timeval* restrict now, void* restrict zone) {
  (void)zone;
  struct timespec exact;
  clock_gettime(CLOCK_REALTIME, &exact);
  now->tv_sec = exact.tv_sec;
  now->tv_usec = exact.tv_nsec / 1000;
  return 0;
}

time_t time(time_t* result) {
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  if (result) *result = now.tv_sec;
  return now.tv_sec;
}
