#pragma once
#include <atomic>
#include <cstddef>
#include <utility>

namespace nextview {

/// A value that its copies share until one of them changes it. Never empty. Copies may live in different threads; one
/// copy is as safe to use from several threads as the value is.
template <class T>
class CopyOnWrite {
 public:
  template <class... Arguments>
  explicit CopyOnWrite(std::in_place_t, Arguments&&... arguments)
      : shared_(new Shared{{1}, T(std::forward<Arguments>(arguments)...)}) {}
  CopyOnWrite() : CopyOnWrite(std::in_place) {}
  CopyOnWrite(const CopyOnWrite& other) : shared_(other.shared_) {
    shared_->owners.fetch_add(1, std::memory_order_relaxed);
  }
  CopyOnWrite& operator=(CopyOnWrite other) {
    std::swap(shared_, other.shared_);
    return *this;
  }
  ~CopyOnWrite() {
    if (shared_->owners.fetch_sub(1, std::memory_order_acq_rel) == 1) delete shared_;
  }

  const T& operator*() const { return shared_->value; }
  const T* operator->() const { return &shared_->value; }
  /// The value, to be changed: copied first if others share it.
  T& change() {
    // Acquire: what others read of the value before they let go of it is over.
    if (shared_->owners.load(std::memory_order_acquire) > 1) *this = CopyOnWrite(std::in_place, shared_->value);
    return shared_->value;
  }
  bool shares_with(const CopyOnWrite& other) const { return shared_ == other.shared_; }

 private:
  struct Shared {
    std::atomic<std::size_t> owners;
    T value;
  };
  Shared* shared_;
};

}  // namespace nextview
