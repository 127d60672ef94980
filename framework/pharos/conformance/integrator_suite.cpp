#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <pharos/conformance/guide_stage.h>
#include <pharos/conformance/guided.h>
#include <pharos/conformance/suites.h>
#include <pharos/rendering/film.h>

namespace pharos::conformance {
namespace {

constexpr int kEdge = 16;
constexpr std::uint32_t kSamples = 8;
constexpr PixelRect kWhole{0, 0, kEdge, kEdge};

/// A filter by which each sample counts only in its own pixel, so that sums over the film are sums
/// over paths.
class OnePixel final : public Filter {
 public:
  float radius() const override { return 0.5f; }
  float evaluate(Vec2) const override { return 1; }
  float integral() const override { return 1; }
};

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
                Check& determinism, Check& units, Check& replay, Check& recording) {
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
  Check& recording = suite.check("recording");
  for (const bool foggy : {false, true}) {
    check_room(integrator, foggy, suite, finite, determinism, units, replay, recording);
  }
}

}  // namespace pharos::conformance
