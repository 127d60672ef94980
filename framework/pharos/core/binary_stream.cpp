#include <string>

#include <fmt/format.h>

#include <pharos/core/binary_stream.h>

namespace pharos {
namespace {

std::string heading(std::string_view name, std::uint32_t version) {
  return fmt::format("pharos {} {}\n", name, version);
}

}  // namespace

void save_heading(std::ostream& out, std::string_view name, std::uint32_t version) {
  out << heading(name, version);
}

void expect_heading(std::istream& in, std::string_view name, std::uint32_t version) {
  const std::string expected = heading(name, version);
  std::string found(expected.size(), '\0');
  in.read(found.data(), static_cast<std::streamsize>(found.size()));
  if (!in || found != expected) {
    throw InputError(fmt::format("this is no saved '{}' of version {}", name, version));
  }
}

}  // namespace pharos
