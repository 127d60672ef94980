// Tests that the content of the cache never changes sets that are synthesized on demand.

#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/tests/fixtures.h>

#include "../point_set_file.h"
#include "../point_set_library.h"

namespace pharos::aligned {
namespace {

namespace fs = std::filesystem;
using pharos::test::TemporaryFolder;

const std::vector<double> kPair{30, 70};

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> all;
  for (const auto& entry : fs::directory_iterator(folder)) all.push_back(entry.path());
  return all;
}

std::string saved(const StoredSets& stored) {
  std::ostringstream out;
  save_point_sets(out, stored);
  return std::move(out).str();
}

StoredSets loaded(const std::string& text) {
  std::istringstream in(text);
  return load_point_sets(in);
}

StoredSets two_sets() {
  return {.key = 42, .sets = {{{1, 2}, {3, 65535}}, {{0, 0}, {7, 9}}}};
}

}  // namespace

TEST_CASE("point set files: what is saved is loaded") {
  const StoredSets stored = loaded(saved(two_sets()));
  CHECK(stored.key == 42);
  CHECK(stored.sets == two_sets().sets);
  CHECK(loaded(saved({})).sets.empty());
}

TEST_CASE("point set files: every byte is guarded") {
  const std::string good = saved(two_sets());
  const std::size_t key = good.find('\n') + 1;  // chosen by the writer and not part of the checksum
  for (std::size_t i = 0; i < good.size(); ++i) {
    if (i >= key && i < key + sizeof(std::uint64_t)) continue;
    CAPTURE(i);
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x10);
    CHECK_THROWS_AS(loaded(bad), InputError);
    CHECK_THROWS_AS(loaded(good.substr(0, i)), InputError);
  }
  CHECK_THROWS_AS(loaded(good + "x"), InputError);
}

TEST_CASE("point lists: x and y a line, exact") {
  const TemporaryFolder folder;
  write_point_list(folder / "points.txt", {{0, 0x8000}, {0xffff, 1}});
  std::ifstream in(folder / "points.txt");
  for (const GridPoint expected : {GridPoint{0, 0x8000}, GridPoint{0xffff, 1}}) {
    float x = 0, y = 0;
    REQUIRE(static_cast<bool>(in >> x >> y));
    CHECK(x == expected.position().x);
    CHECK(y == expected.position().y);
  }
}

TEST_CASE("cache: made once, found again, and never the reason for other points") {
  const TemporaryFolder folder;
  const PointSetLibrary library({.cache_folder = folder / "sets"});
  const PointSet made = library.find(kPair, 64);
  REQUIRE(made.size() == 64);
  REQUIRE(fs::exists(folder / "sets"));
  const std::vector<fs::path> files = files_in(folder / "sets");
  REQUIRE(files.size() == 1);
  const std::string good = pharos::test::bytes_of(files.front());
  CHECK(library.find(kPair, 64) == made);
  // Symmetric directions share one file.
  CHECK(library.find(std::vector<double>{20, 60}, 64).size() == 64);
  CHECK(files_in(folder / "sets").size() == 1);
  // A damaged file, a truncated file, a file with other sets, and an empty file.
  for (const std::string& bad : {good.substr(0, good.size() - 1) + '\x55', good.substr(0, 50),
                                 saved(two_sets()), std::string()}) {
    folder.write("sets/" + files.front().filename().string(), bad);
    CHECK(library.find(kPair, 64) == made);
    CHECK(pharos::test::bytes_of(files.front()) == good);
  }
  fs::remove_all(folder / "sets");
  CHECK(library.find(kPair, 64) == made);
}

TEST_CASE("cache: the points that it holds are those that are used") {
  const TemporaryFolder folder;
  const SetCache cache(folder.path());
  const SynthesisSettings settings = settings_of({64, {30, 70}});
  PointSet other(64);
  other[5] = {12345, 54321};
  CHECK_FALSE(cache.find(settings).has_value());
  cache.keep(settings, other);
  CHECK(cache.find(settings) == other);
  SynthesisSettings longer = settings;
  longer.steps += 1;
  CHECK_FALSE(cache.find(longer).has_value());
  CHECK(cache.file(longer) != cache.file(settings));
}

TEST_CASE("cache: a folder that cannot be written costs time only") {
  const TemporaryFolder folder;
  folder.write("file", "where the folder should be");
  const PointSetLibrary library({.cache_folder = folder / "file"});
  CHECK(library.find(kPair, 64).size() == 64);
  CHECK(pharos::test::bytes_of(folder / "file") == "where the folder should be");
}

}  // namespace pharos::aligned
