#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace pharos {

/// A bump allocator for objects that live as long as one path vertex. Each work unit owns one arena
/// and calls reset() before each vertex. The arena keeps its blocks, so it allocates no more heap
/// memory once it has served the largest vertex of the unit. Objects must be trivially
/// destructible.
class Arena {
 public:
  explicit Arena(std::size_t block_bytes = 16 * 1024) : block_bytes_(block_bytes) {}

  /// Constructs a T that lives until reset().
  template <class T, class... Args>
  T* make(Args&&... args) {
    static_assert(std::is_trivially_destructible_v<T>, "the arena runs no destructors");
    return new (allocate(sizeof(T), alignof(T))) T(std::forward<Args>(args)...);
  }

  /// Returns a value-initialized array of `count` T that lives until reset().
  template <class T>
  T* make_array(std::size_t count) {
    static_assert(std::is_trivially_destructible_v<T>, "the arena runs no destructors");
    return new (allocate(sizeof(T) * count, alignof(T))) T[count]();
  }

  /// Ends the lifetime of all objects but keeps the memory.
  void reset() {
    block_ = 0;
    used_ = 0;
  }

 private:
  struct Block {
    std::unique_ptr<std::byte[]> bytes;
    std::size_t size;
  };

  void* allocate(std::size_t bytes, std::size_t alignment) {
    for (;; ++block_, used_ = 0) {
      if (block_ == blocks_.size()) add_block(bytes + alignment);
      void* at = blocks_[block_].bytes.get() + used_;
      std::size_t space = blocks_[block_].size - used_;
      if (std::align(alignment, bytes, at, space)) {
        used_ = blocks_[block_].size - space + bytes;
        return at;
      }
    }
  }

  void add_block(std::size_t at_least) {
    const std::size_t size = at_least > block_bytes_ ? at_least : block_bytes_;
    blocks_.push_back({std::make_unique<std::byte[]>(size), size});
  }

  std::size_t block_bytes_;
  std::vector<Block> blocks_;
  std::size_t block_ = 0;
  std::size_t used_ = 0;
};

}  // namespace pharos
