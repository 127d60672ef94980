#include <fmt/format.h>

#include <pharos/core/archive.h>

namespace pharos {

void Archive::heading(std::string_view name, std::uint32_t version) {
  const std::string expected = fmt::format("pharos {} {}\n", name, version);
  std::string text = expected;
  if (!loads()) return bytes(text.data(), text.size());
  in_->read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!*in_ || text != expected) {
    throw InputError(fmt::format("this is no saved '{}' of version {}", name, version));
  }
}

void Archive::expect(bool holds, std::string_view what) const {
  if (loads() && !holds) throw InputError(fmt::format("{} is damaged", what));
}

void Archive::value(std::string& text) {
  auto count = static_cast<std::uint64_t>(text.size());
  value(count);
  if (!loads()) return bytes(text.data(), text.size());
  text.clear();
  while (text.size() < count) {
    const std::size_t begin = text.size();
    text.resize(begin + std::min(count - begin, kChunk));
    bytes(text.data() + begin, text.size() - begin);
  }
}

}  // namespace pharos
