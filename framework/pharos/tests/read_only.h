#pragma once

#include <memory>
#include <string>
#include <sys/mman.h>

#include <doctest/doctest.h>

#include <pharos/tests/fixtures.h>

namespace pharos::test {

/// Returns the saved form of a copy of `object` in memory that is read-only while it is saved. A
/// write to the copy itself ends the test; memory that it owns elsewhere is not watched.
template <class T>
std::string saved_read_only(const T& object) {
  void* const memory =
      mmap(nullptr, sizeof(T), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  REQUIRE(memory != MAP_FAILED);
  T* const copy = std::construct_at(static_cast<T*>(memory), object);
  REQUIRE(mprotect(memory, sizeof(T), PROT_READ) == 0);
  std::string bytes = saved(*copy);
  REQUIRE(mprotect(memory, sizeof(T), PROT_READ | PROT_WRITE) == 0);
  std::destroy_at(copy);
  munmap(memory, sizeof(T));
  return bytes;
}

}  // namespace pharos::test
