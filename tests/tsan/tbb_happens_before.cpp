// Debian's oneTBB is not built for the thread sanitizer, which therefore does not see that a task begins after it was
// spawned and that what waits goes on after it has ended: it would report every loop. Linked into a test, this tells
// it, by standing between the headers of oneTBB, which are compiled with the test, and its library.
#include <dlfcn.h>
#include <oneapi/tbb/task_group.h>
#include <sanitizer/tsan_interface.h>

#include <cstdlib>

namespace tbb::detail {
namespace {

/// A function of the library, by its mangled name.
template <class Function>
Function* real(const char* name) {
  void* const found = dlsym(RTLD_NEXT, name);
  if (!found) std::abort();  // another oneTBB: the names below are no longer its
  return reinterpret_cast<Function*>(found);
}

/// What the library is given in the place of a task.
class Announced : public d1::task {
 public:
  explicit Announced(d1::task& task) : task_(task) { __tsan_release(this); }
  d1::task* execute(d1::execution_data& data) override {
    __tsan_acquire(this);
    return ended(task_.execute(data));  // one that throws is cancelled, too
  }
  d1::task* cancel(d1::execution_data& data) override {
    __tsan_acquire(this);
    return ended(task_.cancel(data));
  }

 private:
  d1::task* ended(d1::task* next) {
    delete this;
    return next;
  }
  d1::task& task_;
};

}  // namespace

namespace r1 {

void spawn(d1::task& task, d1::task_group_context& context) {
  using Spawn = void(d1::task&, d1::task_group_context&);
  static Spawn* const library = real<Spawn>("_ZN3tbb6detail2r15spawnERNS0_2d14taskERNS2_18task_group_contextE");
  library(*new Announced(task), context);
}

void spawn(d1::task& task, d1::task_group_context& context, d1::slot_id slot) {
  using Spawn = void(d1::task&, d1::task_group_context&, d1::slot_id);
  static Spawn* const library = real<Spawn>("_ZN3tbb6detail2r15spawnERNS0_2d14taskERNS2_18task_group_contextEt");
  library(*new Announced(task), context, slot);
}

void execute_and_wait(d1::task& task, d1::task_group_context& context, d1::wait_context& wait_context,
                      d1::task_group_context& wait_task_context) {
  static const auto library = real<decltype(execute_and_wait)>(
      "_ZN3tbb6detail2r116execute_and_waitERNS0_2d14taskERNS2_18task_group_contextERNS2_12wait_contextES6_");
  struct Waited {
    d1::wait_context& context;
    ~Waited() { context.reserve(), context.release(); }  // touches its count, as the last task to end has
  } waited{wait_context};
  library(task, context, wait_context, wait_task_context);
}

// The library keeps what a task leaves for the next one that is made.
void* allocate(d1::small_object_pool*& pool, std::size_t bytes, const d1::execution_data& data) {
  using Allocate = void*(d1::small_object_pool*&, std::size_t, const d1::execution_data&);
  static Allocate* const library =
      real<Allocate>("_ZN3tbb6detail2r18allocateERPNS0_2d117small_object_poolEmRKNS2_14execution_dataE");
  void* const memory = library(pool, bytes, data);
  __tsan_acquire(memory);
  return memory;
}

void* allocate(d1::small_object_pool*& pool, std::size_t bytes) {
  using Allocate = void*(d1::small_object_pool*&, std::size_t);
  static Allocate* const library = real<Allocate>("_ZN3tbb6detail2r18allocateERPNS0_2d117small_object_poolEm");
  void* const memory = library(pool, bytes);
  __tsan_acquire(memory);
  return memory;
}

void deallocate(d1::small_object_pool& pool, void* memory, std::size_t bytes, const d1::execution_data& data) {
  using Deallocate = void(d1::small_object_pool&, void*, std::size_t, const d1::execution_data&);
  static Deallocate* const library =
      real<Deallocate>("_ZN3tbb6detail2r110deallocateERNS0_2d117small_object_poolEPvmRKNS2_14execution_dataE");
  __tsan_release(memory);
  library(pool, memory, bytes, data);
}

void deallocate(d1::small_object_pool& pool, void* memory, std::size_t bytes) {
  using Deallocate = void(d1::small_object_pool&, void*, std::size_t);
  static Deallocate* const library = real<Deallocate>("_ZN3tbb6detail2r110deallocateERNS0_2d117small_object_poolEPvm");
  __tsan_release(memory);
  library(pool, memory, bytes);
}

}  // namespace r1
}  // namespace tbb::detail
