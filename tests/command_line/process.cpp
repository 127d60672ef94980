#include "process.h"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdlib.h>
#include <sys/wait.h>

#include <fmt/format.h>

namespace pharos::testing {
namespace {

std::string read_and_remove(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  std::filesystem::remove(path);
  return text;
}

Outcome run_shell(const std::string& command, const std::filesystem::path& folder) {
  const auto out = folder / ".stdout", err = folder / ".stderr";
  const std::string line = fmt::format("cd '{}' && {} > '{}' 2> '{}'", folder.string(), command,
                                       out.string(), err.string());
  const int status = std::system(line.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_and_remove(out), read_and_remove(err)};
}

}  // namespace

Outcome run_pharos(const std::string& arguments, const std::filesystem::path& folder) {
  return run_shell(fmt::format("{} {}", PHAROS_PROGRAM, arguments), folder);
}

Outcome interrupt_pharos(const std::string& arguments, const std::filesystem::path& folder,
                         double seconds, const char* signal) {
  return run_shell(fmt::format("timeout --preserve-status --signal={} {} {} {}", signal, seconds,
                               PHAROS_PROGRAM, arguments),
                   folder);
}

ScratchFolder::ScratchFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "pharos-test-XXXXXX").string();
  path_ = mkdtemp(name.data());
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

void ScratchFolder::write(const std::string& name, const std::string& text) const {
  std::ofstream(path_ / name) << text;
}

std::size_t ScratchFolder::file_count() const {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(path_)) ++count;
  return count;
}

}  // namespace pharos::testing
