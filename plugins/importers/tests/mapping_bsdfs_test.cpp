#include <doctest/doctest.h>

#include <pharos/core/error.h>

#include "mapping_test_kit.h"

namespace pharos::mitsuba::test {
namespace {

constexpr Dialect kOld = Dialect::mitsuba_0, kNew = Dialect::mitsuba_2;

bool has_note(const Import& import, const std::string& message) {
  const std::vector<std::string> all = notes(import);
  return std::find(all.begin(), all.end(), message) != all.end();
}

}  // namespace

TEST_CASE("bsdfs: defaults are Mitsuba's") {
  const auto is = [](const char* type, const char* yaml) {
    CAPTURE(type);
    CHECK(material_of(bsdf(type), kOld) == yaml);
  };
  is("diffuse", "{ type: diffuse, reflectance: 0.5 }");
  is("difftrans", "{ type: diffuse_transmitter, transmittance: 0.5 }");
  is("conductor", "{ type: conductor, material: Cu }");
  is("roughconductor",
     "{ type: rough_conductor, material: Cu, alpha: 0.1, distribution: beckmann, masking: "
     "separable "
     "}");
  is("phong",
     "{ type: phong, diffuse_reflectance: 0.5, specular_reflectance: 0.2, exponent: 30, "
     "rescale_to: 0.99 }");
  is("roughdiffuse", "{ type: rough_diffuse, reflectance: 0.5, alpha: 0.2 }");
  is("null", "{ type: pass_through }");
  is("ward",
     "{ type: ward, diffuse_reflectance: 0.5, specular_reflectance: 0.2, alpha_u: 0.1, alpha_v: "
     "0.1, variant: balanced }");
}

TEST_CASE("bsdfs: a conductor of no stated metal is copper in 0.x, a mirror in 2 and 3") {
  CHECK(material_of(bsdf("conductor"), kOld) == "{ type: conductor, material: Cu }");
  CHECK(material_of(bsdf("conductor"), kNew) == "{ type: conductor, material: ideal }");
}

TEST_CASE("bsdfs: metals by name") {
  const auto metal = [](const char* name) {
    return import_of_bsdf(bsdf("conductor", {value("material", name, 3)}));
  };
  CHECK(part(metal("Au"), "scene.shapes.0.material.material") == "Au");
  CHECK(part(metal("none"), "scene.shapes.0.material.material") == "ideal");
  CHECK(part(metal("W"), "scene.shapes.0.material.material") == "Cr");
  CHECK(has_note(metal("W"),
                 "bsdf conductor: metal 'W' is replaced by chromium; state 'eta' and 'k'"));
  CHECK_THROWS_WITH_AS(metal("Aux"),
                       "scene.xml:3:5: error: unknown metal 'Aux' (did you mean 'Au'?); known: "
                       "'Ag', 'Al', 'Au', 'Cr', 'Cu', 'Fe', 'Ni', 'Ti', 'none'",
                       InputError);
}

TEST_CASE("bsdfs: stated indices of metals are those over the outside's") {
  const auto metal = [](std::vector<Property> more) {
    std::vector<Property> all{value("eta", rgb(0.2f, 0.8f, 1)), value("k", rgb(4, 2, 2))};
    all.insert(all.end(), more.begin(), more.end());
    return material_of(bsdf("conductor", all));
  };
  CHECK(metal({}) == "{ type: conductor, eta: [0.2, 0.8, 1], k: [4, 2, 2] }");
  CHECK(metal({value("ext_eta", 2.0)}) ==
        "{ type: conductor, eta: [0.1, 0.4, 0.5], k: [2, 1, 1] }");
  CHECK_THROWS_AS(material_of(bsdf("conductor", {value("eta", 0.2)})), InputError);
}

TEST_CASE(
    "bsdfs: negative components of a metal's index, as from spectra, are raised with a note") {
  const Import import = import_of_bsdf(
      bsdf("conductor", {value("eta", rgb(0.2f, -0.8f, 1)), value("k", rgb(4, 2, -2))}));
  CHECK(part(import, "scene.shapes.0.material") ==
        "{ type: conductor, eta: [0.2, 0.0001, 1], k: [4, 2, 0] }");
  const std::vector<std::string> all = notes(import);
  for (const char* expected : {"bsdf conductor: 'eta' is raised to at least 0.0001",
                               "bsdf conductor: 'k' is raised to at least 0"}) {
    CHECK(std::count(all.begin(), all.end(), expected) == 1);
  }
}

TEST_CASE("bsdfs: refractive indices by number and name") {
  const auto ior = [](std::vector<Property> all, const char* type = "dielectric") {
    return part(import_of_bsdf(bsdf(type, std::move(all))), "scene.shapes.0.material.ior");
  };
  CHECK(ior({value("int_ior", 1.5), value("ext_ior", 1.0)}) == "1.5");
  CHECK(ior({value("int_ior", "diamond"), value("ext_ior", "vacuum")}) == "2.419");
  CHECK(std::stod(ior({value("int_ior", "water"), value("ext_ior", "bk7")})) ==
        doctest::Approx(1.333 / 1.5046));
  CHECK(std::stod(ior({})) == doctest::Approx(1.5046 / 1.000277));
  CHECK(std::stod(ior({}, "thindielectric")) == doctest::Approx(1.5046 / 1.000277));
  CHECK(std::stod(ior({}, "roughplastic")) == doctest::Approx(1.49 / 1.000277));
  CHECK_THROWS_WITH_AS(
      ior({value("int_ior", "watre", 8)}),
      doctest::Contains("scene.xml:8:5: error: 'int_ior': unknown material 'watre' (did you mean "
                        "'water'?)"),
      InputError);
}

TEST_CASE("bsdfs: roughness") {
  const auto rough = [](std::vector<Property> all) {
    all.push_back(value("material", "none"));
    return import_of_bsdf(bsdf("roughconductor", std::move(all)));
  };
  const Import ggx = rough({value("distribution", "ggx"), value("alpha", 0.3)});
  CHECK(notes(ggx).size() == 1);  // only that there is no sensor
  CHECK(part(ggx, "scene.shapes.0.material.alpha") == "0.3");
  CHECK(part(ggx, "scene.shapes.0.material.distribution") == "ggx");
  const Import brushed = rough({value("alpha_u", 0.05), value("alpha_v", 0.3)});
  CHECK(part(brushed, "scene.shapes.0.material") ==
        "{ type: rough_conductor, material: ideal, alpha: 0.05, alpha_v: 0.3, distribution: "
        "beckmann, "
        "masking: separable }");
  CHECK(part(rough({value("alpha", 0.0)}), "scene.shapes.0.material.alpha") == "0.0001");
  CHECK(has_note(rough({value("alpha", 2.0)}),
                 "bsdf roughconductor: roughness above 1 is taken as 1"));
}

TEST_CASE("bsdfs: distributions of microfacets") {
  const auto imported = [](const char* type, std::vector<Property> all) {
    return import_of_bsdf(bsdf(type, std::move(all)));
  };
  for (const char* type : {"roughconductor", "roughdielectric", "roughplastic"}) {
    CAPTURE(type);
    for (const Import& beckmann :
         {imported(type, {}), imported(type, {value("distribution", "beckmann")})}) {
      CHECK(part(beckmann, "scene.shapes.0.material.distribution") == "beckmann");
      CHECK(notes(beckmann).size() == 1);  // only that there is no sensor
    }
    for (const std::string other : {"phong", "as"}) {
      const Import near = imported(type, {value("distribution", other.c_str())});
      CHECK(part(near, "scene.shapes.0.material.distribution") == "beckmann");
      CHECK(has_note(near, "bsdf " + std::string(type) + ": distribution '" + other +
                               "' is replaced by Beckmann's of the same alpha"));
    }
    CHECK_THROWS_WITH_AS(imported(type, {value("distribution", "gxg", 8)}),
                         doctest::Contains("unknown distribution 'gxg' (did you mean 'ggx'?)"),
                         InputError);
  }
}

TEST_CASE("bsdfs: a texture of roughness is averaged, with a note") {
  const Import import = import_of_bsdf(bsdf(
      "roughplastic",
      {nested(texture("checkerboard", {value("color0", 0.1), value("color1", 0.3)}), "alpha")}));
  CHECK(std::stod(part(import, "scene.shapes.0.material.alpha")) == doctest::Approx(0.2));
  CHECK(has_note(import, "bsdf roughplastic: the texture of 'alpha' is replaced by its average"));
}

TEST_CASE("bsdfs: combinations keep the order of their parts") {
  const ObjectRef red = bsdf("diffuse", {value("reflectance", rgb(1, 0, 0))});
  const ObjectRef metal = bsdf("conductor", {value("material", "Al")});
  const std::string red_yaml = "{ type: diffuse, reflectance: [1, 0, 0] }";
  const std::string metal_yaml = "{ type: conductor, material: Al }";
  CHECK(material_of(bsdf("twosided", {nested(red), nested(metal)})) ==
        "{ type: two_sided, bsdf: " + red_yaml + ", back: " + metal_yaml + " }");
  CHECK(material_of(bsdf("blendbsdf", {nested(red), nested(metal), value("weight", 0.25)})) ==
        "{ type: blend, first: " + red_yaml + ", second: " + metal_yaml + ", weight: 0.25 }");
  CHECK(material_of(bsdf("mask", {nested(red)})) ==
        "{ type: mask, opacity: 0.5, bsdf: " + red_yaml + " }");
  CHECK_THROWS_AS(material_of(bsdf("blendbsdf", {nested(red)})), InputError);
}

TEST_CASE("bsdfs: a mixture's shares come out of its chain of blends") {
  const auto gray = [](float x) {
    return nested(bsdf("diffuse", {value("reflectance", rgb(x, x, x))}));
  };
  const auto albedo = [&](const char* weights) {
    const Import import = import_of_bsdf(
        bsdf("mixturebsdf", {value("weights", weights), gray(1), gray(0.1f), gray(0.01f)}));
    return built(import).config.scene.objects[0].bsdf->albedo({}).g;
  };
  CHECK(albedo("0.2, 0.3, 0.5") == doctest::Approx(0.2 + 0.03 + 0.005));
  CHECK(albedo("0.1 0.1 0.2") == doctest::Approx(0.1 + 0.01 + 0.002));  // the rest is black
  CHECK(albedo("2, 3, 5") == doctest::Approx(0.2 + 0.03 + 0.005));
  CHECK(albedo("0, 0, 1") == doctest::Approx(0.01));
  CHECK_THROWS_AS(albedo("0.2, 0.8"), InputError);
  CHECK_THROWS_AS(albedo("0.2, much, 0.8"), InputError);
}

TEST_CASE("bsdfs: maps that bend normals") {
  const Property height = nested(texture("checkerboard"));
  const std::string bump =
      material_of(bsdf("bumpmap", {height, nested(bsdf("diffuse")), value("scale", 3.0)}));
  CHECK(bump.starts_with("{ type: bump_map, texture: { type: checkerboard"));
  CHECK(bump.ends_with("height: 3, bsdf: { type: diffuse, reflectance: 0.5 } }"));
  CHECK(material_of(bsdf("normalmap", {height, nested(bsdf("diffuse"))}))
            .starts_with("{ type: normal_map, texture: { type: checkerboard"));
  CHECK_THROWS_AS(material_of(bsdf("bumpmap", {nested(bsdf("diffuse"))})), InputError);
}

TEST_CASE("bsdfs: principled") {
  CHECK(material_of(bsdf("principled", {value("base_color", rgb(1, 0.5f, 0)),
                                        value("metallic", 0.7), value("eta", 1.6)})) ==
        "{ type: principled, base_color: [1, 0.5, 0], roughness: 0.5, metallic: 0.7, ior: 1.6, "
        "masking: separable }");
  const Import thin = import_of_bsdf(bsdf("principledthin", {value("diff_trans", 0.5)}));
  CHECK(built(thin).config.scene.objects[0].bsdf->albedo({}).r == doctest::Approx(0.5));
  CHECK(part(thin, "scene.shapes.0.material.first.transmittance.factor") == "0.25");
}

TEST_CASE("bsdfs: coats") {
  const Import matt = import_of_bsdf(
      bsdf("coating", {nested(bsdf("diffuse")), value("int_ior", 1.5), value("ext_ior", 1.0)}));
  CHECK(part(matt, "scene.shapes.0.material") ==
        "{ type: plastic, ior: 1.5, reflectance: 0.5, nonlinear: true }");
  const Import metal = import_of_bsdf(bsdf("coating", {nested(bsdf("conductor"))}));
  CHECK(part(metal, "scene.shapes.0.material.type") == "conductor");
  CHECK(has_note(metal, "bsdf coating: the coat is left out"));
}

}  // namespace pharos::mitsuba::test
