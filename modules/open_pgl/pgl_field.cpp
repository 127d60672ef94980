#include "pgl_field.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <unistd.h>
#include <xxhash.h>

#include <pharos/core/binary_stream.h>
#include <pharos/core/error.h>

namespace pharos::open_pgl {
namespace {

/// A file's name that is nobody else's, as long as the object lives.
class TemporaryFile {
 public:
  TemporaryFile() {
    std::string pattern = (std::filesystem::temp_directory_path() / "pharos-field-XXXXXX").string();
    const int file = mkstemp(pattern.data());
    if (file < 0) throw RunError("no temporary file can be written for Open PGL");
    close(file);
    path_ = pattern;
  }
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

std::uint64_t checksum(const std::string& bytes) {
  return XXH3_64bits(bytes.data(), bytes.size());
}

}  // namespace

openpgl::cpp::Device& device() {
  // Eight lanes are what every processor of the last ten years has.
  static openpgl::cpp::Device device(PGL_DEVICE_TYPE_CPU_8);
  return device;
}

std::string bytes_of(const openpgl::cpp::Field& field) {
  const TemporaryFile file;
  if (!field.Store(file.path())) throw RunError("Open PGL could not store its field");
  std::ifstream in(file.path(), std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in || bytes.empty()) throw RunError("Open PGL could not store its field");
  return bytes;
}

std::unique_ptr<openpgl::cpp::Field> field_of(const std::string& bytes) {
  const TemporaryFile file;
  std::ofstream out(file.path(), std::ios::binary);
  out << bytes;
  out.close();
  if (!out) throw RunError("no temporary file can be written for Open PGL");
  try {
    return std::make_unique<openpgl::cpp::Field>(&device(), file.path());
  } catch (const std::exception& e) {
    throw InputError(std::string("Open PGL refuses the field: ") + e.what());
  }
}

void save_bytes(const std::string& bytes, std::ostream& out) {
  save_number(out, static_cast<std::uint64_t>(bytes.size()));
  save_number(out, checksum(bytes));
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

std::string load_bytes(std::istream& in) {
  const auto size = load_number<std::uint64_t>(in), expected = load_number<std::uint64_t>(in);
  std::string bytes;
  constexpr std::uint64_t kPiece = 1 << 20;  // a damaged length must not take all memory
  while (bytes.size() < size && in) {
    const std::size_t piece = std::min<std::uint64_t>(kPiece, size - bytes.size()),
                      before = bytes.size();
    bytes.resize(before + piece);
    in.read(bytes.data() + before, static_cast<std::streamsize>(piece));
  }
  if (!in || checksum(bytes) != expected) throw InputError("the field of Open PGL is damaged");
  return bytes;
}

}  // namespace pharos::open_pgl
