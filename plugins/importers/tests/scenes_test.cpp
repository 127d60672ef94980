// Scenes made by others, in the folder PHAROS_MITSUBA_SCENES if it is set.

#include <filesystem>
#include <string>

#include "document_test_kit.h"

namespace pharos::mitsuba {
namespace {

TEST_CASE("every scene file of a folder is read") {
  const std::string folder = PHAROS_MITSUBA_SCENES;
  if (folder.empty()) {
    MESSAGE("no folder of scenes: see PHAROS_MITSUBA_SCENES");
    return;
  }
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".xml") continue;
    CAPTURE(entry.path().string());
    CHECK(pharos::test::input_error([&] { read_document(entry.path()); }) == "no error");
    ++count;
  }
  CHECK(count > 0);
}

}  // namespace
}  // namespace pharos::mitsuba
