// The bytes are a scene file of Mitsuba. Wrong input may only end in an InputError of one line,
// which names the file. If a file is accepted, it must be possible to walk its whole tree.
//
// No path leads out of a folder of fixtures: slashes in attribute values become blanks, and so do
// characters that begin a numeric character reference.

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <string>
#include <string_view>

#include <pharos/tests/fixtures.h>

#include "mitsuba/document/document.h"

namespace {

using namespace pharos;

/// The files that scenes may name: valid files, one that includes itself, and one spectrum.
const test::TemporaryFolder& fixtures() {
  static const test::TemporaryFolder folder;
  static const bool filled = [] {
    folder.write("a.xml",
                 "<scene version=\"0.6.0\"><default name=\"w\" value=\"2\"/>"
                 "<bsdf type=\"diffuse\" id=\"inc\"/></scene>");
    folder.write("b.xml", "<bsdf version=\"3.0.0\" type=\"diffuse\"><ref id=\"inc\"/></bsdf>");
    folder.write("c.xml", "<scene version=\"3.0.0\"><include filename=\"c.xml\"/></scene>");
    folder.write("s.spd", "# nm\n400 0.1\n700 0.9\n");
    return true;
  }();
  static_cast<void>(filled);
  return folder;
}

/// Replaces slashes and beginnings of numeric character references by blanks. Slashes of tags,
/// which are next to a bracket, are kept.
std::string keep_in_folder(std::string_view bytes) {
  std::string kept(bytes);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const bool of_tag =
        (i > 0 && kept[i - 1] == '<') || (i + 1 < kept.size() && kept[i + 1] == '>');
    const bool begins_number = kept[i] == '&' && i + 1 < kept.size() && kept[i + 1] == '#';
    if ((kept[i] == '/' && !of_tag) || begins_number) kept[i] = ' ';
  }
  return kept;
}

void expect(bool holds) {
  if (!holds) std::abort();
}

void walk(const mitsuba::Object& object, std::set<const mitsuba::Object*>& seen, int depth) {
  expect(depth <= 64 && !object.tag.empty() && object.where.line > 0 && object.where.column > 0);
  if (!seen.insert(&object).second) return;
  for (const mitsuba::Property& property : object.properties) {
    expect(property.where.line > 0 && property.where.column > 0);
    if (const auto* number = std::get_if<double>(&property.value)) {
      expect(std::isfinite(*number));
    } else if (const auto* spectrum = std::get_if<mitsuba::Spectrum>(&property.value)) {
      expect(is_finite(spectrum->value));
    } else if (const auto* child =
                   std::get_if<std::shared_ptr<const mitsuba::Object>>(&property.value)) {
      expect(*child != nullptr);
      walk(**child, seen, depth + 1);
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto file = fixtures().write("fuzz.xml", keep_in_folder(bytes));
  try {
    const mitsuba::Document document = mitsuba::read_document(file);
    std::set<const mitsuba::Object*> seen;
    walk(*document.scene, seen, 1);
  } catch (const InputError& error) {
    const std::string_view message = error.what();
    expect(error.located() && message.find('\n') == std::string_view::npos);
  }
  return 0;
}
