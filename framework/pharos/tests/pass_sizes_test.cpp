#include <vector>

#include <doctest/doctest.h>

#include <pharos/rendering/pass_sizes.h>

namespace pharos {
namespace {

/// Returns the sizes of all passes of an untimed iteration.
std::vector<std::uint32_t> passes_of(std::uint32_t samples, std::uint32_t recorded,
                                     std::uint32_t granule = 1) {
  PassSizes sizes({.samples = samples}, recorded, granule, 0);
  std::vector<std::uint32_t> passes;
  for (std::uint32_t done = 0; done < samples; done += passes.back()) {
    passes.push_back(sizes.next(done, 0));
  }
  return passes;
}

using Passes = std::vector<std::uint32_t>;

TEST_CASE("pass sizes: passes double what is done, up to an eighth of the samples") {
  CHECK(passes_of(64, 0) == Passes{1, 1, 2, 4, 8, 8, 8, 8, 8, 8, 8});
  CHECK(passes_of(64, 0, 16) == Passes{16, 16, 16, 16});
}

TEST_CASE("pass sizes: recorded passes and their units are small, and end where records end") {
  CHECK(passes_of(64, 64) == Passes{1, 1, 2, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4});
  CHECK(passes_of(64, 6) == Passes{1, 1, 2, 2, 6, 8, 8, 8, 8, 8, 8, 4});
  const PassSizes sizes({.samples = 64}, 6, 1, 0);
  CHECK(sizes.unit(0) == 4);
  CHECK(sizes.unit(5) == 4);
  CHECK(sizes.unit(6) == 64);
}

TEST_CASE("pass sizes: a long iteration has longer passes and units, a timed one does not") {
  CHECK(passes_of(65536, 0).at(20) == 1024);
  CHECK(passes_of(65536, 65536).at(20) == 4096);
  CHECK(PassSizes({.samples = 65536}, 0, 1, 0).unit(0) == 256);
  CHECK(PassSizes({.samples = 65536}, 65536, 1, 0).unit(0) == 4);
  CHECK(PassSizes({.samples = 4096}, 0, 1, 0).unit(0) == 64);
  PassSizes timed({.deadline = 1e6}, 0, 1, 0);
  CHECK(timed.unit(0) == 64);
  std::uint32_t done = 0;
  for (int i = 0; i < 20; ++i) done += timed.next(done, 1e-3 * done);
  CHECK(timed.next(done, 1e-3 * done) == 64);
}

TEST_CASE("pass sizes: a timed pass is at most twice as large as the one before") {
  // A sample takes a little longer than 1/128 of the time, and later a little less.
  PassSizes sizes({.deadline = 128}, 0, 1, 0);
  std::uint32_t done = 0;
  for (int i = 0; i < 50; ++i) done += sizes.next(done, 1.01 * done);
  CHECK(done == 50);
  CHECK(sizes.next(done, 0.99 * done) == 2);
}

}  // namespace
}  // namespace pharos
