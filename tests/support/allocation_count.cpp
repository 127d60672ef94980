// Replaces the global `operator new`. Modules are loaded after the program and therefore use this
// version, too. The array forms of the standard library call these functions. Its nothrow form
// does, too, but the address sanitizer has a nothrow form of its own, whose blocks need its own
// `delete`. Clang's thread sanitizer has operators of its own, which cannot be replaced, and calls
// a hook for every block.

#include "allocation_count.h"

#include <cstdlib>
#include <new>

#if defined(__has_feature)
#define PHAROS_COUNTS_BY_HOOK __has_feature(thread_sanitizer)
#else
#define PHAROS_COUNTS_BY_HOOK 0
#endif

namespace {

thread_local std::uint64_t allocations = 0;

}  // namespace

#if PHAROS_COUNTS_BY_HOOK

extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*on_malloc)(const volatile void*,
                                                                           std::size_t),
                                                         void (*on_free)(const volatile void*));

namespace {

void count(const volatile void*, std::size_t) {
  ++allocations;
}
void ignore(const volatile void*) {}

[[maybe_unused]] const int hook = __sanitizer_install_malloc_and_free_hooks(count, ignore);

}  // namespace

#else

namespace {

void* counted(void* block) {
  ++allocations;
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

}  // namespace

void* operator new(std::size_t bytes) {
  return counted(std::malloc(bytes > 0 ? bytes : 1));
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  const auto edge = static_cast<std::size_t>(alignment);
  return counted(std::aligned_alloc(edge, (bytes + edge - 1) / edge * edge));
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  try {
    return operator new(bytes);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* block) noexcept {
  std::free(block);
}
void operator delete(void* block, std::size_t) noexcept {
  std::free(block);
}
void operator delete(void* block, std::align_val_t) noexcept {
  std::free(block);
}
void operator delete(void* block, std::size_t, std::align_val_t) noexcept {
  std::free(block);
}

#endif

namespace pharos::testing {

std::uint64_t allocation_count() {
  return allocations;
}

}  // namespace pharos::testing
