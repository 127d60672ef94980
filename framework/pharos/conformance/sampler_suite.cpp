#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include <pharos/conformance/fit.h>
#include <pharos/conformance/suites.h>
#include <pharos/core/random.h>
#include <pharos/sampling/integrand_probe.h>
#include <pharos/sampling/keyed_numbers.h>
#include <pharos/statistics/hypothesis.h>

namespace pharos::conformance {
namespace {

constexpr int kEdge = 128;
constexpr std::size_t kPixels = static_cast<std::size_t>(kEdge) * kEdge;

/// A smooth integrand that differs from pixel to pixel.
class StageProbe final : public IntegrandProbe {
 public:
  explicit StageProbe(PixelGrid grid) : grid_(grid) {}
  PixelGrid grid() const override { return grid_; }
  PixelRect window() const override { return {0, 0, grid_.width, grid_.height}; }
  int light_branches() const override { return 1; }
  void evaluate(const ProbeQuery& query, std::span<const Vec2> points,
                std::span<Rgb> values) const override {
    const Vec2 peak{static_cast<float>(query.x) / static_cast<float>(grid_.width),
                    static_cast<float>(query.y) / static_cast<float>(grid_.height)};
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec2 d = points[i] - peak;
      values[i] = Rgb(0.1f + std::exp(-8 * (d.x * d.x + d.y * d.y)));
    }
  }
  FilmSample whole_path(const ProbeQuery& query, Vec2 point) const override {
    Rgb value;
    evaluate(query, std::span(&point, 1), std::span(&value, 1));
    return {{static_cast<float>(query.x) + 0.5f, static_cast<float>(query.y) + 0.5f}, value};
  }
  FirstHit first_hit(int x, int y) const override {
    return {1 + 0.01f * static_cast<float>(x + y), {0, 0, 1}, 0};
  }

 private:
  PixelGrid grid_;
};

std::uint32_t samples_of(const Sampler& sampler) {
  return std::max(16u, sampler.preferred_samples({}));
}

std::unique_ptr<const PreparedSampler> prepare(const Sampler& sampler, int edge,
                                               std::uint64_t seed) {
  const PixelGrid grid{edge, edge};
  const StageProbe probe(grid);
  return sampler.prepare(grid, {seed, samples_of(sampler)},
                         sampler.needs_probe() ? &probe : nullptr);
}

/// Returns every purpose at the vertices that may ask for it, some at several branches.
std::vector<Dimension> dimensions() {
  std::vector<Dimension> all;
  for (int p = 0; p < kPurposeCount; ++p) {
    const auto purpose = static_cast<Purpose>(p);
    if (purpose == Purpose::pixel || purpose == Purpose::lens) {
      all.push_back({purpose});
      continue;
    }
    for (const std::uint16_t bounce : {1, 2, 7}) all.push_back({purpose, bounce});
  }
  all.push_back({Purpose::light_position, 1, 1});
  all.push_back({Purpose::guide_choice, 1, 1});
  return all;
}

std::string text(Dimension d) {
  return fmt::format("purpose {}, bounce {}, branch {}", static_cast<int>(d.purpose()), d.bounce(),
                     d.branch());
}

/// The numbers of one dimension, one from each pixel. The sample number varies with the pixel.
struct Column {
  std::string name;
  std::vector<float> values;
};

Vec2 number_at(const PreparedSampler& sampler, const PathKey& key, Dimension d) {
  return SampleStream(sampler, key).get_2d(d);
}

PathKey key_of(std::size_t pixel, std::uint64_t seed, std::uint32_t samples) {
  return {.seed = seed,
          .index = pixel,
          .sample = static_cast<std::uint32_t>(pixel * 2654435761u >> 7) % samples};
}

/// Returns the columns of all dimensions. `key_at(pixel)` is the key of the path in each pixel.
template <class KeyAt>
std::vector<Column> columns_of(const PreparedSampler& sampler, const KeyAt& key_at) {
  std::vector<Column> all;
  for (const Dimension d : dimensions()) {
    Column u{text(d) + ", 1D", {}}, x{text(d) + ", 2D x", {}}, y{text(d) + ", 2D y", {}};
    for (std::size_t pixel = 0; pixel < kPixels; ++pixel) {
      const SampleStream stream(sampler, key_at(pixel));
      u.values.push_back(stream.get_1d(d));
      x.values.push_back(stream.get_2d(d).x);
      y.values.push_back(stream.get_2d(d).y);
    }
    for (Column* column : {&u, &x, &y}) all.push_back(std::move(*column));
  }
  return all;
}

std::size_t bin_of(float u, std::size_t bins) {
  return std::min(static_cast<std::size_t>(std::max(u, 0.0f) * static_cast<float>(bins)), bins - 1);
}

void check_range(const std::vector<Column>& columns, Suite& suite) {
  Check& check = suite.check("range");
  for (const Column& c : columns) {
    for (const float u : c.values) {
      check.expect(u >= 0 && u < 1, [&] { return fmt::format("{}: the number {}", c.name, u); });
    }
  }
}

double uniform_p_value(const std::vector<double>& counts) {
  const std::vector<double> expected(counts.size(), kPixels / static_cast<double>(counts.size()));
  return statistics::chi_square_test(counts, expected).p_value;
}

void check_uniformity(const std::vector<Column>& columns, Suite& suite) {
  constexpr std::size_t kBins = 64;
  Check& check = suite.check("uniformity");
  for (const Column& c : columns) {
    std::vector<double> counts(kBins);
    for (const float u : c.values) ++counts[bin_of(u, kBins)];
    check.add_p_value(uniform_p_value(counts), c.name);
  }
}

double joint_p_value(const std::vector<float>& a, const std::vector<float>& b) {
  constexpr std::size_t kBins = 8;
  std::vector<double> counts(kBins * kBins);
  for (std::size_t i = 0; i < a.size(); ++i) {
    ++counts[bin_of(a[i], kBins) * kBins + bin_of(b[i], kBins)];
  }
  return uniform_p_value(counts);
}

/// The one-sided p-value of a positive correlation. Samplers may spread neighbors apart.
double correlation_p_value(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - 0.5) * (b[i] - 0.5);
  const double z = 12 * sum / std::sqrt(static_cast<double>(a.size()));
  return 0.5 * std::erfc(z / std::sqrt(2.0));
}

/// Numbers of the same dimensions from other paths.
struct Others {
  const char* name;
  std::vector<Column> columns;
  bool may_correlate = false;  ///< if true, only equal numbers are faults
};

/// Returns paths that differ from the paths of key_of() in one part of the key.
std::vector<Others> others_of(const Sampler& sampler, const PreparedSampler& prepared,
                              std::uint64_t seed) {
  const std::uint32_t samples = samples_of(sampler);
  const auto with = [&](auto&& change) {
    return columns_of(prepared, [&](std::size_t pixel) {
      PathKey key = key_of(pixel, seed, samples);
      change(key);
      return key;
    });
  };
  const auto step = [samples](std::uint32_t sample, std::uint64_t by) {
    return static_cast<std::uint32_t>((sample + by) % samples);
  };
  std::vector<Others> all;
  const auto other = prepare(sampler, kEdge, seed + 1);
  all.push_back({"another seed", columns_of(*other, [&](std::size_t pixel) {
                   return key_of(pixel, seed + 1, samples);
                 })});
  all.push_back({"another iteration", with([](PathKey& key) { key.iteration = 1; })});
  // Samplers may visit their strata in order, so the next sample may correlate. Over all pairs of
  // samples of a pixel, there must be no positive correlation.
  all.push_back(
      {"the next sample", with([&](PathKey& key) { key.sample = step(key.sample, 1); }), true});
  all.push_back({"another sample", with([&](PathKey& key) {
                   const std::uint64_t any = hash_key({.seed = 1, .index = key.index});
                   key.sample = step(key.sample, 1 + any % (samples - 1));
                 })});
  return all;
}

double share_of_equal(const std::vector<float>& a, const std::vector<float>& b) {
  std::size_t equal = 0;
  for (std::size_t i = 0; i < a.size(); ++i) equal += a[i] == b[i] ? 1 : 0;
  return static_cast<double>(equal) / static_cast<double>(a.size());
}

void compare(const Column& column, const std::vector<float>& other, const std::string& name,
             bool may_correlate, Check& check) {
  constexpr double kMostEqual = 0.01;  // numbers of few bits are equal by chance
  const double equal = share_of_equal(column.values, other);
  check.expect(equal <= kMostEqual, [&] {
    return fmt::format("{}: {:.1f} % of the numbers are those of {}", column.name, 100 * equal,
                       name);
  });
  if (may_correlate) return;
  check.add_p_value(correlation_p_value(column.values, other), column.name + " with " + name);
}

/// Compares the dimensions of one path with each other, pixels with their neighbors, and paths with
/// other paths of the same pixel. A dimension may have the same number in 1D and in 2D, because
/// only one of them is ever requested.
void check_independence(const std::vector<Column>& columns, const std::vector<Others>& others,
                        Suite& suite) {
  Check& check = suite.check("independence");
  for (std::size_t a = 0; a < columns.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const bool same_dimension = a / 3 == b / 3, both_2d = a % 3 != 0 && b % 3 != 0;
      if (same_dimension && !both_2d) continue;
      check.add_p_value(joint_p_value(columns[a].values, columns[b].values),
                        columns[a].name + " with " + columns[b].name);
    }
    const std::vector<float>& values = columns[a].values;
    std::vector<float> next(values.begin() + 1, values.end());
    next.push_back(values.front());
    compare(columns[a], next, "the next pixel", false, check);
    for (const Others& o : others) {
      compare(columns[a], o.columns[a].values, o.name, o.may_correlate, check);
    }
  }
}

/// An integral over [0,1)^2. The estimates of all seeds must average to it.
struct Integrand {
  const char* name;
  double expected;
  std::function<double(Vec2)> value;
};

std::vector<Integrand> integrands() {
  return {{"x", 0.5, [](Vec2 u) { return double{u.x}; }},
          {"y^2", 1.0 / 3, [](Vec2 u) { return double{u.y} * u.y; }},
          {"x y", 0.25, [](Vec2 u) { return double{u.x} * u.y; }},
          {"x + y < 0.7", 0.245, [](Vec2 u) { return u.x + u.y < 0.7f ? 1.0 : 0.0; }}};
}

/// Returns the mean over all samples of all pixels of a small image.
double image_mean(const PreparedSampler& sampler, int edge, std::uint64_t seed,
                  std::uint32_t samples, Dimension dimension, const Integrand& integrand) {
  double sum = 0;
  for (std::uint64_t pixel = 0; pixel < static_cast<std::uint64_t>(edge) * edge; ++pixel) {
    for (std::uint32_t i = 0; i < samples; ++i) {
      const PathKey key{.seed = seed, .index = pixel, .sample = i};
      sum += integrand.value(number_at(sampler, key, dimension));
    }
  }
  return sum / (static_cast<double>(edge) * edge * samples);
}

void check_mean(const Sampler& sampler, Suite& suite) {
  constexpr int kSmallEdge = 8;
  constexpr std::uint64_t kSeeds = 24;
  constexpr double kRounding = 1e-7;  // numbers are truncated to 24 bits
  Check& check = suite.check("mean");
  const std::vector<Dimension> asked{{Purpose::pixel},
                                     {Purpose::light_position, 1},
                                     {Purpose::bsdf_direction, 1},
                                     {Purpose::guide_direction, 3}};
  const std::vector<Integrand> all = integrands();
  std::vector<std::vector<double>> means(asked.size() * all.size());
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto prepared = prepare(sampler, kSmallEdge, seed);
    for (std::size_t i = 0; i < means.size(); ++i) {
      means[i].push_back(image_mean(*prepared, kSmallEdge, seed, samples_of(sampler),
                                    asked[i / all.size()], all[i % all.size()]));
    }
  }
  for (std::size_t i = 0; i < means.size(); ++i) {
    const Integrand& integrand = all[i % all.size()];
    statistics::Estimate found = statistics::estimate(statistics::moments(means[i]));
    found.squared_error += kRounding * kRounding;
    check.add_p_value(
        statistics::one_sample_test(found, integrand.expected).p_value,
        fmt::format("{}: the mean of {} over seeds is {:.6f}, expected {:.6f}",
                    text(asked[i / all.size()]), integrand.name, found.mean, integrand.expected));
  }
}

void check_determinism(const Sampler& sampler, const PreparedSampler& prepared, Suite& suite) {
  Check& check = suite.check("determinism");
  const auto twin = prepare(sampler, kEdge, suite.seed());
  const std::vector<Dimension> asked = dimensions();
  for (std::size_t pixel = 0; pixel < 200; ++pixel) {
    const PathKey key = key_of(pixel * 37, suite.seed(), samples_of(sampler));
    const SampleStream stream(prepared, key), copied = stream, again(*twin, key);
    std::vector<Vec2> forward;
    for (const Dimension d : asked) forward.push_back(stream.get_2d(d));
    for (std::size_t i = asked.size(); i-- > 0;) {
      check.expect(copied.get_2d(asked[i]) == forward[i] && again.get_2d(asked[i]) == forward[i] &&
                       again.get_1d(asked[i]) == stream.get_1d(asked[i]),
                   [&] { return text(asked[i]) + ": asked again, the number is another"; });
    }
  }
}

}  // namespace

void check_sampler(const Sampler& sampler, Suite& suite) {
  const std::uint32_t samples = samples_of(sampler);
  const auto prepared = prepare(sampler, kEdge, suite.seed());
  const std::vector<Column> columns = columns_of(
      *prepared, [&](std::size_t pixel) { return key_of(pixel, suite.seed(), samples); });
  check_range(columns, suite);
  check_uniformity(columns, suite);
  check_independence(columns, others_of(sampler, *prepared, suite.seed()), suite);
  check_mean(sampler, suite);
  check_determinism(sampler, *prepared, suite);
}

}  // namespace pharos::conformance
