// The object tree: objects, names, references, variables, includes, locations.

#include <string>

#include "document_test_kit.h"

namespace pharos::mitsuba {
namespace {

bool same(const Property::Value& a, const Property::Value& b);

bool same(const Object& a, const Object& b) {
  if (a.tag != b.tag || a.type != b.type || a.id != b.id) return false;
  if (a.properties.size() != b.properties.size()) return false;
  for (std::size_t i = 0; i < a.properties.size(); ++i) {
    const Property &p = a.properties[i], &q = b.properties[i];
    if (p.name != q.name || !same(p.value, q.value)) return false;
  }
  return true;
}

bool same(const Property::Value& a, const Property::Value& b) {
  if (a.index() != b.index()) return false;
  if (const auto* s = std::get_if<Spectrum>(&a)) return s->value == std::get<Spectrum>(b).value;
  if (const auto* t = std::get_if<Triple>(&a)) return t->value == std::get<Triple>(b).value;
  if (const auto* t = std::get_if<Transform>(&a)) {
    return t->matrix() == std::get<Transform>(b).matrix();
  }
  if (const auto* o = std::get_if<std::shared_ptr<const Object>>(&a)) {
    return same(**o, *std::get<std::shared_ptr<const Object>>(b));
  }
  if (const auto* v = std::get_if<bool>(&a)) return *v == std::get<bool>(b);
  if (const auto* v = std::get_if<std::int64_t>(&a)) return *v == std::get<std::int64_t>(b);
  if (const auto* v = std::get_if<double>(&a)) return *v == std::get<double>(b);
  return std::get<std::string>(a) == std::get<std::string>(b);
}

constexpr std::string_view kOldScene = R"(<?xml version="1.0" encoding="utf-8"?>
<scene version="0.5.0">
  <integrator type="path"><integer name="maxDepth" value="7"/></integrator>
  <sensor type="perspective">
    <float name="fov" value="35"/>
    <string name="fovAxis" value="smaller"/>
    <transform name="toWorld">
      <lookAt origin="0, 1, 5" target="0, 1, 0" up="0, 1, 0"/>
    </transform>
    <film type="hdrfilm"><integer name="width" value="64"/><rfilter type="box"/></film>
  </sensor>
  <bsdf type="dielectric" id="glass"><float name="intIOR" value="1.5"/></bsdf>
  <shape type="sphere">
    <point name="center" x="1" y="2" z="3"/>
    <ref id="glass"/>
  </shape>
  <medium type="homogeneous"><rgb name="sigmaT" value="1, 2, 3"/></medium>
</scene>
)";

constexpr std::string_view kNewScene = R"(<scene version="3.5.0">
  <integrator type="path"><integer name="max_depth" value="7"/></integrator>
  <sensor type="perspective">
    <float name="fov" value="35"/>
    <string name="fov_axis" value="smaller"/>
    <transform name="to_world"><lookat origin="0 1 5" target="0 1 0" up="0 1 0"/></transform>
    <film type="hdrfilm"><integer name="width" value="64"/><rfilter type="box"/></film>
  </sensor>
  <bsdf type="dielectric" id="glass"><float name="int_ior" value="1.5"/></bsdf>
  <shape type="sphere">
    <point name="center" value="1 2 3"/>
    <ref id="glass"/>
  </shape>
  <medium type="homogeneous"><rgb name="sigma_t" value="1 2 3"/></medium>
</scene>
)";

TEST_CASE("both dialects of a scene make the same tree") {
  const Document a = read_text(kOldScene), b = read_text(kNewScene);
  CHECK(same(*a.scene, *b.scene));
  CHECK(a.scene->properties.size() == 5);
  const Document other = read_old("<sensor type=\"x\"><film type=\"f\"/></sensor>");
  CHECK_FALSE(same(child(child(*other.scene)), *a.scene));
}

TEST_CASE("names become those of Mitsuba 2 in scenes of dialect 0.x alone") {
  const auto name_of = [](const Document& d) { return d.scene->properties.at(0).name; };
  for (const auto& names :
       std::map<std::string, std::string>{{"toWorld", "to_world"},
                                          {"intIOR", "int_ior"},
                                          {"extIOR", "ext_ior"},
                                          {"sigmaT", "sigma_t"},
                                          {"alphaU", "alpha_u"},
                                          {"to_world", "to_world"},
                                          {"maxDepth", "max_depth"},
                                          {"aBcD", "a_bc_d"},
                                          {"RGBvalue", "RGBvalue"},
                                          {"specularSamplingWeight", "specular_sampling_weight"},
                                          {"x", "x"}}) {
    const std::string &written = names.first, &expected = names.second;
    CAPTURE(written);
    const std::string tag = "<float name=\"" + written + "\" value=\"1\"/>";
    CHECK(name_of(read_old(tag)) == expected);
    CHECK(name_of(read_new(tag)) == written);
  }
  CHECK(child(*read_old("<bsdf type=\"roughPlastic\" name=\"aB\"/>").scene, "a_b").type ==
        "roughplastic");
}

TEST_CASE("references name one object, also one that comes later or has an alias") {
  const Document d = read_new(
      "<shape type=\"sphere\"><ref id=\"second\" name=\"bsdf\"/></shape>"
      "<bsdf type=\"diffuse\" id=\"first\"/><alias id=\"first\" as=\"second\"/>");
  const Object& shape = child(*d.scene);
  CHECK(child(shape, "bsdf").type == "diffuse");
  const auto bsdf = std::get<std::shared_ptr<const Object>>(d.scene->properties.at(1).value);
  CHECK(&child(shape, "bsdf") == bsdf.get());
  CHECK(shape.find("bsdf")->where.column == 45);
}

TEST_CASE("variables: the caller's values before the first default") {
  const std::string text =
      "<scene version=\"2.1.0\"><default name=\"a\" value=\"1\"/><default name=\"ab\" value=\"2\"/>"
      "<default name=\"a\" value=\"9\"/><default name=\"c\" value=\"$a-$ab\"/>"
      "<string name=\"s\" value=\"$a $ab $c \\$a $[x] $abc\"/></scene>";
  CHECK(value<std::string>(*read_text(text).scene, "s") == "1 2 1-2 $a $[x] 2c");
  CHECK(value<std::string>(*read_text(text, {{"a", "7"}}).scene, "s") == "7 2 7-2 $a $[x] 2c");
}

TEST_CASE("variables that only the caller gives") {
  const std::string text = "<scene version=\"2.1.0\"><string name=\"s\" value=\"$a\"/></scene>";
  CHECK(value<std::string>(*read_text(text, {{"a", "7"}}).scene, "s") == "7");
  CHECK(refusal(text) == "scene.xml:1:48: error: unknown variable '$a'");
}

TEST_CASE("included scenes give their children, included objects themselves") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "parts/deep");
  folder.write("parts/scene.xml",
               "<scene version=\"0.6.0\"><include filename=\"deep/bsdf.xml\"/>"
               "<shape type=\"cube\"><float name=\"aB\" value=\"$v\"/></shape></scene>");
  folder.write("parts/deep/bsdf.xml", "<bsdf type=\"diffuse\" version=\"3.0.0\" id=\"i\"/>");
  folder.write("parts/deep/other.xml", "<bsdf type=\"plastic\" version=\"3.0.0\"/>");
  const auto file =
      folder.write("main.xml",
                   "<scene version=\"3.0.0\"><default name=\"v\" value=\"4\"/>\n"
                   "<path value=\"parts\"/><include filename=\"scene.xml\"/>"
                   "<shape type=\"cube\"><include filename=\"deep/other.xml\" name=\"it\"/>"
                   "<ref id=\"i\"/></shape></scene>");
  const Document d = read_document(file);
  REQUIRE(d.scene->properties.size() == 3);
  CHECK(child(*d.scene).type == "diffuse");
  CHECK(child(*d.scene).where.file == (folder / "parts/deep/bsdf.xml").string());
  const auto cube = std::get<std::shared_ptr<const Object>>(d.scene->properties[1].value);
  CHECK(value<double>(*cube, "a_b") == 4);
  const auto last = std::get<std::shared_ptr<const Object>>(d.scene->properties[2].value);
  CHECK(child(*last, "it").type == "plastic");
  CHECK(child(*last).id == "i");
  CHECK(d.folder == folder.path());
  CHECK(d.resource_folders == std::vector{folder / "parts"});
}

TEST_CASE("locations are those of tags, a byte order mark aside") {
  const Document d = read_text(
      "\xef\xbb\xbf<scene version=\"3.0.0\">\r\n\n  <shape type=\"sphere\">"
      "<!-- a\ncomment --><float name=\"r\" value=\"1\"/></shape></scene>");
  CHECK(d.scene->where.line == 1);
  CHECK(d.scene->where.column == 1);
  const Object& shape = child(*d.scene);
  CHECK(shape.where.line == 3);
  CHECK(shape.where.column == 3);
  CHECK(shape.find("r")->where.line == 4);
  CHECK(shape.find("r")->where.column == 12);
}

TEST_CASE("what is read in another way is noted once, with how often") {
  const Document d = read_old("<mode type=\"final\"/><hide><shape type=\"x\"/></hide><hide/>");
  CHECK(d.scene->properties.empty());
  REQUIRE(d.notes.size() == 2);
  CHECK(d.notes[1].message == "<hide> is no tag of Mitsuba: left out");
  CHECK(d.notes[1].times == 2);
  CHECK(d.notes[1].where.column == 44);
}

TEST_CASE("of two properties of the same name the last one counts") {
  const Document d = read_old(
      "<bsdf type=\"x\"><float name=\"aB\" value=\"1\"/><string name=\"c\" value=\"d\"/>"
      "<float name=\"aB\" value=\"2\"/></bsdf>");
  const Object& bsdf = child(*d.scene);
  CHECK(value<double>(bsdf, "a_b") == 2);
  CHECK(bsdf.properties.size() == 2);
  REQUIRE(d.notes.size() == 1);
  CHECK(d.notes[0].message == "<bsdf> has two properties 'a_b': the last one counts");
}

TEST_CASE("luminaires and cameras of Mitsuba 0.3") {
  const Document d = read_text(
      "<scene version=\"0.3.0\"><camera type=\"perspective\">"
      "<boolean name=\"mapSmallerSide\" value=\"false\"/>"
      "<transform name=\"toWorld\"><translate x=\"2\"/></transform></camera>"
      "<luminaire type=\"constant\"><rgb name=\"intensity\" value=\"1\"/></luminaire></scene>");
  const Object& camera = child(*d.scene);
  CHECK(camera.tag == "sensor");
  CHECK(value<std::string>(camera, "fov_axis") == "larger");
  CHECK(camera.find("map_smaller_side") == nullptr);
  CHECK(value<Transform>(camera, "to_world").point({1, 0, 0}) == Vec3{1, 0, 0});
  const auto light = std::get<std::shared_ptr<const Object>>(d.scene->properties[1].value);
  CHECK(light->tag == "emitter");
  CHECK(value<Spectrum>(*light, "radiance").value == Rgb(1));
}

TEST_CASE("nesting of 64 is read") {
  const auto nested = [](int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += "<bsdf type=\"b\">";
    for (int i = 0; i < count; ++i) text += "</bsdf>";
    return text;
  };
  CHECK(child(*read_new(nested(63)).scene).type == "b");
  CHECK(pharos::test::input_error([&] { read_new(nested(64)); }).find("more than 64 deep") !=
        std::string::npos);
}

}  // namespace
}  // namespace pharos::mitsuba
