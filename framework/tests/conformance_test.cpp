// A planted fault turns exactly the checks red that are there to find it.

#include <atomic>
#include <cmath>
#include <filesystem>
#include <memory>
#include <set>
#include <string>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <pharos/conformance/conformance.h>
#include <pharos/core/random.h>
#include <pharos/core/warp.h>
#include <pharos/rendering/filter.h>
#include <pharos/sampling/keyed_numbers.h>
#include <pharos/scene/bsdf.h>
#include <pharos/scene/emitter.h>
#include <pharos/scene/sensor.h>
#include <pharos/scene/texture.h>

namespace pharos {
namespace {

using conformance::check_plugins;
using conformance::failed_checks;
using conformance::Finding;
using conformance::Report;
using conformance::Verdict;

using Names = std::set<std::string>;

/// A plugin that is sound but for the fault that its parameter plants.
template <class Fault>
struct FaultSettings {
  static inline Fault planted = Fault::none;
  static void describe(Schema<FaultSettings>&) {}
};

/// The report on one plugin P with a fault.
template <class P, class Fault>
Report report_with(Fault fault) {
  FaultSettings<Fault>::planted = fault;
  Registry registry;
  registry.add<P>("subject", "Planted fault");
  return check_plugins(registry);
}

template <class P, class Fault>
Names red_with(Fault fault) {
  return failed_checks(report_with<P>(fault));
}

// --- bsdf ----------------------------------------------------------------------------------------

enum class BsdfFault {
  none,
  pdf_scale,
  pdf_scale_of_half,
  pdf_shape,
  weight,
  adjoint,
  energy,
  event,
  nan,
  memory
};

/// A matt surface.
class FaultyBsdf final : public Bsdf {
 public:
  using Settings = FaultSettings<BsdfFault>;
  explicit FaultyBsdf(const Settings&) : fault_(Settings::planted) {}

  EventMask events() const override { return mask_of(Event::smooth_reflect); }
  ScatterValue evaluate(const SurfacePoint&, Vec3 wo, Vec3 wi, ScatterOptions o) const override {
    const bool masked = !contains(o.events, Event::smooth_reflect) && fault_ != BsdfFault::event;
    if (wo.z <= 0 || wi.z <= 0 || masked) return {};
    if (fault_ == BsdfFault::nan && wi.z < 1e-5f) return {Rgb(std::sqrt(-wo.z)), 1};
    const float pdf = warp::cosine_hemisphere_pdf(wi.z);
    return {reflectance(wo, wi) * pdf, claimed(pdf, wi)};
  }
  std::optional<ScatterSample> sample(const SurfacePoint&, Vec3 wo, float u_choice, Vec2 u,
                                      ScatterOptions o) const override {
    if (wo.z <= 0 || !contains(o.events, Event::smooth_reflect)) return {};
    const Vec3 wi = warp::cosine_hemisphere_from_square(u);
    const bool lost = fault_ == BsdfFault::pdf_scale_of_half && u_choice < 0.5f;
    if (wi.z <= 0 || lost) return {};
    const float pdf = warp::cosine_hemisphere_pdf(wi.z);
    Rgb weight = reflectance(wo, wi) * (pdf / claimed(pdf, wi));
    if (fault_ == BsdfFault::weight) weight *= 1.03f;
    if (fault_ == BsdfFault::memory && ++calls_ % 5 == 0) weight *= 0.9999f;
    return ScatterSample{wi, Event::smooth_reflect, weight, claimed(pdf, wi)};
  }
  float roughness(const SurfacePoint&) const override { return 1; }
  Rgb albedo(const SurfacePoint&) const override { return Rgb(0.5f); }

 private:
  Rgb reflectance(Vec3 wo, Vec3 wi) const {
    if (fault_ == BsdfFault::adjoint) return Rgb(0.5f + 0.05f * (wo.z - wi.z));
    return Rgb(fault_ == BsdfFault::energy ? 1.03f : 0.5f);
  }
  float claimed(float pdf, Vec3 wi) const {
    if (fault_ == BsdfFault::pdf_scale) return 1.03f * pdf;
    if (fault_ == BsdfFault::pdf_scale_of_half) return 1.03f * 0.5f * pdf;
    if (fault_ == BsdfFault::pdf_shape) return pdf * (1 + 0.2f * wi.x);
    return pdf;
  }

  BsdfFault fault_;
  mutable std::atomic<int> calls_{0};
};

TEST_CASE("conformance: faults of a BSDF") {
  CHECK(red_with<FaultyBsdf>(BsdfFault::none) == Names{});
  CHECK(red_with<FaultyBsdf>(BsdfFault::pdf_scale) == Names{"integral"});
  CHECK(red_with<FaultyBsdf>(BsdfFault::pdf_scale_of_half) == Names{"integral"});
  CHECK(red_with<FaultyBsdf>(BsdfFault::pdf_shape) == Names{"chi_square"});
  CHECK(red_with<FaultyBsdf>(BsdfFault::weight) == Names{"weight"});
  CHECK(red_with<FaultyBsdf>(BsdfFault::adjoint) == Names{"adjoint"});
  CHECK(red_with<FaultyBsdf>(BsdfFault::energy) == Names{"energy"});
  CHECK(red_with<FaultyBsdf>(BsdfFault::event) == Names{"events", "integral"});
  CHECK(red_with<FaultyBsdf>(BsdfFault::nan) == Names{"finite"});
  CHECK(red_with<FaultyBsdf>(BsdfFault::memory) == Names{"determinism"});
}

// --- glass ---------------------------------------------------------------------------------------

enum class GlassFault { none, no_scaling, probability };

/// An interface that refracts with the share 0.8 wherever it can.
class FaultyGlass final : public Bsdf {
 public:
  using Settings = FaultSettings<GlassFault>;
  explicit FaultyGlass(const Settings&) : fault_(Settings::planted) {}

  EventMask events() const override { return EventMask::discrete; }
  ScatterValue evaluate(const SurfacePoint&, Vec3, Vec3, ScatterOptions) const override {
    return {};
  }
  DiscreteOutcomes discrete(const SurfacePoint&, Vec3 wo, ScatterOptions o) const override {
    DiscreteOutcomes all;
    if (wo.z == 0) return all;
    const float eta = wo.z > 0 ? 1.5f : 1 / 1.5f;
    const float cos2 = 1 - (1 - wo.z * wo.z) / (eta * eta);
    const bool refracts = cos2 > 0 && contains(o.events, Event::discrete_transmit);
    const bool reflects = contains(o.events, Event::discrete_reflect);
    const float share = cos2 > 0 ? 0.2f : 1.0f;
    if (reflects) {
      all.add({Event::discrete_reflect, {-wo.x, -wo.y, wo.z}, Rgb(share), refracts ? share : 1});
    }
    if (refracts) {
      const bool scaled = o.transport == Transport::radiance && fault_ != GlassFault::no_scaling;
      const Vec3 direction{-wo.x / eta, -wo.y / eta, std::copysign(std::sqrt(cos2), -wo.z)};
      all.add({Event::discrete_transmit, normalize(direction),
               Rgb(scaled ? 0.8f / (eta * eta) : 0.8f), reflects ? 0.8f : 1.0f});
    }
    return all;
  }
  std::optional<ScatterSample> sample(const SurfacePoint& point, Vec3 wo, float u, Vec2,
                                      ScatterOptions o) const override {
    const DiscreteOutcomes all = discrete(point, wo, o);
    if (all.count == 0) return {};
    const float reflected = fault_ == GlassFault::probability ? 0.23f : 0.2f;
    const DiscreteOutcome& c = all.outcomes[all.count == 2 && u >= reflected ? 1 : 0];
    return ScatterSample{c.direction, c.event, c.value / c.probability, c.probability};
  }
  float roughness(const SurfacePoint&) const override { return 0; }
  float relative_ior() const override { return 1 / 1.5f; }
  Rgb albedo(const SurfacePoint&) const override { return Rgb(1); }

 private:
  GlassFault fault_;
};

TEST_CASE("conformance: faults of an interface") {
  CHECK(red_with<FaultyGlass>(GlassFault::none) == Names{});
  CHECK(red_with<FaultyGlass>(GlassFault::no_scaling) == Names{"adjoint"});
  const Names red = red_with<FaultyGlass>(GlassFault::probability);
  CHECK(red.contains("discrete"));
}

// --- emitter -------------------------------------------------------------------------------------

enum class SkyFault { none, pdf, radiance, power };

/// The same radiance from everywhere.
class FaultySky final : public Emitter {
 public:
  using Settings = FaultSettings<SkyFault>;
  explicit FaultySky(const Settings&) : fault_(Settings::planted) {}
  bool needs_shape() const override { return false; }
  std::unique_ptr<const pharos::Light> place(const EmitterSite& site) const override {
    return std::make_unique<const Sky>(fault_, site.scene_radius);
  }

 private:
  class Sky final : public pharos::Light {
   public:
    Sky(SkyFault fault, float radius) : fault_(fault), radius_(radius) {}
    LightSample sample(Point3 from, Vec2 u) const override {
      LightSample s{.direction = warp::sphere_from_square(u), .distance = kInfinity};
      s.radiance = Rgb(fault_ == SkyFault::radiance ? 2.1f : 2.0f);
      s.pdf = pdf_direction(s.direction);
      s.point.position = from + 10 * s.direction;
      s.kind = VertexKind::environment;
      return s;
    }
    bool is_environment() const override { return true; }
    float pdf_direction(Vec3) const override {
      return (fault_ == SkyFault::pdf ? 1.03f : 1) * warp::sphere_pdf();
    }
    Rgb environment_radiance(Vec3) const override { return Rgb(2); }
    float power() const override {
      return 8 * kPi * kPi * square(radius_) * (fault_ == SkyFault::power ? 0.3f : 1);
    }

   private:
    SkyFault fault_;
    float radius_;
  };
  SkyFault fault_;
};

TEST_CASE("conformance: faults of an emitter") {
  CHECK(red_with<FaultySky>(SkyFault::none) == Names{});
  CHECK(red_with<FaultySky>(SkyFault::pdf) == Names{"integral"});
  CHECK(red_with<FaultySky>(SkyFault::radiance) == Names{"weight"});
  CHECK(red_with<FaultySky>(SkyFault::power) == Names{"power"});
}

// --- sensor --------------------------------------------------------------------------------------

enum class SensorFault { none, inverse, pdf, lens };

/// A thin lens of radius 0.1 in focus at infinity, so that directions alone tell the film.
class FaultyLens final : public Sensor {
 public:
  using Settings = FaultSettings<SensorFault>;
  explicit FaultyLens(const Settings&) : fault_(Settings::planted) {}
  std::unique_ptr<const PreparedSensor> prepare(int, int) const override {
    return std::make_unique<const Prepared>(fault_);
  }
  Point3 position() const override { return {}; }

 private:
  class Prepared final : public PreparedSensor {
   public:
    explicit Prepared(SensorFault fault) : fault_(fault) {}
    LensPoint sample_lens(Vec2 u) const override {
      Vec2 p = 0.1f * warp::disk_from_square(u);
      if (fault_ == SensorFault::lens) p = std::hypot(10 * p.x, 10 * p.y) * p;
      return {{p.x, p.y, 0}, {0, 0, 1}};
    }
    Ray ray(const LensPoint& lens, Vec2 film) const override {
      return {lens.position, normalize({0.5f - film.x, 0.5f - film.y, 1})};
    }
    std::optional<SensorResponse> response(const LensPoint&, Vec3 d) const override {
      if (!(d.z > 0)) return std::nullopt;
      Vec2 film{0.5f - d.x / d.z, 0.5f - d.y / d.z};
      if (!(film.x >= 0 && film.x < 1 && film.y >= 0 && film.y < 1)) return std::nullopt;
      if (fault_ == SensorFault::inverse) film.x = 1 - film.x;
      const float z = fault_ == SensorFault::pdf ? 1 : d.z;
      return SensorResponse{film, 1 / (z * d.z * d.z)};
    }

   private:
    SensorFault fault_;
  };
  SensorFault fault_;
};

TEST_CASE("conformance: faults of a sensor") {
  CHECK(red_with<FaultyLens>(SensorFault::none) == Names{});
  CHECK(red_with<FaultyLens>(SensorFault::inverse) == Names{"inverse"});
  CHECK(red_with<FaultyLens>(SensorFault::lens) == Names{"lens"});
  CHECK(red_with<FaultyLens>(SensorFault::pdf).contains("integral"));
}

// --- filter and texture --------------------------------------------------------------------------

enum class FilterFault { none, support, integral, symmetry };

/// A tent of radius one.
class FaultyFilter final : public Filter {
 public:
  using Settings = FaultSettings<FilterFault>;
  explicit FaultyFilter(const Settings&) : fault_(Settings::planted) {}
  float radius() const override { return fault_ == FilterFault::support ? 0.9f : 1.0f; }
  float evaluate(Vec2 o) const override {
    const float side = fault_ == FilterFault::symmetry && o.x > 0 && std::abs(o.y) < 1 ? 0.2f : 0;
    const float tent = std::max(0.0f, 1 - std::abs(o.x)) * std::max(0.0f, 1 - std::abs(o.y));
    return tent + side * (o.x < 1 ? o.x - 0.5f : 0);
  }
  float integral() const override { return fault_ == FilterFault::integral ? 1.05f : 1.0f; }

 private:
  FilterFault fault_;
};

TEST_CASE("conformance: faults of a filter") {
  CHECK(red_with<FaultyFilter>(FilterFault::none) == Names{});
  CHECK(red_with<FaultyFilter>(FilterFault::support).contains("support"));
  CHECK(red_with<FaultyFilter>(FilterFault::integral) == Names{"integral"});
  CHECK(red_with<FaultyFilter>(FilterFault::symmetry) == Names{"symmetry"});
}

enum class TextureFault { none, range, average, nan };

class FaultyTexture final : public Texture {
 public:
  using Settings = FaultSettings<TextureFault>;
  explicit FaultyTexture(const Settings&) : fault_(Settings::planted) {}
  Rgb evaluate(const SurfacePoint& p) const override {
    if (fault_ == TextureFault::nan && std::abs(p.uv.x) > 1e20f)
      return Rgb(std::sqrt(-std::abs(p.uv.x)));
    const float x = p.uv.x - std::floor(p.uv.x);
    return Rgb(x < 0.25f ? 0.8f : 0.4f);
  }
  float maximum() const override { return fault_ == TextureFault::range ? 0.7f : 0.8f; }
  Rgb average() const override { return Rgb(fault_ == TextureFault::average ? 0.6f : 0.5f); }

 private:
  TextureFault fault_;
};

TEST_CASE("conformance: faults of a texture") {
  CHECK(red_with<FaultyTexture>(TextureFault::none) == Names{});
  CHECK(red_with<FaultyTexture>(TextureFault::range) == Names{"range"});
  CHECK(red_with<FaultyTexture>(TextureFault::average) == Names{"average"});
  CHECK(red_with<FaultyTexture>(TextureFault::nan) == Names{"finite"});
}

// --- sampler -------------------------------------------------------------------------------------

enum class SamplerFault { none, squared, same_for_all_bounces, one };

class FaultySampler final : public Sampler {
 public:
  using Settings = FaultSettings<SamplerFault>;
  explicit FaultySampler(const Settings&) : fault_(Settings::planted) {}
  std::unique_ptr<const PreparedSampler> prepare(const PixelGrid&, const SamplePlan&,
                                                 const IntegrandProbe*) const override {
    return std::make_unique<const Prepared>(fault_);
  }

 private:
  class Prepared final : public PreparedSampler {
   public:
    explicit Prepared(SamplerFault fault) : fault_(fault) {}
    std::uint64_t begin(const PathKey& key) const override { return hash_key(key); }
    float value_1d(const SampleStream& stream, Dimension d) const override {
      return value_2d(stream, d).x;
    }
    Vec2 value_2d(const SampleStream& stream, Dimension d) const override {
      if (fault_ == SamplerFault::same_for_all_bounces) d.bounce = 0;
      Vec2 u = keyed_numbers(stream.state(), d);
      if (fault_ == SamplerFault::squared) u.x = std::pow(u.x, 1.1f);
      if (fault_ == SamplerFault::one && u.x > 0.9999f) u.x = 1;
      return u;
    }

   private:
    SamplerFault fault_;
  };
  SamplerFault fault_;
};

TEST_CASE("conformance: faults of a sampler") {
  CHECK(red_with<FaultySampler>(SamplerFault::none) == Names{});
  CHECK(red_with<FaultySampler>(SamplerFault::squared) ==
        Names{"independence", "mean", "uniformity"});
  CHECK(red_with<FaultySampler>(SamplerFault::same_for_all_bounces) == Names{"independence"});
  CHECK(red_with<FaultySampler>(SamplerFault::one) == Names{"range"});
}

// --- cases and reports ---------------------------------------------------------------------------

enum class Mode { plain, odd };

}  // namespace

template <>
struct EnumNames<Mode> {
  static constexpr std::array<std::pair<std::string_view, Mode>, 2> names{
      {{"plain", Mode::plain}, {"odd", Mode::odd}}};
};

namespace {

/// A texture with a file that must be given, a choice and a switch.
class FileTexture final : public Texture {
 public:
  struct Settings {
    std::filesystem::path file;
    Mode mode = Mode::plain;
    bool dark = false;
    static void describe(Schema<Settings>& s) {
      s.field("file", &Settings::file, "Any file").required();
      s.field("mode", &Settings::mode, "Fails if odd");
      s.field("dark", &Settings::dark, "Black");
      if (stated) s.example("{ file: example.png }");
    }
    static inline bool stated = true;
  };
  explicit FileTexture(const Settings& settings) : settings_(settings) {
    if (!std::filesystem::exists(settings.file)) throw InputError("there is no such file");
  }
  Rgb evaluate(const SurfacePoint&) const override {
    return Rgb(settings_.mode == Mode::odd ? 2.0f : settings_.dark ? 0.0f : 1.0f);
  }
  float maximum() const override { return 1; }
  Rgb average() const override { return Rgb(settings_.dark ? 0.0f : 1.0f); }

 private:
  Settings settings_;
};

Report file_texture_report(bool stated) {
  FileTexture::Settings::stated = stated;
  Registry registry;
  registry.add<FileTexture>("file", "Needs a file");
  return check_plugins(registry, {.names = {"texture"}});
}

TEST_CASE("conformance: examples, choices and switches are cases") {
  const Report report = file_texture_report(true);
  Names cases;
  for (const Finding& f : report.findings) {
    cases.insert(f.settings);
    const bool odd = f.settings.find("odd") != std::string::npos;
    const bool fails = odd && (f.check == "range" || f.check == "average");
    CHECK_MESSAGE((f.verdict == Verdict::failed) == fails, f.settings << ": " << f.check);
  }
  CHECK(cases == Names{"", "{ file: example.png }", "{ file: example.png, mode: odd }",
                       "{ file: example.png, dark: true }"});
}

TEST_CASE("conformance: a plugin without a case that can be built must state an example") {
  const Report report = file_texture_report(false);
  REQUIRE(report.findings.size() == 1);
  CHECK(report.findings[0].check == "buildable");
  CHECK(report.findings[0].verdict == Verdict::failed);
  CHECK(report.findings[0].detail.find("s.example(") != std::string::npos);
}

TEST_CASE("conformance: unknown names are input errors with the nearest one") {
  Registry registry;
  registry.add<FaultyTexture>("faulty", "A texture");
  CHECK_THROWS_WITH_AS(check_plugins(registry, {.names = {"fualty"}}),
                       doctest::Contains("did you mean 'faulty'?"), InputError);
  CHECK_THROWS_AS(check_plugins(registry, {.module = "none"}), InputError);
}

TEST_CASE("conformance: the report does not depend on the number of threads") {
  const auto run = [](int threads) {
    return tbb::task_arena(threads).execute(
        [] { return to_json(report_with<FaultyBsdf>(BsdfFault::pdf_shape)); });
  };
  const std::string one = run(1);
  CHECK(one == run(2));
  CHECK(one.find(R"("check": "chi_square", "verdict": "failed")") != std::string::npos);
}

}  // namespace
}  // namespace pharos
