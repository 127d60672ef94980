#include "mesh_source.h"

#include <fstream>
#include <vector>

#include <fmt/core.h>

#include <pharos/core/confinement.h>
#include <pharos/core/error.h>

namespace pharos {

std::string read_regular_file(const std::filesystem::path& path) {
  std::error_code failed;
  const auto status = std::filesystem::status(path, failed);
  if (!exists(status)) throw InputError("there is no such file" + file_suggestion(path));
  if (!is_regular_file(status)) throw InputError("it is not a regular file");
  if (const std::string problem = confinement_problem(path); !problem.empty()) {
    throw InputError(problem);
  }
  const std::uintmax_t size = std::filesystem::file_size(path, failed);
  std::ifstream file(path, std::ios::binary);
  if (failed || !file) throw InputError("it cannot be opened");
  std::string bytes(size, '\0');
  if (!file.read(bytes.data(), static_cast<std::streamsize>(size))) {
    throw InputError("it cannot be read");
  }
  return bytes;
}

void check_part(const std::string& part, const std::set<std::string>& names) {
  if (part.empty() || names.contains(part)) return;
  const std::vector<std::string> list(names.begin(), names.end());
  throw InputError(fmt::format("it has no part '{}'{}; its parts are {}", part,
                               suggestion(part, list), quoted_list(list)));
}

}  // namespace pharos
