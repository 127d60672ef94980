// Invalid scenes of pbrt, each with its complete error message.

#include <string>
#include <vector>

#include "pbrt_test_kit.h"

namespace pharos::pbrt {
namespace {

struct Case {
  std::string text, message;
};

void check(const std::vector<Case>& cases) {
  for (const Case& c : cases) {
    CAPTURE(c.text);
    CHECK(test::refusal(c.text) == "scene.pbrt:" + c.message);
  }
}

/// Cases in the third line of a scene, after its camera and WorldBegin.
void check_world(const std::vector<Case>& cases) {
  for (const Case& c : cases) {
    CAPTURE(c.text);
    CHECK(test::refusal("Camera \"perspective\"\nWorldBegin\n" + c.text) ==
          "scene.pbrt:3:" + c.message);
  }
}

TEST_CASE("pbrt: files that are no scenes") {
  check({{"hello", "1:1: error: expected a directive, found 'hello'"},
         {"\n  Shap \"sphere\"",
          "2:3: error: expected a directive, found 'Shap' (did you mean 'Shape'?)"},
         {"\"Shape\"", "1:1: error: expected a directive, found the text 'Shape'"},
         {"3", "1:1: error: expected a directive, found '3'"},
         {"]", "1:1: error: expected a directive, found ']'"},
         {"Camera \"perspective", "1:8: error: the text has no closing quote in its line"},
         {"Camera \"persp\n\"", "1:8: error: the text has no closing quote in its line"},
         {"Camera", "1:7: error: expected a name or type in quotes, found the end of the file"},
         {"Camera perspective",
          "1:8: error: expected a name or type in quotes, found 'perspective'"}});
}

TEST_CASE("pbrt: transforms") {
  check({{"Translate 1 2", "1:14: error: expected a number, found the end of the file"},
         {"Translate 1 2 x", "1:15: error: expected a number, found 'x'"},
         {"Translate 1 2 1e99", "1:15: error: expected a number, found '1e99'"},
         {"Translate 1 2 nan", "1:15: error: expected a number, found 'nan'"},
         {"Scale [ 1 2 3", "1:14: error: expected ] after 3 numbers, found the end of the file"},
         {"Scale 1 0 1", "1:1: error: the transform cannot be inverted"},
         {"Transform [ 1 0 0 1 0 1 0 0 0 0 1 0 0 0 0 1 ]",
          "1:1: error: the last row of the matrix must be 0 0 0 1 (columns are written one after "
          "the other)"},
         {"CoordSysTransform \"camera\"", "1:1: error: there is no coordinate system 'camera'"},
         {"CoordinateSystem \"lamp\" CoordSysTransform \"lmap\"",
          "1:25: error: there is no coordinate system 'lmap' (did you mean 'lamp'?)"},
         {"Option \"seed\"",
          "1:14: error: expected the value of the option, found the end of the file"},
         {"ActiveTransform Start",
          "1:17: error: expected All, StartTime or EndTime, found 'Start'"}});
}

TEST_CASE("pbrt: parameters") {
  check({{"Film \"rgb\" \"int xresolution\" 3",
          "1:12: error: unknown type of parameter 'int'; known: 'integer', 'float', 'point2', "
          "'vector2', 'point3', 'point', 'vector3', 'vector', 'normal', 'normal3', 'bool', "
          "'string', 'texture', 'spectrum', 'rgb', 'blackbody'"},
         {"Film \"rgb\" \"color x\" [1 1 1]",
          "1:12: error: 'color' is a type of pbrt-v3; pbrt-v4 has 'rgb' (pbrt itself converts "
          "files with --upgrade)"},
         {"Film \"rgb\" \"xresolution\" 3",
          "1:12: error: expected a parameter such as \"float fov\", found the text "
          "'xresolution'"},
         {"Film \"rgb\" \"integer xresolution\"",
          "1:33: error: 'xresolution' is of type integer, found the end of the file"},
         {"Film \"rgb\" \"integer xresolution\" 3.5",
          "1:34: error: 'xresolution' is of type integer, found '3.5'"},
         {"Film \"rgb\" \"integer xresolution\" \"3\"",
          "1:34: error: 'xresolution' is of type integer, found the text '3'"},
         {"Film \"rgb\" \"integer xresolution\" [ 3",
          "1:37: error: expected ] after the values of 'xresolution', found the end of the file"},
         {"Film \"rgb\" \"integer xresolution\" [ ]", "1:12: error: 'xresolution' has no values"},
         {"Film \"rgb\" \"integer xresolution\" [ 3 4 ]",
          "1:12: error: 'xresolution' must be one number"},
         {"Film \"rgb\" \"string filename\" 3",
          "1:30: error: 'filename' is of type string, found '3'"},
         {"Camera \"perspective\" \"bool x\" maybe",
          "1:31: error: 'x' is of type bool, found 'maybe'"},
         {"Camera \"perspective\" \"point3 x\" [ 1 2 ]",
          "1:22: error: 'x' is of type point3 and has 2 numbers, which is not a multiple of 3"}});
}

TEST_CASE("pbrt: the view") {
  check({{"Camera \"perspektive\"",
          "1:1: error: unknown Camera 'perspektive' (did you mean 'perspective'?); known: "
          "'orthographic', 'perspective', 'realistic', 'spherical'"},
         {"Camera \"perspective\" \"float fov\" 180",
          "1:22: error: the field of view must be above 0 and below 180 degrees"},
         {"Camera \"perspective\" \"float fov\" -1", "1:22: error: 'fov' must be above 0"},
         {"Camera \"perspective\" \"float screenwindow\" [ 1 1 0 1 ]",
          "1:22: error: 'screenwindow' must extend to the right"},
         {"Camera \"perspective\" \"float screenwindow\" [ 1 1 0 ]",
          "1:22: error: 'screenwindow' must be 4 numbers"},
         {"PixelFilter \"boxy\"",
          "1:1: error: unknown PixelFilter 'boxy' (did you mean 'box'?); known: 'box', "
          "'gaussian', 'mitchell', 'sinc', 'triangle'"},
         {"Integrator \"pathh\"",
          "1:1: error: unknown Integrator 'pathh' (did you mean 'path'?); known: "
          "'ambientocclusion', 'bdpt', 'function', 'lightpath', 'mlt', 'path', 'randomwalk', "
          "'simplepath', 'simplevolpath', 'sppm', 'volpath'"},
         {"WorldBegin WorldBegin", "1:12: error: WorldBegin stands twice"},
         {"WorldBegin Camera \"perspective\"", "1:12: error: Camera must stand before WorldBegin"},
         {"Shape \"sphere\"", "1:1: error: Shape must stand after WorldBegin"},
         {"LightSource \"point\"", "1:1: error: LightSource must stand after WorldBegin"}});
}

TEST_CASE("pbrt: all objects with errors are found at once, each error once") {
  const std::vector<std::string> flaws = test::flaws(
      "Camera \"perspectiv\"\n"
      "WorldBegin\n"
      "Texture \"t\" \"spectrum\" \"imagmap\"\n"
      "Material \"diffuse\" \"texture reflectance\" \"t\"\n"
      "Material \"conductor\" \"texture reflectance\" \"t\"\n"
      "Shape \"spere\"\n"
      "Shape \"sphere\" \"float radius\" -1\n"
      "LightSource \"pont\"\n"
      "AttributeEnd\n"
      "Shape \"spere\"\n");
  REQUIRE(flaws.size() == 6);  // the texture counts once, and not again where it is used
  const char* places[] = {"1:1", "3:1", "6:1", "7:16", "8:1", "9:1"};
  for (std::size_t i = 0; i < flaws.size(); ++i) {
    CAPTURE(flaws[i]);
    CHECK(flaws[i].find(std::string("scene.pbrt:") + places[i] + ": error: ") == 0);
  }
}

TEST_CASE("pbrt: blocks") {
  check_world(
      {{"AttributeEnd", "1: error: AttributeEnd without AttributeBegin"},
       {"ObjectEnd", "1: error: ObjectEnd without ObjectBegin"},
       {"AttributeBegin", "15: error: the AttributeBegin in line 3 has no end"},
       {"AttributeBegin TransformEnd",
        "16: error: TransformEnd where the AttributeBegin in line 3 must end first"},
       {"ObjectBegin \"a\" ObjectBegin \"b\"", "17: error: ObjectBegin within another object"},
       {"ObjectBegin \"a\" ObjectEnd ObjectBegin \"a\"",
        "27: error: the object 'a' is defined twice"},
       {"ObjectInstance \"a\"", "1: error: there is no object 'a'"},
       {"ObjectBegin \"a\" ObjectInstance \"a\" ObjectEnd",
        "17: error: ObjectInstance within an object"},
       {"Attribute \"shapes\" \"float radius\" 3",
        "1: error: Attribute has no target 'shapes' (did you mean 'shape'?); known: 'shape', "
        "'light', 'material', 'medium', 'texture'"},
       {"ColorSpace \"adobe\"",
        "1: error: unknown color space 'adobe'; known: 'srgb', 'rec2020', 'dci-p3', "
        "'aces2065-1'"},
       {"Include \"none.pbrt\"",
        "1: error: 'none.pbrt': no such file (did you mean 'scene.pbrt'?)"},
       {"Include \"scene.pbrt\"", "1: error: 'scene.pbrt' includes itself"}});
}

TEST_CASE("pbrt: materials and textures") {
  check_world(
      {{"Material \"diffus\"",
        "1: error: unknown Material 'diffus' (did you mean 'diffuse'?); known: '', "
        "'coatedconductor', 'coateddiffuse', 'conductor', 'dielectric', 'diffuse', "
        "'diffusetransmission', 'hair', 'interface', 'measured', 'mix', 'none', 'subsurface', "
        "'thindielectric'"},
       {"MakeNamedMaterial \"a\"", "1: error: MakeNamedMaterial 'a': 'type' is missing"},
       {"MakeNamedMaterial \"a\" \"string type\" \"diffuse\" MakeNamedMaterial \"a\" \"string "
        "type\" \"diffuse\"",
        "47: error: the material 'a' is defined twice"},
       {"NamedMaterial \"a\"", "1: error: there is no material 'a'"},
       {"MakeNamedMaterial \"gold\" \"string type\" \"diffuse\" NamedMaterial \"glod\"",
        "50: error: there is no material 'glod' (did you mean 'gold'?)"},
       {"Material \"mix\"", "1: error: Material mix: 'materials' must be two names"},
       {"Material \"dielectric\" \"float eta\" 1000",
        "23: error: 'eta' must be between 0.01 and 100"},
       {"Material \"dielectric\" \"spectrum eta\" \"glass-BK8\"",
        "23: error: 'glass-BK8' is neither a spectrum's name (did you mean 'glass-BK7'?) nor a "
        "file: no such file"},
       {"Material \"diffuse\" \"string reflectance\" \"a\"",
        "20: error: 'reflectance' must be a color: one 'rgb', 'spectrum' or 'blackbody'"},
       {"Material \"diffuse\" \"rgb reflectance\" [ 1 1 1 0 0 0 ]",
        "20: error: 'reflectance' must be a color: one 'rgb', 'spectrum' or 'blackbody'"},
       {"Material \"diffuse\" \"spectrum reflectance\" [ 400 1 500 ]",
        "20: error: 'reflectance' must be pairs of a wavelength and a value, at least two"},
       {"Material \"diffuse\" \"spectrum reflectance\" [ 500 1 400 1 ]",
        "20: error: expected rising wavelengths, found 400 after 500"},
       {"Material \"diffuse\" \"texture reflectance\" \"wood\"",
        "20: error: there is no texture 'wood'"},
       {"Texture \"wood\" \"color\" \"constant\"",
        "1: error: a texture is of type 'float' or 'spectrum', found 'color'"},
       {"Texture \"wood\" \"float\" \"constnt\"",
        "1: error: unknown Texture 'constnt' (did you mean 'constant'?); known: 'bilerp', "
        "'checkerboard', 'constant', 'directionmix', 'dots', 'fbm', 'imagemap', 'marble', 'mix', "
        "'ptex', 'scale', 'windy', 'wrinkled'"},
       {"Texture \"wood\" \"float\" \"imagemap\"",
        "1: error: Texture imagemap: 'filename' is missing"},
       {"Texture \"a\" \"float\" \"constant\" Texture \"a\" \"float\" \"constant\"",
        "32: error: the texture 'a' is defined twice"}});
}

TEST_CASE("pbrt: lights, shapes and media") {
  check_world(
      {{"LightSource \"sun\"",
        "1: error: unknown LightSource 'sun'; known: 'distant', 'goniometric', 'infinite', "
        "'point', 'projection', 'spot'"},
       {"LightSource \"point\" \"blackbody I\" -3",
        "21: error: 'I' must be one temperature between 100 and 1000000 kelvin"},
       {"LightSource \"point\" \"float scale\" -1", "21: error: 'scale' must be at least 0"},
       {"LightSource \"spot\" \"float coneangle\" 200",
        "20: error: 'coneangle' must be above 0 and at most 180 degrees"},
       {"LightSource \"distant\" \"point3 to\" [ 0 0 0 ]",
        "23: error: 'from' and 'to' are the same point"},
       {"AreaLightSource \"diffus\" Shape \"sphere\"",
        "1: error: unknown AreaLightSource 'diffus' (did you mean 'diffuse'?); known: 'diffuse'"},
       {"Shape \"cone\"",
        "1: error: unknown Shape 'cone'; known: 'bilinearmesh', 'curve', 'cylinder', 'disk', "
        "'loopsubdiv', 'plymesh', 'sphere', 'trianglemesh'"},
       {"Shape \"sphere\" \"float radius\" 0", "16: error: 'radius' must be above 0"},
       {"Shape \"sphere\" \"bool radius\" true", "16: error: 'radius' must be one number"},
       {"Shape \"cylinder\" \"float zmin\" 1", "18: error: 'zmin' must differ from 'zmax'"},
       {"Shape \"disk\" \"float radius\" 1e-40", "1: error: the transform cannot be inverted"},
       {"Shape \"trianglemesh\"", "1: error: 'P' is missing"},
       {"Shape \"plymesh\"", "1: error: Shape plymesh: 'filename' is missing"},
       {"MediumInterface \"fog\" \"\" Shape \"sphere\"", "26: error: there is no medium 'fog'"},
       {"MakeNamedMedium \"fog\" \"string type\" \"homogenous\"",
        "1: error: unknown MakeNamedMedium 'homogenous' (did you mean 'homogeneous'?); known: "
        "'cloud', 'homogeneous', 'nanovdb', 'rgbgrid', 'uniformgrid'"},
       {"MakeNamedMedium \"fog\" \"float g\" 1", "23: error: 'g' must be above -1 and below 1"},
       {"MakeNamedMedium \"fog\" \"rgb sigma_a\" [ -1 0 0 ]",
        "23: error: 'sigma_a' must be at least 0"}});
}

}  // namespace
}  // namespace pharos::pbrt
