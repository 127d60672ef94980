#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <pharos/conformance/guide_stage.h>
#include <pharos/conformance/guided.h>
#include <pharos/conformance/suites.h>
#include <pharos/rendering/film.h>
#include <pharos/statistics/hypothesis.h>

namespace pharos::conformance {
namespace {

constexpr int kEdge = 16;
constexpr std::uint32_t kSamples = 8;
constexpr PixelRect kWhole{0, 0, kEdge, kEdge};

/// A room and an integrator that is prepared to render it.
class Setup {
 public:
  Setup(const Integrator& integrator, bool foggy, std::uint64_t seed)
      : scene_(room_parts(Room::lamp, foggy)),
        sensor_(scene_.sensor().prepare(kEdge, kEdge)),
        prepared_(integrator.prepare({scene_, *sensor_, kEdge, kEdge})),
        seed_(seed) {}

  Film new_film() const { return {kWhole, std::make_shared<const OnePixel>(), 1e-3f}; }

  WorkResult render(const Film& film, const PixelRect& pixels, std::uint32_t first,
                    std::uint32_t count, bool record = false) const {
    WorkResult result{.film = film.make_tile(pixels)};
    prepared_->render({pixels, 0, first, count}, context(record), result);
    return result;
  }
  /// Returns the image whose pixels get samples by shares, of another seed.
  Image shared_image(const PixelShares& shares, const PreparedSampler& sampler,
                     std::uint64_t seed) const {
    Film film = new_film();
    WorkResult result{.film = film.make_tile(kWhole, shares)};
    prepared_->render({kWhole, 0, 0, kSamples},
                      {.sampler = sampler, .seed = seed, .pixels = &shares}, result);
    film.merge(result.film);
    film.end_pass(kSamples);
    return film.layers();
  }
  PathTrace replay(std::uint64_t pixel, std::uint32_t sample) const {
    return prepared_->replay({.seed = seed_, .iteration = 0, .index = pixel, .sample = sample},
                             context(false));
  }

 private:
  IterationContext context(bool record) const { return {sampler_, seed_, nullptr, record, record}; }

  Scene scene_;
  std::unique_ptr<const PreparedSensor> sensor_;
  std::unique_ptr<const PreparedIntegrator> prepared_;
  KeyedSampler sampler_;
  std::uint64_t seed_;
};

/// Returns the image of work units that cover all samples of all pixels.
Image image_of(Film film, const std::vector<WorkResult>& units) {
  for (const WorkResult& unit : units) film.merge(unit.film);
  film.end_pass(kSamples);
  return film.layers();
}

/// A sampler of independent numbers that counts the paths of each pixel.
class CountingSampler final : public PreparedSampler {
 public:
  std::uint64_t begin(const PathKey& key) const override {
    if (key.index < paths_.size()) ++paths_[key.index];
    return numbers_.begin(key);
  }
  float value_1d(const SampleStream& stream, Dimension dimension) const override {
    return numbers_.value_1d(stream, dimension);
  }
  Vec2 value_2d(const SampleStream& stream, Dimension dimension) const override {
    return numbers_.value_2d(stream, dimension);
  }
  std::uint32_t paths(int x, int y) const { return paths_[kWhole.index(x, y)]; }

 private:
  KeyedSampler numbers_;
  mutable std::vector<std::uint32_t> paths_ = std::vector<std::uint32_t>(kWhole.area());
};

/// Every other pixel has few samples.
bool has_few(int x, int y) {
  return (x + y) % 2 == 0;
}
PixelShares uneven_shares() {
  std::vector<float> shares;
  for (int y = 0; y < kEdge; ++y) {
    for (int x = 0; x < kEdge; ++x) shares.push_back(has_few(x, y) ? 0.25f : 1.75f);
  }
  return {kWhole, std::move(shares)};
}

/// Tests that pixels get the numbers of paths by their shares, and the same light as with even
/// shares: pixels with few and with many samples are tested apart.
void check_shares(const Setup& setup, const char* where, std::uint64_t seed, Check& check) {
  constexpr std::uint64_t kSeeds = 24;
  const PixelShares even, uneven = uneven_shares();
  const CountingSampler counting;
  setup.shared_image(uneven, counting, seed);
  for (int y = 0; y < kEdge; ++y) {
    for (int x = 0; x < kEdge; ++x) {
      check.expect(counting.paths(x, y) == uneven.count(x, y, kSamples), [&] {
        return fmt::format("{}: pixel ({}, {}) has {} paths, by its share it has {}", where, x, y,
                           counting.paths(x, y), uneven.count(x, y, kSamples));
      });
    }
  }
  // Sums over pixels with few and with many samples, for each seed.
  const auto light = [&](const PixelShares& shares, std::uint64_t first_seed, bool few) {
    const KeyedSampler sampler;
    std::vector<double> sums;
    for (std::uint64_t i = 0; i < kSeeds; ++i) {
      const Image image = setup.shared_image(shares, sampler, first_seed + i);
      double sum = 0;
      for (int y = 0; y < kEdge; ++y) {
        for (int x = 0; x < kEdge; ++x) sum += has_few(x, y) == few ? mean(image.rgb(x, y)) : 0;
      }
      sums.push_back(sum);
    }
    return statistics::estimate(statistics::moments(sums));
  };
  for (const bool few : {true, false}) {
    const auto a = light(even, seed + 1, few), b = light(uneven, seed + 1 + kSeeds, few);
    check.add_p_value(
        statistics::welch_test(a, b).p_value,
        fmt::format("{}: pixels with {} samples have the light {:.4f} +- {:.4f}, and with even "
                    "shares {:.4f} +- {:.4f}",
                    where, few ? "few" : "many", b.mean, std::sqrt(b.squared_error), a.mean,
                    std::sqrt(a.squared_error)));
  }
}

double total(const Image& image) {
  double sum = 0;
  for (int y = 0; y < kEdge; ++y) {
    for (int x = 0; x < kEdge; ++x) sum += mean(image.rgb(x, y));
  }
  return sum;
}

/// Returns whether two images are equal up to a tolerance relative to the mean of the first.
bool alike(const Image& a, const Image& b, double tolerance) {
  const double scale = tolerance * total(a) / (kEdge * kEdge);
  for (int y = 0; y < kEdge; ++y) {
    for (int x = 0; x < kEdge; ++x) {
      for (int c = 0; c < 3; ++c) {
        const double difference = double{a.rgb(x, y)[c]} - b.rgb(x, y)[c];
        if (!(std::abs(difference) <= scale)) return false;
      }
    }
  }
  return true;
}

void check_room(const Integrator& integrator, bool foggy, Suite& suite, Check& finite,
                Check& determinism, Check& units, Check& replay, Check& shares, Check& recording) {
  const Setup setup(integrator, foggy, suite.seed());
  const Film film = setup.new_film();
  const char* where = foggy ? "in fog" : "in empty space";
  std::vector<WorkResult> whole;
  whole.push_back(setup.render(film, kWhole, 0, kSamples));
  const Image image = image_of(film, whole);
  const std::uint64_t invalid = whole[0].counters.invalid_paths;
  finite.expect(invalid == 0, [&] { return fmt::format("{}: {} invalid paths", where, invalid); });
  finite.expect(total(image) > 0, [&] { return fmt::format("{}: the image is black", where); });

  std::vector<WorkResult> again;
  again.push_back(setup.render(film, kWhole, 0, kSamples));
  determinism.expect(alike(image, image_of(film, again), 0), [&] {
    return fmt::format("{}: a work unit that is rendered again has another image", where);
  });

  std::vector<WorkResult> parts;
  for (const PixelRect& tile :
       {PixelRect{0, 0, kEdge, 5}, PixelRect{0, 5, 9, kEdge}, PixelRect{9, 5, kEdge, kEdge}}) {
    for (std::uint32_t first = 0; first < kSamples; first += kSamples / 2) {
      parts.push_back(setup.render(film, tile, first, kSamples / 2));
    }
  }
  units.expect(alike(image, image_of(film, parts), 1e-4), [&] {
    return fmt::format("{}: the image depends on how the work is divided into units", where);
  });

  double replayed = 0;
  for (std::uint64_t pixel = 0; pixel < kEdge * kEdge; ++pixel) {
    for (std::uint32_t sample = 0; sample < kSamples; ++sample) {
      replayed += mean(setup.replay(pixel, sample).radiance) / kSamples;
    }
  }
  // Paths from lights may land outside the film. replay() counts only contributions to the film.
  replay.expect(close(replayed, total(image), 1e-3), [&] {
    return fmt::format("{}: all paths replayed add up to {:.5f}, the image to {:.5f}", where,
                       replayed, total(image));
  });

  check_shares(setup, where, suite.seed(), shares);

  if (!integrator.traits().guided) {
    recording.not_applicable("it asks no guides, so nothing is recorded");
    return;
  }
  std::vector<WorkResult> recorded;
  recorded.push_back(setup.render(film, kWhole, 0, kSamples, true));
  const bool is_same =
      integrator.traits().trains_with_other_paths || alike(image, image_of(film, recorded), 0);
  recording.expect(is_same, [&] { return fmt::format("{}: recording changes the image", where); });
  recording.expect(recorded[0].log.size() >= kEdge * kEdge * kSamples, [&] {
    return fmt::format("{}: {} paths of {} are recorded", where, recorded[0].log.size(),
                       kEdge * kEdge * kSamples);
  });
}

}  // namespace

void check_integrator(const Integrator& integrator, Suite& suite) {
  Check& finite = suite.check("finite");
  Check& determinism = suite.check("determinism");
  Check& units = suite.check("work_units");
  Check& replay = suite.check("replay");
  Check& shares = suite.check("pixel_shares");
  Check& recording = suite.check("recording");
  for (const bool foggy : {false, true}) {
    check_room(integrator, foggy, suite, finite, determinism, units, replay, shares, recording);
  }
}

}  // namespace pharos::conformance
