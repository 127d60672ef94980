#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/core/saved_bytes.h>

#include "../adjoint.h"
#include "../efficiency.h"
#include "../none.h"
#include "made_up_paths.h"

namespace pharos {
namespace {

const LearningContext kContext{.seed = 3, .window = {0, 0, 4, 4}};

/// A path of throughput `throughput` that sees the wall of the made-up paths.
TerminationQuery at_wall(float throughput, std::uint16_t bounce = 6) {
  return {.film = {0.5f, 0.5f},
          .position = {0, 0, 1},
          .towards_previous = {0, 0, -1},
          .bounce = bounce,
          .throughput = Rgb(throughput)};
}

/// Teaches a termination paths that find 8 with one step in four, from a wall that reflects half.
/// `film_weight` is that of all paths.
std::unique_ptr<TerminationState> taught(const Termination& termination, float film_weight = 1) {
  auto state = termination.begin(kContext);
  PathLog log;
  for (int i = 0; i < 400; ++i) {
    test::add_path(log, i % 4 == 0 ? 8 : 0, 1, 1, {0, 0, 1},
                   {static_cast<float>(i / 4 % 4) + 0.5f, 0.5f}, film_weight);
  }
  for (const std::uint32_t left : {2u, 1u, 0u}) {
    state->absorb(log);
    state->update({.left = left});
  }
  return state;
}

}  // namespace

TEST_CASE("none: there is no rule") {
  CHECK(NoTermination().begin(kContext)->rule() == nullptr);
  CHECK_FALSE(NoTermination().learns());
}

TEST_CASE("throughput: survival as the throughput says, from the first vertex of roulette on") {
  const auto rule = ThroughputTermination({.depth = 3, .limit = 0.9f}).begin(kContext)->rule();
  CHECK(rule->stage() == TerminationRule::Stage::step);
  CHECK(rule->factors(at_wall(0.25f, 2)).steps == 1);
  CHECK(rule->factors(at_wall(0.25f, 3)).steps == 0.25f);
  CHECK(rule->factors(at_wall(2, 3)).steps == 0.9f);
  TerminationQuery refracted = at_wall(0.25f);
  refracted.first_throughput = 0.5f;
  refracted.solid_angle_scale = 1.5f;
  CHECK(rule->factors(refracted).steps == doctest::Approx(0.75));
}

TEST_CASE("adjoint: contributions outside the window are moved to its edge") {
  for (const float width : {1.0f, 3.0f, 5.0f}) {
    const float low = 2 / (1 + width), high = 2 * width / (1 + width);
    CHECK(weight_window_factor(low / 4, width) == doctest::Approx(0.25));
    CHECK(weight_window_factor(1, width) == 1);
    CHECK(weight_window_factor(3 * high, width) == doctest::Approx(3));
    // What goes on has the contribution low or high.
    for (const float v : {low / 4, 3 * high}) {
      const float left = v / weight_window_factor(v, width);
      CHECK(left == doctest::Approx(v < 1 ? low : high));
    }
  }
}

TEST_CASE("efficiency: the factor in closed form") {
  const Spread found{.squared = 2.5f, .variance = 2};
  CHECK(efficiency_factor(0.1f, found) == doctest::Approx(0.25));
  CHECK(efficiency_factor(0.45f, found) == 1);
  CHECK(efficiency_factor(2, found) == doctest::Approx(4));
}

TEST_CASE("learned terminations begin with roulette by throughput and then use what they know") {
  AdjointTermination::Settings adjoint;
  adjoint.first.depth = 2;
  EfficiencyTermination::Settings efficiency;
  efficiency.first.depth = 2;
  for (OutcomeSettings* settings : std::array<OutcomeSettings*, 2>{&adjoint, &efficiency}) {
    settings->pixel_offset = 1e-6;
  }
  const AdjointTermination by_adjoint(adjoint);
  const EfficiencyTermination by_efficiency(efficiency);
  for (const Termination* termination :
       std::array<const Termination*, 2>{&by_adjoint, &by_efficiency}) {
    const auto first = termination->begin(kContext)->rule();
    CHECK(first->stage() == TerminationRule::Stage::step);
    CHECK(first->factors(at_wall(0.25f)).steps == 0.25f);
    const auto later = taught(*termination)->rule();
    CHECK(later->stage() == TerminationRule::Stage::vertex);
    CHECK(later->factors(at_wall(1e-6f)).steps == adjoint.least);
    CHECK(later->factors(at_wall(1e6f)).steps == adjoint.growth);
    CHECK(later->factors(at_wall(0.1f)).steps < 1);
    CHECK(later->factors(at_wall(10)).steps > 1);
  }
  // A step finds the pixel's radiance on average: the middle of the window.
  CHECK(taught(by_adjoint)->rule()->factors(at_wall(1)).steps == 1);
  const float low = 2 / (1 + adjoint.window);
  CHECK(taught(by_adjoint)->rule()->factors(at_wall(0.1f)).steps == doctest::Approx(0.1f / low));
}

TEST_CASE("learned terminations: the first roulette favors refracted steps, which is made up for") {
  AdjointTermination::Settings settings;
  settings.pixel_offset = 1e-6;
  auto state = AdjointTermination(settings).begin(kContext);
  PathLog log;
  // Half of the steps refract and find light. They always survive, of the others one in four.
  for (int i = 0; i < 100; ++i) {
    for (int k = 0; k < 4; ++k) test::add_path(log, 8, 1, 1);
    test::add_path(log, 0, 1, 4);
    for (int k = 0; k < 3; ++k) test::add_ended_path(log);
  }
  state->absorb(log);
  state->update({.left = 0});
  const float low = 2 / (1 + settings.window);
  CHECK(state->rule()->factors(at_wall(0.1f)).steps == doctest::Approx(0.1f / low));
}

TEST_CASE("efficiency: the path itself is the fixed point of a single step") {
  // All noise of the image comes from the step at the wall, and half of the cost.
  EfficiencyTermination::Settings settings;
  settings.outliers = 0;
  settings.pixel_offset = 1e-6;
  const float factor = taught(EfficiencyTermination(settings))->rule()->factors(at_wall(1)).steps;
  CHECK(factor == doctest::Approx(std::sqrt(2)).epsilon(0.05));
}

TEST_CASE("efficiency: a path that finds much more than others changes no factor") {
  const auto factor_with = [](float spike, double outliers) {
    EfficiencyTermination::Settings settings;
    settings.outliers = outliers;
    settings.pixel_offset = 1e-6;
    settings.denoising.levels = 0;
    auto state = EfficiencyTermination(settings).begin(kContext);
    for (const std::uint32_t left : {3u, 2u, 1u, 0u}) {
      PathLog log;
      for (int i = 0; i < 4000; ++i) {
        const float found = i == 2008 && left == 0 ? spike : static_cast<float>(i % 4);
        test::add_path(log, found, 1, 1, {0, 0, 1}, {static_cast<float>(i / 4 % 4) + 0.5f, 0.5f});
      }
      state->absorb(log);
      state->update({.left = left});
    }
    return state->rule()->factors(at_wall(1)).steps;
  };
  CHECK(factor_with(1e4f, 0.01) == doctest::Approx(factor_with(3, 0.01)).epsilon(0.1));
  // Without a limit, it changes the error of the image and so all factors.
  CHECK(factor_with(1e4f, 0) < 0.9f * factor_with(3, 0));
}

TEST_CASE("learned terminations: guides of the camera do not change the factors of their paths") {
  AdjointTermination::Settings adjoint;
  EfficiencyTermination::Settings efficiency;
  for (OutcomeSettings* settings : std::array<OutcomeSettings*, 2>{&adjoint, &efficiency}) {
    settings->outliers = 0;
    settings->pixel_offset = 1e-6;
  }
  const AdjointTermination by_adjoint(adjoint);
  const EfficiencyTermination by_efficiency(efficiency);
  for (const Termination* termination :
       std::array<const Termination*, 2>{&by_adjoint, &by_efficiency}) {
    const auto even = taught(*termination)->rule();
    for (const float weight : {0.25f, 4.0f}) {
      const auto guided = taught(*termination, weight)->rule();
      for (const float throughput : {0.1f, 1.0f, 4.0f}) {
        TerminationQuery query = at_wall(throughput * weight);
        query.film_weight = weight;
        CHECK(guided->factors(query).steps ==
              doctest::Approx(even->factors(at_wall(throughput)).steps));
      }
    }
  }
}

TEST_CASE("adjoint: where the camera is guided, rare pixels do not split more than others") {
  const auto rule = taught(AdjointTermination({}))->rule();
  TerminationQuery rare = at_wall(30);
  rare.film_weight = 30;
  CHECK(rule->factors(rare).steps == rule->factors(at_wall(1)).steps);
}

TEST_CASE("learned terminations: mirrors and the first vertices are left alone") {
  const AdjointTermination by_adjoint({});
  const EfficiencyTermination by_efficiency({});
  for (const float throughput : {1e-3f, 1e3f}) {
    TerminationQuery query = at_wall(throughput);
    query.discrete = true;
    CHECK(taught(by_adjoint)->rule()->factors(query).steps == 1);
    CHECK(taught(by_efficiency)->rule()->factors(query).steps == 1);
    CHECK(taught(by_adjoint)->rule()->factors(at_wall(throughput, 1)).steps == 1);
    CHECK(taught(by_adjoint)->rule()->factors(at_wall(throughput, 2)).steps != 1);
    CHECK(taught(by_efficiency)->rule()->factors(at_wall(throughput, 1)).steps != 1);
  }
}

TEST_CASE("learned terminations: paths of undefined or infinite throughput have bounds, too") {
  const AdjointTermination by_adjoint({});
  const EfficiencyTermination by_efficiency({});
  for (const Termination* termination :
       std::array<const Termination*, 2>{&by_adjoint, &by_efficiency}) {
    const auto rule = taught(*termination)->rule();
    for (const float throughput : {NAN, INFINITY}) {
      CHECK(rule->factors(at_wall(throughput)).steps >= 0.05f);
      CHECK(rule->factors(at_wall(throughput)).steps <= 20);
    }
  }
}

TEST_CASE("learned terminations: the number of cells has a limit") {
  const auto size_with = [](std::uint32_t most_cells) {
    AdjointTermination::Settings settings;
    settings.cell_steps = 16;
    settings.most_cells = most_cells;
    auto state = AdjointTermination(settings).begin(kContext);
    for (int iteration = 0; iteration < 3; ++iteration) {
      PathLog log;
      for (int i = 0; i < 400; ++i) {
        test::add_path(log, 8, 1, 1, {0.01f * static_cast<float>(i), 0, 1});
      }
      state->absorb(log);
      state->update({.left = 9});
    }
    std::stringstream saved;
    save(saved, *state);
    return saved.str().size();
  };
  CHECK(size_with(1) < size_with(4));
  CHECK(size_with(4) < size_with(1000));
}

TEST_CASE("adjoint: light samples split and end with the steps") {
  const auto rule = taught(AdjointTermination({}))->rule();
  for (const float throughput : {0.01f, 0.1f, 1.0f, 10.0f}) {
    const BranchFactors found = rule->factors(at_wall(throughput));
    CHECK(found.lights == found.steps);
  }
}

TEST_CASE("efficiency: light samples have the factor that their own spread asks for") {
  EfficiencyTermination::Settings settings;
  settings.outliers = 0;
  settings.pixel_offset = 1e-6;
  settings.growth = 100;
  const auto lights_with = [&](float found) {
    auto state = EfficiencyTermination(settings).begin(kContext);
    for (const std::uint32_t left : {2u, 1u, 0u}) {
      PathLog log;
      for (int i = 0; i < 400; ++i) {
        test::add_path(log, i % 4 == 0 ? 8 : 0, 1, 1);
        test::add_light_samples(log, 1, 2, 0.5f, found);
      }
      state->absorb(log);
      state->update({.left = left});
    }
    return state->rule()->factors(at_wall(1)).lights;
  };
  CHECK(lights_with(0) == settings.least);
  CHECK(lights_with(0.2f) < 1);
  CHECK(lights_with(20) > 1);
}

TEST_CASE(
    "learned terminations: the number of branches of a path grows from iteration to iteration") {
  EfficiencyTermination::Settings settings;
  settings.first_iterations = 2;
  settings.growth = 3;
  settings.most = 20;
  settings.outliers = 0;
  auto state = EfficiencyTermination(settings).begin(kContext);
  std::vector<float> found;
  for (std::uint32_t i = 0; i < 6; ++i) {
    PathLog log;
    for (int k = 0; k < 400; ++k) test::add_path(log, k % 4 == 0 ? 8 : 0, 1, 1);
    state->absorb(log);
    state->update({.iteration = i, .left = 5 - i});
    found.push_back(state->rule()->factors(at_wall(1e6f)).steps);
  }
  CHECK(found[0] < 1);  // roulette by throughput
  CHECK(std::vector(found.begin() + 1, found.end()) == std::vector<float>{3, 9, 20, 20, 20});
  TerminationQuery query = at_wall(1e6f);
  for (const float branches : {20.0f, 80.0f, 1000.0f}) {
    query.branches = branches;
    // 3^5 branches in all
    CHECK(state->rule()->factors(query).steps ==
          doctest::Approx(std::clamp(243 / branches, 1.0f, 20.0f)));
  }
}

TEST_CASE("learned terminations: the first iterations only learn, the final image does not") {
  const AdjointTermination adjoint({});
  for (const std::uint32_t last : {0u, 1u, 9u}) {
    auto state = adjoint.begin(kContext);
    for (std::uint32_t i = 0; i <= last; ++i) {
      PathLog log;
      for (int k = 0; k < 100; ++k) test::add_path(log, 8, 1, 1);
      state->absorb(log);
      state->update({.iteration = i, .left = last - i});
      const bool is_first = i < 2 && i < last;
      CHECK((state->rule()->stage() == TerminationRule::Stage::step) == is_first);
    }
  }
}

TEST_CASE("learned terminations: without light, roulette by throughput stays") {
  const AdjointTermination adjoint({});
  auto state = adjoint.begin(kContext);
  PathLog log;
  for (int i = 0; i < 100; ++i) test::add_path(log, 0, 1, 1);
  state->absorb(log);
  state->update({});
  CHECK(state->rule()->stage() == TerminationRule::Stage::step);
}

TEST_CASE("learned terminations: the saved rule is small and has the same factors") {
  constexpr PixelRect kWindow{0, 0, 64, 64};
  const LearningContext context{.seed = 3, .window = kWindow};
  const EfficiencyTermination termination({});
  auto state = termination.begin(context);
  PathLog log;
  for (int i = 0; i < 2000; ++i) test::add_path(log, i % 4 == 0 ? 8 : 0, 1, 1);
  for (const std::uint32_t left : {2u, 1u, 0u}) {
    state->absorb(log);
    state->update({.left = left});
  }
  state->absorb(log);
  const std::string rule = saved_bytes([&](Archive& archive) { state->archive_rule(archive); });
  const std::string all = saved_bytes([&](Archive& archive) { state->archive(archive); });
  CHECK(rule.size() < kWindow.area() * sizeof(float) + 1000);
  CHECK(all.size() > 5 * rule.size());
  auto loaded = termination.begin(context);
  load_bytes(rule, [&](Archive& archive) { loaded->archive_rule(archive); });
  REQUIRE(loaded->rule()->stage() == TerminationRule::Stage::vertex);
  for (const float throughput : {0.3f, 1.0f, 3.0f}) {
    CHECK(loaded->rule()->factors(at_wall(throughput)).steps ==
          state->rule()->factors(at_wall(throughput)).steps);
  }
}

TEST_CASE("learned terminations: a saved state goes on as the state does") {
  const EfficiencyTermination termination({});
  auto state = taught(termination);
  PathLog log;
  for (int i = 0; i < 50; ++i) test::add_path(log, 5, 2, 0.5f);
  state->absorb(log);
  std::stringstream saved;
  save(saved, *state);
  auto loaded = termination.begin(kContext);
  load(saved, *loaded);
  for (const float throughput : {0.3f, 1.0f, 3.0f}) {
    CHECK(loaded->rule()->factors(at_wall(throughput)).steps ==
          state->rule()->factors(at_wall(throughput)).steps);
  }
  state->update({});
  loaded->update({});
  for (const float throughput : {0.3f, 1.0f, 3.0f}) {
    CHECK(loaded->rule()->factors(at_wall(throughput)).steps ==
          state->rule()->factors(at_wall(throughput)).steps);
  }
}

}  // namespace pharos
