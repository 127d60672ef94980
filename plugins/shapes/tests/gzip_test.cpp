// Meshes packed by gzip, and files that only look like it.

#include <pbrt_syntax/gzip.h>
#include <string>
#include <zlib.h>

#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/tests/fixtures.h>

#include "../mesh.h"

namespace pharos {
namespace {

/// Returns a gzip file of `plain`.
std::string gzip_of(const std::string& plain) {
  constexpr int kGzip = 16, kMemory = 8;
  z_stream state{};
  REQUIRE(deflateInit2(&state, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kGzip + MAX_WBITS, kMemory,
                       Z_DEFAULT_STRATEGY) == Z_OK);
  std::string packed(deflateBound(&state, plain.size()), '\0');
  state.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(plain.data()));
  state.avail_in = static_cast<uInt>(plain.size());
  state.next_out = reinterpret_cast<Bytef*>(packed.data());
  state.avail_out = static_cast<uInt>(packed.size());
  REQUIRE(deflate(&state, Z_FINISH) == Z_STREAM_END);
  packed.resize(state.total_out);
  deflateEnd(&state);
  return packed;
}

constexpr std::size_t kMostUnpacked = 1 << 20;

std::string refusal_of_gzip(const std::string& bytes) {
  return test::input_error([&] { pbrt::unpacked(bytes, kMostUnpacked); });
}

}  // namespace

TEST_CASE("gzip: files are unpacked, other bytes are not") {
  const std::string text = "some text that is packed, " + std::string(300'000, 'x');
  CHECK(pbrt::unpacked(gzip_of(text), kMostUnpacked) == text);
  CHECK(pbrt::unpacked(gzip_of(text) + gzip_of("more"), kMostUnpacked) == text + "more");
  CHECK(pbrt::unpacked(gzip_of(""), kMostUnpacked).empty());
  for (const char* plain : {"", "\x1f", "ply\n"})
    CHECK(pbrt::unpacked(plain, kMostUnpacked) == plain);
}

TEST_CASE("gzip: files that are cut off, damaged or too large are refused") {
  const std::string packed = gzip_of("some text");
  for (std::size_t size = 2; size < packed.size(); ++size) {
    CAPTURE(size);
    CHECK(refusal_of_gzip(packed.substr(0, size)) == "its gzip data are cut off");
  }
  std::string damaged = packed;
  damaged[packed.size() - 6] ^= 1;  // the checksum
  CHECK(refusal_of_gzip(damaged) == "its gzip data are damaged");
  CHECK(refusal_of_gzip(packed + "garbage") == "its gzip data are damaged");
  CHECK(refusal_of_gzip(gzip_of(std::string(kMostUnpacked, ' '))) == "no error");
  CHECK(refusal_of_gzip(gzip_of(std::string(kMostUnpacked + 1, ' '))) ==
        "its gzip data hold more than 1048576 bytes, the most that is possible here");
}

TEST_CASE("meshes packed by gzip") {
  const test::TemporaryFolder folder;
  const std::string triangle = "v 0 0 0\nv 2 0 0\nv 0 3 0\nf 1 2 3\n";
  const auto load = [&](const char* name, const std::string& bytes) {
    return Mesh({.file = folder.write(name, bytes)}).area();
  };
  CHECK(load("triangle.obj.gz", gzip_of(triangle)) == doctest::Approx(3));
  CHECK(load("TRIANGLE.OBJ.GZ", gzip_of(triangle)) == doctest::Approx(3));
  CHECK(load("plain.obj.gz", triangle) == doctest::Approx(3));
  const auto refusal = [&](const char* name, const std::string& bytes) {
    return test::input_error_in(folder, [&] { load(name, bytes); });
  };
  CHECK(refusal("cut.obj.gz", gzip_of(triangle).substr(0, 20)) ==
        "mesh 'cut.obj.gz': its gzip data are cut off");
  CHECK(refusal("triangle.xyz.gz", gzip_of(triangle)).find("the format '.xyz' is not known") !=
        std::string::npos);
  // A small file of 32 MiB.
  CHECK(refusal("bomb.obj.gz", gzip_of(std::string(std::size_t{32} << 20, '\n')))
            .find("the most that is possible here") != std::string::npos);
}

}  // namespace pharos
