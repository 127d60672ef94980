#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>
#include <unistd.h>

#include <pharos/core/archive.h>
#include <pharos/core/error.h>

namespace pharos::test {

/// A temporary folder that exists as long as the object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "pharos-test-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw RunError("no temporary folder");
    path_ = std::filesystem::canonical(pattern);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }
  /// Writes a file and returns its path.
  std::filesystem::path write(std::string_view name, std::string_view text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

/// Returns the content of a file; empty if it cannot be read.
inline std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Returns the saved form of an object.
template <class T>
std::string saved(const T& object) {
  std::ostringstream out;
  save(out, object);
  return out.str();
}

/// Returns the message of the InputError that `run` throws, or "no error" if it throws none.
template <class Run>
std::string input_error(Run&& run) {
  try {
    run();
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

/// Returns the same message without the path of the folder, so that messages can be compared as a
/// whole.
template <class Run>
std::string input_error_in(const TemporaryFolder& folder, Run&& run) {
  std::string message = input_error(run);
  const std::string prefix = folder.path().string() + "/";
  for (std::size_t at; (at = message.find(prefix)) != std::string::npos;) {
    message.erase(at, prefix.size());
  }
  return message;
}

}  // namespace pharos::test
