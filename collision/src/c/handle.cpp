#include "c/handle.hpp"

#include <utility>

namespace surehit::c {

/// The closed handles, from the one that was closed first to the one that was closed last.
class ClosedHandles {
 public:
  /// Returns those of the program. They are never destroyed, because a handle may be closed until it ends.
  static ClosedHandles& of_program() {
    static ClosedHandles& handles = *new ClosedHandles;
    return handles;
  }

  void add(Handle* handle) noexcept {
    const Lock lock(*this);
    (last_ != nullptr ? last_->next_closed_ : first_) = handle;
    last_ = handle;
    ++count_;
  }
  /// Returns the handle that was closed first, or null if few have been closed since then.
  [[nodiscard]] Handle* take() noexcept {
    const Lock lock(*this);
    if (count_ <= kept) return nullptr;
    --count_;
    return std::exchange(first_, std::exchange(first_->next_closed_, nullptr));
  }

 private:
  /// Holds the list for some instructions. There is no mutex, because not all systems have one.
  class Lock {
   public:
    explicit Lock(ClosedHandles& handles) noexcept : handles_(handles) {
      while (handles_.is_held_.test_and_set(std::memory_order_acquire)) {
      }
    }
    ~Lock() { handles_.is_held_.clear(std::memory_order_release); }
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;

   private:
    ClosedHandles& handles_;
  };

  static constexpr std::size_t kept = 1000;  ///< The number of closed handles that are not used again.

  std::atomic_flag is_held_ = ATOMIC_FLAG_INIT;
  Handle* first_ = nullptr;
  Handle* last_ = nullptr;
  std::size_t count_ = 0;
};

Handle* Handle::open(HandleKind kind, std::shared_ptr<void> object) {
  Handle* handle = ClosedHandles::of_program().take();
  if (handle == nullptr) handle = new Handle;
  handle->object_ = std::move(object);
  handle->kind_.store(kind, std::memory_order_relaxed);
  return handle;
}

void Handle::close() noexcept {
  kind_.store(HandleKind::closed, std::memory_order_relaxed);
  object_.reset();
  ClosedHandles::of_program().add(this);
}

}  // namespace surehit::c
