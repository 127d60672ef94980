// Tests of integrands: closed forms against brute force, and rejected settings.

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <pharos/laboratory/integrand.h>
#include <pharos/laboratory/integrands/add_integrands.h>
#include <pharos/statistics/quadrature.h>

#include "../../tests/fixtures.h"

namespace pharos::laboratory {
namespace {

Ref<Integrand> integrand(const std::string& yaml) {
  Registry registry;
  add_integrands(registry);
  BuildContext context{registry};
  ConfigNode resolved;
  return registry.build<Integrand>(parse_yaml(yaml, "test"), context, resolved);
}

/// Returns the mean over the cell centers of a grid. It is so fine that a border crosses one cell
/// in a thousand.
double grid_mean(const Integrand& f) {
  constexpr int kEdge = 2000;
  double sum = 0;
  for (int y = 0; y < kEdge; ++y) {
    for (int x = 0; x < kEdge; ++x) {
      sum += f.value({(x + 0.5) / kEdge, (y + 0.5) / kEdge});
    }
  }
  return sum / (kEdge * static_cast<double>(kEdge));
}

void check_mean(const std::string& yaml, double tolerance) {
  CAPTURE(yaml);
  const Ref<Integrand> f = integrand(yaml);
  CHECK(std::abs(f->mean() - grid_mean(*f)) < tolerance);
}

TEST_CASE("means of shapes are those of a fine grid") {
  constexpr double kTolerance = 2e-5;  // averaged error of half the cells that the border crosses
  for (const char* yaml :
       {"{ type: edge, angles: [30] }", "{ type: edge, angles: [0.3], offsets: [0.2501] }",
        "{ type: edge, angles: [-100], offsets: [0.3] }",
        "{ type: edge, angles: [20, 130], offsets: [0.1, 0.15] }",
        "{ type: edge, angles: [75, 200, 310], offsets: [0.2, 0.25, 0.15] }",
        "{ type: edge, angles: [10, 80, 170, 260], offsets: [0.4, 0.4, 0.45, 0.3] }",
        "{ type: triangle, vertices: [[0.15, 0.2], [0.9, 0.35], [0.4, 0.85]] }",
        "{ type: triangle, vertices: [[0.15, 0.2], [0.4, 0.85], [0.9, 0.35]] }",
        "{ type: triangle, vertices: [[-0.5, 0.2], [1.4, 0.35], [0.4, 1.85]] }", "{ type: disk }",
        "{ type: disk, center: [0.1, 0.8], radius: 0.3 }",
        "{ type: disk, center: [0.5, 0.5], radius: 0.6 }",
        "{ type: disk, center: [-0.2, 0.4], radius: 0.5 }",
        "{ type: disk, center: [1.1, 1.2], radius: 0.9 }",
        "{ type: disk, center: [0.4, 0.3], radius: 0.8 }",
        "{ type: disk, center: [-3, 0.4], radius: 3.5 }"}) {
    check_mean(yaml, kTolerance);
  }
}

TEST_CASE("every registered integrand has the mean of a fine grid") {
  Registry all;
  add_integrands(all);
  const std::vector<std::string> names = all.names("integrand");
  CHECK(names.size() >= 8);
  for (const std::string& name : names) check_mean(name, 2e-5);
}

TEST_CASE("half a sky has the same mean by all maps of the hemisphere") {
  for (const char* map : {"polar", "concentric", "octahedral"}) {
    for (const char* edge : {"azimuth: 20, tilt: 60", "azimuth: 155, tilt: 120",
                             "azimuth: 300, tilt: 90", "azimuth: 0, tilt: 0"}) {
      check_mean(fmt::format("{{ type: half_sky, map: {}, {} }}", map, edge), 2e-5);
    }
  }
  CHECK(integrand("{ type: half_sky, tilt: 60 }")->mean() == doctest::Approx(0.75));
  // The corners of the square are horizontal directions.
  CHECK(integrand("{ type: half_sky, tilt: 0 }")->value({0, 0}) == doctest::Approx(0));
}

TEST_CASE("means of textured edges are those of a fine grid") {
  for (const char* yaml :
       {"{ type: textured }", "{ type: textured, angles: [120], frequency: [3, 5] }",
        "{ type: textured, angles: [20, 130], offsets: [0.1, 0.1], frequency: [0.3, -1.7] }",
        "{ type: textured, angles: [90], frequency: [4, 0], contrast: 1 }",
        "{ type: textured, angles: [30], frequency: [0.1, 0.2], contrast: 1 }",
        "{ type: textured, angles: [0], frequency: [0, 2.5] }"}) {
    check_mean(yaml, 2e-5);
  }
}

TEST_CASE("means of smooth integrands are those of quadrature") {
  for (const char* yaml :
       {"{ type: smooth_edge }", "{ type: smooth_edge, angle: 0, offset: 0.2 }",
        "{ type: smooth_edge, angle: 270, offset: -0.1, width: 0.3 }",
        "{ type: smooth_edge, angle: 45, offset: 0.5, width: 1 }",
        "{ type: smooth_edge, angle: 179.999, offset: 0.1, width: 0.05 }",
        "{ type: smooth_edge, angle: 100, offset: 0.1, width: 0.01 }", "{ type: smooth_disk }",
        "{ type: smooth_disk, center: [0.5, 0.45], radius: 0.01, width: 0.07 }", "{ type: smooth }",
        "{ type: smooth, width: 0.25, center: [0.1, 0.9] }",
        "{ type: smooth, width: 0.02, center: [0, 0.99] }"}) {
    CAPTURE(yaml);
    const Ref<Integrand> f = integrand(yaml);
    const auto value = [&](double x, double y) { return f->value({x, y}); };
    // The cells have the size of the narrowest feature, so that no feature is missed.
    std::vector<statistics::Rectangle> cells;
    for (int i = 0; i < 32 * 32; ++i) {
      const double x = i % 32, y = i / 32;
      cells.push_back({x / 32, (x + 1) / 32, y / 32, (y + 1) / 32});
    }
    double found = 0;
    for (const statistics::Integral& cell :
         statistics::integrate_cells(value, cells, {.tolerance = 1e-8})) {
      found += cell.value;
    }
    CHECK(f->mean() == doctest::Approx(found).epsilon(2e-8));
  }
}

TEST_CASE("the mean of a few integrands, by hand") {
  CHECK(integrand("{ type: edge, angles: [0], offsets: [0.25] }")->mean() == 0.75);
  CHECK(integrand("{ type: edge, angles: [45] }")->mean() == doctest::Approx(0.5));
  CHECK(integrand("{ type: disk, center: [0, 0], radius: 1 }")->mean() ==
        doctest::Approx(std::numbers::pi / 4).epsilon(1e-12));
  CHECK(integrand("{ type: disk, center: [0.5, 0.5], radius: 0.25 }")->mean() ==
        doctest::Approx(std::numbers::pi / 16).epsilon(1e-12));
  CHECK(integrand("{ type: triangle, vertices: [[0, 0], [1, 0], [0, 1]] }")->mean() ==
        doctest::Approx(0.5).epsilon(1e-12));
  CHECK(integrand("{ type: smooth_edge, angle: 77 }")->mean() == doctest::Approx(0.5));
}

TEST_CASE("sums are those of the values") {
  const Ref<Integrand> f = integrand("{ type: textured }");
  const std::vector<PlanePoint> points{{0.1, 0.2}, {0.9, 0.8}, {0.25, 0.5}};
  double expected = 0;
  for (const PlanePoint p : points) expected += f->value(p);
  CHECK(f->sum(points) == expected);
  CHECK(f->sum({}) == 0);
}

TEST_CASE("the Gaussian on the torus has no border") {
  const Ref<Integrand> f = integrand("{ type: smooth, width: 0.25, center: [0.1, 0.9] }");
  for (const double t : {0.0, 0.3, 0.77}) {
    CHECK(f->value({0, t}) == doctest::Approx(f->value({1, t})).epsilon(1e-12));
    CHECK(f->value({t, 0}) == doctest::Approx(f->value({t, 1})).epsilon(1e-12));
  }
}

TEST_CASE("integrands that points would not find are refused") {
  const auto refusal = [](const char* yaml) { return test::input_error([&] { integrand(yaml); }); };
  CHECK(refusal("{ type: edge, angles: [0], offsets: [0.6] }").find("found all") !=
        std::string::npos);
  CHECK(refusal("{ type: edge, angles: [0, 180], offsets: [-0.1, -0.1] }").find("found nothing") !=
        std::string::npos);
  CHECK(refusal("{ type: edge, angles: [0, 90], offsets: [0.1] }")
            .find("test:1:1: error: expected as many offsets as angles") != std::string::npos);
  CHECK(refusal("{ type: edge, angles: [] }").find("one to eight") != std::string::npos);
  CHECK(refusal("{ type: triangle, vertices: [[0, 0], [1, 1]] }").find("three points") !=
        std::string::npos);
  CHECK(
      refusal("{ type: triangle, vertices: [[0, 0], [1, 1], [0.5, 0.5]] }").find("found nothing") !=
      std::string::npos);
  CHECK(refusal("{ type: disk, center: [3, 3] }").find("found nothing") != std::string::npos);
  CHECK(refusal("{ type: disk, radius: 0.8 }").find("found all") != std::string::npos);
  CHECK(refusal("{ type: smooth_disk, radius: 0.3 }").find("they reach 0.54") != std::string::npos);
  CHECK(refusal("{ type: textured, frequency: [0, 0] }").find("not zero") != std::string::npos);
  CHECK(refusal("{ type: egde }").find("did you mean 'edge'?") != std::string::npos);
}

}  // namespace
}  // namespace pharos::laboratory
