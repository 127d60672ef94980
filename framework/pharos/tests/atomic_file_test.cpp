// Files that appear whole or not at all.

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <sys/syscall.h>
#include <unistd.h>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/atomic_file.h>
#include <pharos/core/error.h>

#include "fixtures.h"

namespace {

/// A call of fsync(): the path that was flushed, and the content of `watched` at that time.
struct Flush {
  std::filesystem::path what;
  std::string content;
};

std::filesystem::path watched;  ///< the file of a test; empty: flushes are not noted
std::vector<Flush> flushes;

}  // namespace

/// Stands in for the C library's function in this program and all of its libraries.
extern "C" int fsync(int file) {
  if (!watched.empty()) {
    flushes.push_back({std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(file)),
                       pharos::test::bytes_of(watched)});
  }
  return static_cast<int>(syscall(SYS_fsync, file));
}

namespace pharos::test {
namespace {

TEST_CASE("atomic files: the new content is on the disk before the name, and both at the end") {
  const TemporaryFolder folder;
  watched = folder.write("a.txt", "old");
  flushes.clear();
  write_text_atomically(watched, "new");
  watched.clear();
  REQUIRE(flushes.size() == 2);
  CHECK(flushes[0].what.extension() == ".tmp");
  CHECK(flushes[0].content == "old");
  CHECK(std::filesystem::equivalent(flushes[1].what, folder.path()));
  CHECK(flushes[1].content == "new");
}

TEST_CASE("atomic files: a failed write keeps the older file, links stay links") {
  const TemporaryFolder folder;
  const auto old = folder.write("a.txt", "old");
  const auto write = [](std::string_view text) {
    return [text](const std::filesystem::path& to) { std::ofstream(to) << text; };
  };
  const auto failing = [](const std::filesystem::path& to) {
    std::ofstream(to) << "half";
    throw RunError("disk full");
  };
  CHECK_THROWS_WITH_AS(write_atomically(old, failing), "disk full", RunError);
  CHECK(bytes_of(old) == "old");
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
  std::filesystem::create_symlink(old, folder / "link.txt");
  write_atomically(folder / "link.txt", write("new"));
  CHECK(std::filesystem::is_symlink(folder / "link.txt"));
  CHECK(bytes_of(old) == "new");
  std::filesystem::create_symlink("/dev/null", folder / "device");
  CHECK_THROWS_AS(write_atomically(folder / "device", write("new")), RunError);
  CHECK(std::filesystem::is_character_file("/dev/null"));
}

}  // namespace
}  // namespace pharos::test
