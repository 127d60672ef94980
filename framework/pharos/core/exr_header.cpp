#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>

#include <pharos/core/exr_header.h>

namespace pharos {
namespace {

constexpr std::string_view kMagic{"\x76\x2f\x31\x01", 4};
/// The bit of several parts in the second byte of the version. Each part has a header.
constexpr unsigned kSeveralParts = 0x10;

/// Reads a name that ends with a zero byte. It is empty at the end of a header and of the file.
std::string read_name(std::istream& in) {
  std::string name;
  std::getline(in, name, '\0');
  return in ? name : std::string();
}

/// Reads a number as OpenEXR stores it: little endian.
std::int32_t read_size(std::istream& in) {
  std::array<unsigned char, 4> bytes{};
  in.read(reinterpret_cast<char*>(bytes.data()), bytes.size());
  std::uint32_t size = 0;
  for (unsigned i = 0; i < 4; ++i) size |= std::uint32_t{bytes[i]} << 8 * i;
  return static_cast<std::int32_t>(size);
}

/// Reads a header. Returns false at an attribute that claims more than the rest of the file.
bool attributes_fit(std::istream& in, std::int64_t file_size) {
  while (!read_name(in).empty()) {
    read_name(in);  // the type
    const std::int32_t size = read_size(in);
    if (!in) return true;
    if (size < 0 || size > file_size - in.tellg()) return false;
    in.seekg(size, std::ios::cur);
  }
  return true;
}

}  // namespace

bool exr_header_fits(const std::filesystem::path& path) {
  std::error_code failed;
  const auto file_size = static_cast<std::int64_t>(std::filesystem::file_size(path, failed));
  std::ifstream in(path, std::ios::binary);
  std::array<char, 8> start{};
  if (failed || !in.read(start.data(), start.size())) return true;
  if (std::string_view(start.data(), kMagic.size()) != kMagic) return true;
  const bool has_parts = (static_cast<unsigned char>(start[5]) & kSeveralParts) != 0;
  do {
    if (!attributes_fit(in, file_size)) return false;
  } while (has_parts && in && in.peek() > 0);  // no further header begins with a zero
  return true;
}

}  // namespace pharos
