#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <pharos/conformance/guide_stage.h>
#include <pharos/conformance/guided.h>
#include <pharos/conformance/stage.h>
#include <pharos/conformance/suites.h>
#include <pharos/core/saved_bytes.h>

namespace pharos::conformance {
namespace {

constexpr int kFilmEdge = 16;
constexpr std::uint32_t kIterations = 5, kSamples = 8;
constexpr PixelRect kWhole{0, 0, kFilmEdge, kFilmEdge};

/// Returns an integrator with the termination; null if there is none, and sets `why_not` to the
/// reason.
Ref<Integrator> integrator_with(const Registry& registry, const Subject& termination,
                                std::string& why_not) {
  why_not = "no integrator is loaded";
  for (const std::string& name : integrator_names(registry)) {
    ConfigNode node = ConfigNode::mapping();
    node.set("type", ConfigNode::scalar(name));
    node.set("termination", termination.node);
    try {
      return build_plugin<Integrator>(registry, node);
    } catch (const InputError& e) {
      why_not = e.what();
    }
  }
  return nullptr;
}

/// A room in which a termination learns from the paths of an integrator.
class School {
 public:
  School(const Termination& termination, const Integrator& integrator, bool foggy,
         std::uint64_t seed)
      : termination_(termination),
        scene_(room_parts(Room::lamp, foggy)),
        sensor_(scene_.sensor().prepare(kFilmEdge, kFilmEdge)),
        prepared_(integrator.prepare({scene_, *sensor_, kFilmEdge, kFilmEdge})),
        film_(kWhole, std::make_shared<const OnePixel>()),
        seed_(seed) {}

  const Scene& scene() const { return scene_; }
  std::unique_ptr<TerminationState> begin() const {
    return termination_.begin({.region = scene_.bounds(), .seed = seed_, .window = kWhole});
  }
  /// Returns a state that has learned all iterations but the last one.
  std::unique_ptr<TerminationState> taught() const {
    auto state = begin();
    for (std::uint32_t i = 0; i + 1 < kIterations; ++i) teach(*state, i);
    return state;
  }
  /// Teaches an iteration. Nothing happens if the termination does not learn.
  void teach(TerminationState& state, std::uint32_t iteration) const {
    if (!termination_.learns()) return;
    WorkResult work{.film = film_.make_tile(kWhole)};
    const auto rule = state.rule();
    prepared_->render({kWhole, iteration, 0, kSamples},
                      {.sampler = sampler_,
                       .seed = seed_,
                       .record = true,
                       .training = true,
                       .termination = rule.get()},
                      work);
    state.absorb(work.log);
    state.update({.iteration = iteration, .left = kIterations - 1 - iteration});
  }

 private:
  const Termination& termination_;
  Scene scene_;
  std::unique_ptr<const PreparedSensor> sensor_;
  std::unique_ptr<const PreparedIntegrator> prepared_;
  Film film_;
  KeyedSampler sampler_;
  std::uint64_t seed_;
};

/// A question to a rule.
struct Question {
  TerminationQuery query;
  std::string where;
};

/// Returns questions at vertices of a room, early and late in a path, with throughputs from tiny to
/// huge.
std::vector<Question> questions_in(const Scene& scene, std::uint64_t seed) {
  std::vector<Question> all;
  for (const auto& vertex : stage_vertices(scene, seed)) {
    const GuidingQuery& at = vertex->query();
    for (const std::uint16_t bounce : {at.bounce, std::uint16_t{8}}) {
      for (const float throughput : {1e-6f, 0.01f, 0.3f, 1.0f, 30.0f, 1e6f}) {
        const auto pixel = static_cast<float>(all.size() % kFilmEdge) + 0.5f;
        all.push_back({{.film = {pixel, pixel},
                        .position = at.current.position,
                        .towards_previous = at.towards_previous,
                        .bounce = bounce,
                        .discrete = vertex->scattering().purely_discrete(),
                        .throughput = Rgb(throughput)},
                       fmt::format("{}, throughput {}", vertex->text(), throughput)});
      }
    }
  }
  return all;
}

BranchFactors answer(const TerminationRule* rule, const TerminationQuery& query) {
  return rule != nullptr ? rule->factors(query) : BranchFactors{};
}

/// Tests that factors are positive, because light may come from everywhere, and within bounds.
/// Returns whether they are.
bool check_range(const TerminationRule* rule, const std::vector<Question>& questions,
                 Check& check) {
  const bool splits = rule != nullptr && rule->stage() == TerminationRule::Stage::vertex;
  const float most = splits ? TerminationRule::kMostFactor : 1;
  bool is_sound = true;
  for (const Question& question : questions) {
    const BranchFactors found = answer(rule, question.query);
    for (const float factor : {found.steps, found.lights}) {
      const bool holds = std::isfinite(factor) && factor > 0 && factor <= most;
      is_sound &= holds;
      check.expect(holds, [&] {
        return fmt::format("{}: the factor {} is not above 0 and at most {}", question.where,
                           factor, most);
      });
    }
  }
  return is_sound;
}

/// Tests that two states have the same rules.
void expect_alike(const TerminationState& a, const TerminationState& b,
                  const std::vector<Question>& questions, const char* difference, Check& check) {
  const auto first = a.rule(), second = b.rule();
  for (const Question& question : questions) {
    check.expect(answer(first.get(), question.query) == answer(second.get(), question.query),
                 [&] { return question.where + ": " + difference; });
  }
}

void check_determinism(const School& school, const TerminationState& state,
                       const std::vector<Question>& questions, Check& check) {
  expect_alike(state, state, questions, "asked again, the rule answers otherwise", check);
  tbb::task_arena one_thread(1);
  const auto again = one_thread.execute([&] { return school.taught(); });
  expect_alike(state, *again, questions, "taught again by one thread, the rule answers otherwise",
               check);
}

/// Tests that a saved and loaded state has the same rule, alone too, and goes on to learn the same.
void check_save_load(const School& school, TerminationState& state,
                     const std::vector<Question>& questions, Check& check) {
  try {
    std::stringstream file;
    save(file, state);
    const auto loaded = school.begin();
    load(file, *loaded);
    expect_alike(state, *loaded, questions, "saved and loaded, the rule answers otherwise", check);
    const auto learner_of_nothing = school.begin();
    load_bytes(saved_bytes([&](Archive& archive) { state.archive_rule(archive); }),
               [&](Archive& archive) { learner_of_nothing->archive_rule(archive); });
    expect_alike(state, *learner_of_nothing, questions,
                 "saved and loaded alone, the rule answers otherwise", check);
    for (TerminationState* each : {&state, loaded.get()}) school.teach(*each, kIterations - 1);
    expect_alike(state, *loaded, questions, "saved and loaded, the state learns otherwise", check);
  } catch (const Error& e) {
    check.expect(false,
                 [&] { return std::string("what was saved cannot be loaded: ") + e.what(); });
  }
}

}  // namespace

void check_termination(const Registry& registry, const Subject& subject, Suite& suite) {
  Check& factors = suite.check("factors");
  Check& determinism = suite.check("determinism");
  Check& save_load = suite.check("save_load");
  Check& furnace = suite.check("furnace");
  std::string why_not;
  const Ref<Integrator> integrator = integrator_with(registry, subject, why_not);
  if (integrator == nullptr) {
    for (Check* c : {&factors, &determinism, &save_load, &furnace}) {
      c->not_applicable("no integrator takes it: " + why_not);
    }
    return;
  }
  for (Check* c : {&determinism, &save_load, &furnace}) {
    c->not_applicable("renders with factors out of bounds might never end");
  }
  const auto& termination = static_cast<const Termination&>(*subject.component);
  const auto plain =
      build_plugin<Integrator>(registry, ConfigNode::scalar(integrator->plugin_name()));
  for (const bool foggy : {false, true}) {
    const School school(termination, *integrator, foggy, suite.seed());
    const std::vector<Question> questions = questions_in(school.scene(), suite.seed());
    if (!check_range(school.begin()->rule().get(), questions, factors)) return;
    const auto state = school.taught();
    if (!check_range(state->rule().get(), questions, factors)) return;
    check_determinism(school, *state, questions, determinism);
    check_save_load(school, *state, questions, save_load);
    check_range(state->rule().get(), questions, factors);
    compare_in_furnace(registry, {integrator, "with it"}, {plain, "without"}, foggy, suite.seed(),
                       furnace);
  }
}

}  // namespace pharos::conformance
