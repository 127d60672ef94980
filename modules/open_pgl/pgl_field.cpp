#include "pgl_field.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <unistd.h>
#include <xxhash.h>

#include <pharos/core/error.h>

namespace pharos::open_pgl {
namespace {

/// A temporary file with a unique name; the destructor removes it.
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
  // All processors of the last ten years support eight SIMD lanes.
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

void archive_bytes(Archive& archive, std::string& bytes) {
  std::uint64_t expected = checksum(bytes);
  archive(expected, bytes);
  archive.expect(checksum(bytes) == expected, "the field of Open PGL");
}

}  // namespace pharos::open_pgl
