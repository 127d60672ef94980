#pragma once

#include <cstddef>
#include <new>
#include <sstream>
#include <string>
#include <utility>

#include <pharos/core/archive.h>

namespace pharos {

/// Returns what `save_all(archive)` saves. Begins with memory for `expected` bytes, because growing
/// copies what is there. Throws std::bad_alloc if memory runs out.
template <class SaveAll>
std::string saved_bytes(SaveAll&& save_all, std::size_t expected = 0) {
  std::string memory;
  memory.reserve(expected);
  std::ostringstream out(std::move(memory));
  Archive archive(out);
  save_all(archive);
  if (!out) throw std::bad_alloc();
  return std::move(out).str();
}

/// Runs `load_all(archive)` on saved bytes. Throws InputError if it leaves any of them.
template <class LoadAll>
void load_bytes(const std::string& bytes, LoadAll&& load_all) {
  std::istringstream in(bytes);
  Archive archive(in);
  load_all(archive);
  archive.expect(in.peek() == std::istringstream::traits_type::eof(), "what was saved");
}

}  // namespace pharos
