// The bytes are a scene file of pbrt. Wrong input may only end in an InputError of one line, which
// names the file. If a file is accepted, its config must have a scene.
//
// No path leads out of a folder of fixtures: slashes become blanks.

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include <pharos/tests/fixtures.h>

#include "pbrt/pbrt_importer.h"

namespace {

using namespace pharos;

/// The files that scenes may name: a valid one, one that includes itself, and one spectrum.
const test::TemporaryFolder& fixtures() {
  static const test::TemporaryFolder folder;
  static const bool filled = [] {
    folder.write("a.pbrt", "Translate 1 2 3\nMaterial \"diffuse\"\n");
    folder.write("c.pbrt", "Include \"c.pbrt\"\n");
    folder.write("s.spd", "400 0.1\n700 0.9\n");
    return true;
  }();
  static_cast<void>(filled);
  return folder;
}

void expect(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string text(reinterpret_cast<const char*>(data), size);
  std::replace(text.begin(), text.end(), '/', ' ');
  std::replace(text.begin(), text.end(), '\\', ' ');
  const auto file = fixtures().write("fuzz.pbrt", text);
  try {
    const Import import = PbrtImporter().import(file);
    expect(import.config.find("scene") != nullptr);
    for (const ImportNote& note : import.notes) {
      expect(note.message.find('\n') == std::string::npos);
    }
  } catch (const InputError& error) {
    const std::string_view message = error.what();
    expect(error.located() && message.find('\n') == std::string_view::npos);
  }
  return 0;
}
