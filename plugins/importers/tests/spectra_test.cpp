// Colors and spectra compared with values from other sources: D65 is the white of Rec.709, equal
// power has the chromaticity (1/3, 1/3), and tables give the colors of black bodies.

#include <cmath>
#include <string>

#include "../shared/color_matching.h"
#include "document_test_kit.h"

namespace pharos::mitsuba {
namespace {

using importing::black_body, importing::color_in_daylight, importing::color_of_light;

Spectrum read(const std::string& tag, const std::string& attributes,
              const std::string& parent = "bsdf") {
  CAPTURE(attributes);
  const Document d = read_old("<" + parent + " type=\"x\"><" + tag + " name=\"v\" " + attributes +
                              "/></" + parent + ">");
  return value<Spectrum>(child(*d.scene), "v");
}

bool is_near(Rgb a, Rgb b, float tolerance) {
  return std::abs(a.r - b.r) <= tolerance && std::abs(a.g - b.g) <= tolerance &&
         std::abs(a.b - b.b) <= tolerance;
}

TEST_CASE("rgb is linear, in each spelling") {
  CHECK(read("rgb", "value=\"0.1, 0.2 0.3\"").value == Rgb(0.1f, 0.2f, 0.3f));
  CHECK(read("rgb", "value=\"#ff8000\"").value == Rgb(1, 128.0f / 255, 0));
  CHECK(read("rgb", "value=\"0.5\" intent=\"illuminant\"").value == Rgb(0.5f));
  CHECK(read("rgb", "value=\"0.5\"").is_gray);
  CHECK_FALSE(read("rgb", "value=\"0.5 0.5 0.5\"").is_gray);
  CHECK_FALSE(read("rgb", "value=\"0.5\"").approximated);
}

TEST_CASE("srgb is decoded") {
  CHECK(is_near(read("srgb", "value=\"0.5, 0.04, 1\"").value, {0.21404f, 0.0030960f, 1}, 1e-5f));
  CHECK(is_near(read("srgb", "value=\"#bc0a00\"").value, {0.50289f, 0.0030353f, 0}, 1e-5f));
}

TEST_CASE("spectra of one number and of three") {
  CHECK(read("spectrum", "value=\"0.25\" intent=\"Reflectance\"").value == Rgb(0.25f));
  CHECK(read("spectrum", "value=\"0.25\"").is_gray);
  CHECK(read("spectrum", "value=\"1, 2, 3\"").value == Rgb(1, 2, 3));
}

TEST_CASE("a flat reflectance is gray, flat emission has equal power") {
  const std::string flat = "value=\"300:0.5, 900:0.5\"";
  CHECK(is_near(read("spectrum", flat).value, Rgb(0.5f), 1e-5f));
  CHECK(read("spectrum", flat).approximated);
  CHECK_FALSE(read("spectrum", flat).is_gray);
  // The XYZ of equal power is (1, 1, 1), so the color is the sums of the rows of the matrix to
  // Rec.709.
  CHECK(is_near(read("spectrum", flat, "emitter").value,
                0.5f * Rgb(1.204794f, 0.948291f, 0.908916f), 1e-5f));
}

TEST_CASE("spectra out of gamut and beyond one") {
  const Rgb green = read("spectrum", "value=\"500:0, 510:1 540:1, 550:0\"").value;
  CHECK(green.r == 0);
  CHECK(green.g > 0.2f);
  CHECK(green.g <= 1);
  const Rgb orange = read("spectrum", "value=\"565:0, 570:1, 900:1\"").value;
  CHECK(orange.r == 1);
  const Rgb brighter = read("spectrum", "value=\"565:0, 570:1.001, 900:1.001\"").value;
  CHECK(brighter.r > 1.01f);  // not a reflectance, so there is no limit
  const Rgb index = read("spectrum", "value=\"300:1.5, 900:3.0\"").value;
  CHECK(index.r > index.g);
  CHECK(index.g > index.b);
  CHECK(index.b > 1.8f);
  CHECK(index.r < 2.4f);
}

TEST_CASE("weights are those of the CIE's tables") {
  // A ramp from 0 at 400 nm to 1 at 700 nm, summed with the CIE tables in steps of 5 nm.
  const auto ramp = [](double nm) { return nm < 400 || nm > 700 ? 0.0 : (nm - 400) / 300; };
  CHECK(is_near(color_in_daylight(ramp), {0.8057f, 0.4769f, 0.1362f}, 0.004f));
  CHECK(is_near(color_of_light(ramp), {0.9412f, 0.4547f, 0.1136f}, 0.004f));
}

TEST_CASE("black bodies have Planck's radiance and the chromaticities of the tables") {
  // 2 h c^2 / lambda^5 / (exp(h c / (lambda k T)) - 1) at 500 nm and 5000 K is 1.2107e13 W/(m^3
  // sr).
  CHECK(black_body(5000, 500) == doctest::Approx(1.2107e4).epsilon(1e-3));
  const auto chromaticity = [](double kelvin) {
    const Rgb c = read("blackbody", "temperature=\"" + std::to_string(kelvin) + "K\"").value;
    const float x = 0.412453f * c.r + 0.357580f * c.g + 0.180423f * c.b;
    const float y = 0.212671f * c.r + 0.715160f * c.g + 0.072169f * c.b;
    const float z = 0.019334f * c.r + 0.119193f * c.g + 0.950227f * c.b;
    return std::pair(x / (x + y + z), y / (x + y + z));
  };
  const auto [x, y] = chromaticity(5000);  // Planckian locus: 0.3451, 0.3516
  CHECK(x == doctest::Approx(0.3451).epsilon(0.01));
  CHECK(y == doctest::Approx(0.3516).epsilon(0.01));
  const auto [u, v] = chromaticity(2856);  // illuminant A: 0.4476, 0.4074
  CHECK(u == doctest::Approx(0.4476).epsilon(0.01));
  CHECK(v == doctest::Approx(0.4074).epsilon(0.01));
  const Rgb once = read("blackbody", "temperature=\"3000\"").value;
  const Rgb twice = read("blackbody", "temperature=\"3000 k\" scale=\"2\"").value;
  CHECK(is_near(twice, 2 * once, 1e-4f * once.r));
}

TEST_CASE("a spectrum in a file is one in the scene") {
  const test::TemporaryFolder folder;
  folder.write("glass.spd", "# nm value\n400 0.2\r\n\n500\t0.4\n700 1\n");
  const auto file =
      folder.write("scene.xml",
                   "<scene version=\"3.0.0\"><spectrum name=\"a\" filename=\"glass.spd\"/>"
                   "<spectrum name=\"b\" value=\"400:0.2, 500:0.4, 700:1\"/></scene>");
  const Document d = read_document(file);
  CHECK(value<Spectrum>(*d.scene, "a").value == value<Spectrum>(*d.scene, "b").value);
  folder.write("glass.spd", "400 0.2\n300 1\n");
  CHECK(pharos::test::input_error_in(folder, [&] { read_document(file); }) ==
        "glass.spd:2:1: error: expected rising wavelengths, found 300 after 400");
  folder.write("glass.spd", "400 0.2\n500 nan\n");
  CHECK(pharos::test::input_error_in(folder, [&] { read_document(file); }) ==
        "glass.spd:2:1: error: expected a wavelength and a value, found '500 nan'");
  folder.write("glass.spd", "400 0.2\n");
  CHECK(pharos::test::input_error_in(folder, [&] { read_document(file); }) ==
        "glass.spd: error: expected at least two pairs of wavelength and value");
}

TEST_CASE("a spectrum with a type is a texture") {
  const Document document = read_new("<spectrum type=\"d65\" name=\"r\"/>");
  const Object& texture = child(*document.scene, "r");
  CHECK(texture.tag == "texture");
  CHECK(texture.type == "d65");
}

}  // namespace
}  // namespace pharos::mitsuba
