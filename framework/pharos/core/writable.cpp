#include <unistd.h>

#include <fmt/format.h>

#include <pharos/core/atomic_file.h>
#include <pharos/core/error.h>
#include <pharos/core/writable.h>

namespace pharos {

void check_writable(const std::filesystem::path& file) {
  if (file.empty()) return;
  std::error_code failed;
  // A link stays; what it points to is replaced.
  const std::filesystem::path target = link_target(file);
  const std::filesystem::path folder =
      target.has_parent_path() ? target.parent_path() : std::filesystem::path(".");
  if (!std::filesystem::is_directory(folder, failed)) {
    throw InputError(
        fmt::format("{}: error: the folder '{}' does not exist", file.string(), folder.string()));
  }
  using std::filesystem::file_type;
  const file_type type = std::filesystem::status(file, failed).type();
  if (type == file_type::none) {
    throw InputError(one_line(fmt::format("{}: error: {}", file.string(), failed.message())));
  }
  if (type == file_type::directory) {
    throw InputError(fmt::format("{}: error: is a folder, not a file", file.string()));
  }
  if (type != file_type::not_found && type != file_type::regular) {
    throw InputError(fmt::format("{}: error: is a pipe or device, not a file", file.string()));
  }
  if (access(folder.c_str(), W_OK) != 0) {
    throw InputError(
        fmt::format("{}: error: the folder '{}' is not writable", file.string(), folder.string()));
  }
}

}  // namespace pharos
