// Invalid files, each with its complete error message.

#include <map>
#include <string>
#include <sys/stat.h>
#include <vector>

#include "document_test_kit.h"

namespace pharos::mitsuba {
namespace {

/// Returns the error message, after "scene.xml:1:", for a scene of one line with this content.
std::string wrong(const std::string& inside) {
  constexpr std::string_view head = "scene.xml:1:";
  const std::string message = refusal("<scene version=\"0.6.0\">" + inside + "</scene>");
  return message.starts_with(head) ? message.substr(head.size()) : message;
}

struct Case {
  std::string text, message;
};
using Cases = std::vector<Case>;

void check(const Cases& cases) {
  for (const Case& c : cases) {
    CAPTURE(c.text);
    CHECK(wrong(c.text) == c.message);
  }
}

TEST_CASE("files that are no XML or no scene") {
  const auto utf16 = std::string("\xff\xfe<\0s\0", 6);
  const Cases cases{
      {"", "1:1: error: expected <scene version=\"…\">, found the end of the file"},
      {"scene", "1:1: error: expected a tag, found text"},
      {"<scene version=\"3.0.0\">",
       "1:23: error: expected the end tag of the element that was "
       "begun last"},
      {"<scene version=\"3.0.0\">\n <a></b></scene>",
       "2:7: error: expected the end tag of the element that was begun last"},
      {"<scene version=3.0.0/>", "1:16: error: expected an attribute such as name=\"radius\""},
      {"<scene version=\"3.0.0\"/><scene version=\"3.0.0\"/>",
       "1:25: error: expected one outermost element, found a second one"},
      {"<scene version=\"3.0.0\"/> text", "1:25: error: expected a tag, found text"},
      {"<!-- <scene/>", "1:13: error: expected the end '-->' of a comment"},
      {"<shape type=\"sphere\"/>", "1:1: error: expected <scene version=\"…\">, found <shape>"},
      {"<scene/>", "1:1: error: <scene> needs the attribute 'version'"},
      {"<scene versoin=\"3.0.0\"/>",
       "1:17: error: <scene> has no attribute 'versoin' (did you mean 'version'?)"},
      {"<scene version=\"4.0.0\"/>",
       "1:17: error: expected a version such as 0.6.0 or 3.0.0, found '4.0.0'"},
      {"<scene version=\"new\"/>",
       "1:17: error: expected a version such as 0.6.0 or 3.0.0, found 'new'"},
      {"<!DOCTYPE scene [<!ENTITY a \"b\">]><scene version=\"3.0.0\"/>",
       "1:11: error: document types (<!DOCTYPE …>) are not read"},
      {utf16, " error: expected UTF-8, found UTF-16"},
      {std::string("<scene\0/>", 9), "1:7: error: expected UTF-8, found the byte 0x00"},
      {"<!-- \xe4 -->", "1:6: error: expected UTF-8, found the byte 0xe4"},
      {"<!-- \xed\xa0\x80 -->", "1:6: error: expected UTF-8, found the byte 0xed"},
  };
  for (const Case& c : cases) {
    CAPTURE(c.text);
    CHECK(refusal(c.text) == "scene.xml:" + c.message);
  }
}

TEST_CASE("tags and attributes") {
  check({
      {"<shpae type=\"x\"/>", "24: error: unknown tag <shpae> (did you mean 'shape'?)"},
      {"<xyzzy/>", "24: error: unknown tag <xyzzy>"},
      {"<rotate x=\"1\" angle=\"3\"/>", "24: error: <rotate> can stand in a <transform> only"},
      {"<scene version=\"0.6.0\"/>", "24: error: <scene> can be the outermost tag only"},
      {"text", "24: error: expected a tag, found text"},
      {"<![CDATA[x]]>", "33: error: expected a tag, found text"},
      {"<shape id=\"x\"/>", "24: error: <shape> needs the attribute 'type'"},
      {"<shape type=\"\"/>", "37: error: expected the name of a plugin, found nothing"},
      {"<shape type=\"a\" type=\"b\"/>", "24: error: the attribute 'type' is there twice"},
      {"<shape type=\"a\" nmae=\"b\"/>",
       "46: error: <shape> has no attribute 'nmae' (did you mean 'name'?)"},
      {"<float name=\"a\"/>", "24: error: <float> needs the attribute 'value'"},
      {"<float value=\"1\"/>", "24: error: <float> needs the attribute 'name'"},
      {"<float name=\"\" value=\"1\"/>", "37: error: expected a name, found nothing"},
      {"<float name=\"a\" value=\"1\"><b/></float>",
       "50: error: nothing may stand in a <float>, found <b>"},
      {"<point name=\"a\" x=\"1\" y=\"2\"/>",
       "24: error: <point> needs the attribute 'z', or all in 'value'"},
      {"<point name=\"a\" x=\"1\" y=\"2\" z=\"3\" value=\"1\"/>",
       "24: error: <point> needs either 'value' or 'x', 'y' and 'z'"},
  });
}

TEST_CASE("values") {
  check({
      {"<float name=\"a\" value=\"\"/>", "47: error: expected a finite number, found ''"},
      {"<float name=\"a\" value=\"nan\"/>", "47: error: expected a finite number, found 'nan'"},
      {"<float name=\"a\" value=\"-inf\"/>", "47: error: expected a finite number, found '-inf'"},
      {"<float name=\"a\" value=\"1e999\"/>", "47: error: expected a finite number, found '1e999'"},
      {"<float name=\"a\" value=\"0x10\"/>", "47: error: expected a finite number, found '0x10'"},
      {"<float name=\"a\" value=\"1 2\"/>", "47: error: expected a finite number, found '1 2'"},
      {"<float name=\"a\" value=\"+-1\"/>", "47: error: expected a finite number, found '+-1'"},
      {"<integer name=\"a\" value=\"1.5\"/>", "49: error: expected a whole number, found '1.5'"},
      {"<integer name=\"a\" value=\"9223372036854775808\"/>",
       "49: error: expected a whole number, found '9223372036854775808'"},
      {"<boolean name=\"a\" value=\"yes\"/>", "49: error: expected 'true' or 'false', found 'yes'"},
      {"<point name=\"a\" value=\"1 2\"/>",
       "47: error: expected one or three numbers, found '1 2'"},
      {"<point name=\"a\" x=\"1e39\" y=\"0\" z=\"0\"/>",
       "43: error: expected a finite number, found '1e39'"},
      {"<rgb name=\"a\" value=\"1 2\"/>",
       "45: error: expected one or three numbers, or a color such as #ff8000, found '1 2'"},
      {"<rgb name=\"a\" value=\"#12345g\"/>",
       "45: error: expected a color such as #ff8000, found '#12345g'"},
      {"<rgb name=\"a\" value=\"1\" intent=\"light\"/>",
       "56: error: expected 'reflectance' or 'illuminant', found 'light'"},
      {"<spectrum name=\"a\"/>", "24: error: <spectrum> needs either 'value' or 'filename'"},
      {"<spectrum name=\"a\" value=\"1 2\"/>",
       "50: error: expected one or three numbers, or pairs wavelength:value, found '1 2'"},
      {"<spectrum name=\"a\" value=\"400:1, 500\"/>",
       "50: error: expected wavelength:value, found '500'"},
      {"<spectrum name=\"a\" value=\"400:1\"/>",
       "50: error: expected at least two pairs wavelength:value, found '400:1'"},
      {"<spectrum name=\"a\" value=\"400:1 400:2\"/>",
       "50: error: expected rising wavelengths, found 400 after 400"},
      {"<spectrum name=\"a\" value=\"400:1e300 500:1e300\"/>",
       "24: error: expected a spectrum with a color of finite numbers"},
      {"<spectrum name=\"a\" filename=\"none.spd\"/>",
       "53: error: 'none.spd' cannot be read: no such file"},
      {"<blackbody name=\"a\" temperature=\"-5K\"/>",
       "57: error: expected kelvins above 0, found '-5K'"},
  });
}

TEST_CASE("transforms") {
  const auto in = [](const std::string& step) {
    return "<transform name=\"t\">" + step + "</transform>";
  };
  check({
      {in("<rotat angle=\"1\"/>"),
       "44: error: <rotat> is no step of a transform (did you mean 'rotate'?)"},
      {in("<rotate x=\"1\"/>"), "44: error: <rotate> needs the attribute 'angle'"},
      {in("<rotate angle=\"1\" x=\"0\"/>"), "44: error: the rotation axis has no direction"},
      {in("<scale/>"), "44: error: <scale> needs either 'value' or 'x', 'y' and 'z'"},
      {in("<scale value=\"0\"/>"), "44: error: the transform cannot be inverted"},
      {in("<matrix value=\"1 2 3\"/>"), "59: error: expected 16 or 9 numbers, found 3"},
      {in("<matrix value=\"1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1\"/>"),
       "59: error: expected the last row 0 0 0 1: the map must be affine"},
      {in("<matrix value=\"1 1 0 1 1 0 0 0 1\"/>"), "44: error: the transform cannot be inverted"},
      {in("<lookat origin=\"0 0 0\" target=\"0 0 0\"/>"),
       "44: error: expected an origin and a target that differ"},
      {in("<lookat origin=\"0 0\" target=\"0 0 1\"/>"),
       "60: error: expected three numbers, found '0 0'"},
      {in("<lookat origin=\"0 0 0\" target=\"0 1 0\" up=\"0 2 0\"/>"),
       "44: error: look_at: up is parallel to the direction from origin to target"},
      {"<animation name=\"t\"/>", "24: error: expected <transform time=\"…\"> in an <animation>"},
  });
}

TEST_CASE("variables, ids and cycles") {
  check({
      {"<default name=\"spp\" value=\"1\"/><float name=\"a\" value=\"$ssp\"/>",
       "78: error: unknown variable '$ssp' (did you mean 'spp'?)"},
      {"<float name=\"a\" value=\"$\"/>",
       "47: error: expected the name of a variable after '$', or '\\$'"},
      {"<default name=\"\" value=\"1\"/>", "39: error: expected a name of 1 to 100 letters"},
      {"<bsdf type=\"a\" id=\"wall\"/><ref id=\"wlal\"/>",
       "50: error: nothing has the id 'wlal' (did you mean 'wall'?)"},
      {"<bsdf type=\"a\" id=\"w\"/>\n<bsdf type=\"a\" id=\"w\"/>",
       "scene.xml:2:1: error: the id 'w' is taken: see scene.xml:1:24"},
      {"<alias id=\"a\" as=\"b\"/>", "24: error: nothing has the id 'a'"},
      {"<alias id=\"a\" as=\"b\"/><alias id=\"b\" as=\"a\"/>",
       "24: error: expected at most 64 aliases from 'b' to an object; do they name each other?"},
      {"<bsdf type=\"a\" id=\"w\"><ref id=\"w\"/></bsdf>",
       "46: error: 'w' contains itself by this reference"},
      {"<bsdf type=\"a\" id=\"v\"><ref id=\"w\"/></bsdf><bsdf type=\"a\" id=\"w\"><ref id=\"v\"/>"
       "</bsdf>",
       "88: error: 'v' contains itself by this reference"},
  });
  CHECK(refusal("<scene version=\"3.0.0\"><default name=\"spp\" value=\"1\"/></scene>",
                {{"sp", "2"}}) ==
        "scene.xml: error: the scene has no variable 'sp' (did you mean 'spp'?)");
}

TEST_CASE("texts that double with each default") {
  std::string text = "<default name=\"v0\" value=\"ha\"/>";
  for (int i = 1; i < 40; ++i) {
    const std::string before = "$v" + std::to_string(i - 1) + " ";
    text += "\n<default name=\"v" + std::to_string(i) + "\" value=\"" + before + before + "\"/>";
  }
  CHECK(wrong(text) ==
        "scene.xml:20:28: error: expected at most 1 MiB of text in an attribute and 64 MiB in all "
        "that come from variables");
}

TEST_CASE("objects that double with each reference") {
  std::string text = "<bsdf type=\"b\" id=\"b0\"/>";
  for (int i = 1; i < 30; ++i) {
    const std::string before = "<ref id=\"b" + std::to_string(i - 1) + "\"/>";
    text += "\n<bsdf type=\"b\" id=\"b" + std::to_string(i) + "\">" + before + before + "</bsdf>";
  }
  CHECK(wrong(text) ==
        "1: error: this scene stands for more than 10000000 objects when its references are "
        "followed");
}

TEST_CASE("chains of references") {
  std::string text = "<bsdf type=\"b\" id=\"b0\"/>";
  for (int i = 1; i < 64; ++i) {
    text += "\n<bsdf type=\"b\" id=\"b" + std::to_string(i) + "\"><ref id=\"b" +
            std::to_string(i - 1) + "\"/></bsdf>";
  }
  CHECK(wrong(text).find("more than 64 deep") != std::string::npos);
}

TEST_CASE("a million elements") {
  std::string text;
  for (int i = 0; i < 1'000'001; ++i) text += "<x/>";
  CHECK(wrong(text) == "4000020: error: expected at most a million elements");
}

TEST_CASE("attributes without end") {
  std::string many;
  for (int i = 0; i < 33; ++i) many += " a" + std::to_string(i) + "=\"\"";
  CHECK(wrong("<float" + many + "/>") == "250: error: expected at most 32 attributes");
  CHECK(wrong("<rgb value=\"" + std::string((1 << 20) + 1, '1') + "\"/>") ==
        "36: error: expected at most 1 MiB of text in an attribute");
  CHECK(wrong("<bsdf type=\"b\" id=\"" + std::string(500'000, 'a') + "\"/><ref id=\"" +
              std::string(500'000, 'b') + "\"/>")
            .find(": error: nothing has the id 'bbbbbb") != std::string::npos);
}

TEST_CASE("eight million attributes") {
  CHECK(wrong("<x " + std::string(8'000'000, '=')) ==
        "8000026: error: expected at most eight million attributes");
}

TEST_CASE("includes") {
  const test::TemporaryFolder folder;
  const auto file = folder.write("scene.xml",
                                 "<scene version=\"3.0.0\">\n"
                                 "<include filename=\"part.xml\"/></scene>");
  const auto message = [&] {
    return pharos::test::input_error_in(folder, [&] { read_document(file); });
  };
  CHECK(message() == "scene.xml:2:20: error: 'part.xml' cannot be read: no such file");
  folder.write("pat.xml", "");
  CHECK(message() ==
        "scene.xml:2:20: error: 'part.xml' cannot be read: no such file (did you "
        "mean 'pat.xml'?)");
  std::filesystem::create_directory(folder / "part.xml");
  CHECK(message() ==
        "scene.xml:2:20: error: 'part.xml' cannot be read: expected a file, found a "
        "folder");
  std::filesystem::remove(folder / "part.xml");
  REQUIRE(mkfifo((folder / "part.xml").c_str(), 0600) == 0);
  CHECK(message() ==
        "scene.xml:2:20: error: 'part.xml' cannot be read: expected a file, found a "
        "pipe or device");
  std::filesystem::remove(folder / "part.xml");
  folder.write("part.xml", "<scene version=\"3.0.0\"><include filename=\"scene.xml\"/></scene>");
  CHECK(message() == "part.xml:1:43: error: 'scene.xml' includes itself");
  folder.write("part.xml", "<float name=\"a\" value=\"1\"/>");
  CHECK(message() ==
        "part.xml:1:1: error: expected a scene or an object in an included file, found <float>");
  folder.write("part.xml", "<scene><flaot/></scene>");
  CHECK(message() == "part.xml:1:8: error: unknown tag <flaot> (did you mean 'float'?)");
}

TEST_CASE("includes that fan out") {
  const test::TemporaryFolder folder;
  for (int level = 0; level < 12; ++level) {
    std::string text = "<scene version=\"3.0.0\">";
    for (int i = 0; level < 11 && i < 10; ++i) {
      text += "<include filename=\"" + std::to_string(level + 1) + ".xml\"/>";
    }
    folder.write(std::to_string(level) + ".xml", text + "</scene>");
  }
  CHECK(pharos::test::input_error_in(folder, [&] {
          read_document(folder / "0.xml");
        }).find("a scene may read at most 4096 files") != std::string::npos);
}

TEST_CASE("files that are not there") {
  const test::TemporaryFolder folder;
  const auto message = [&](const std::string& name) {
    return pharos::test::input_error_in(folder, [&] { read_document(folder / name); });
  };
  CHECK(message("scene.xml") == "scene.xml: error: no such file");
  CHECK(pharos::test::input_error([] { read_document("/dev/zero"); }) ==
        "/dev/zero: error: expected a file, found a pipe or device");
  folder.write("scene.xml", "<scene version=\"3.0.0\"><path value=\"tex\"/></scene>");
  CHECK(message("scene.xml") == "scene.xml:1:37: error: there is no folder 'tex'");
}

TEST_CASE("files beyond 256 MiB") {
  const test::TemporaryFolder folder;
  const auto file = folder.write("scene.xml", "");
  std::filesystem::resize_file(file, (std::uintmax_t{256} << 20) + 1);
  CHECK(pharos::test::input_error_in(folder, [&] { read_document(file); }) ==
        "scene.xml: error: the files of a scene may have 256 MiB together");
}

}  // namespace
}  // namespace pharos::mitsuba
