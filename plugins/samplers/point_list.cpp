// point_list: points from a file, such as sets that `pharos synthesize` or another program has
// made. A set has as many samples as the file has points. Each pair of numbers of a set is one of
// these points, moved on the torus (Cranley and Patterson 1976, "Randomization of Number Theoretic
// Methods for Multiple Integration"). Each dimension of a pixel has its own offset and visits the
// points in its own order. Samples beyond a set belong to the next set, with new offsets and
// orders. Single numbers are jittered, one per stratum.
//
//     { type: point_list, file: points.txt }
#include "point_list.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include <pharos/config/registry.h>
#include <pharos/core/error.h>

#include "keyed_seeds.h"
#include "strata.h"
#include "unit_steps.h"

namespace pharos {
namespace {

class PreparedPointList final : public PreparedSampler {
 public:
  /// `seed` draws the orders of the points.
  PreparedPointList(std::vector<Vec2> points, std::uint64_t seed)
      : points_(std::move(points)), strata_(count()), orders_(count(), seed) {}

  std::uint64_t begin(const PathKey& key) const override {
    return SetPlace::of(key, count()).state();
  }
  float value_1d(const SampleStream& stream, Dimension dimension) const override {
    const SetPlace place(stream.state());
    return stratified_number(place.index(), orders_, strata_,
                             seeds_of(place.set_hash(), dimension));
  }
  Vec2 value_2d(const SampleStream& stream, Dimension dimension) const override {
    const SetPlace place(stream.state());
    const Seeds seeds = seeds_of(place.set_hash(), dimension);
    const std::uint64_t offset = (std::uint64_t{seeds.more} << 32) | seeds.x;
    return moved(points_[orders_(place.index(), seeds.order)], offset);
  }

 private:
  std::uint32_t count() const { return static_cast<std::uint32_t>(points_.size()); }

  std::vector<Vec2> points_;
  Strata strata_;
  DrawnPermutations orders_;
};

constexpr std::string_view kSpaces = " \t\r";

/// Reads a number in [0, 1) from the beginning of `text` and removes it and spaces around it.
/// Returns a negative number if there is none.
double take_number(std::string_view& text) {
  const auto skip_spaces = [&] {
    text.remove_prefix(std::min(text.find_first_not_of(kSpaces), text.size()));
  };
  skip_spaces();
  double value = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || !(value >= 0 && value < 1)) return -1;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  skip_spaces();
  return value;
}

}  // namespace

std::vector<Vec2> read_point_list(const std::filesystem::path& file) {
  if (const std::string problem = file_problem(file); !problem.empty()) {
    throw InputError(fmt::format("'{}': {}", file.string(), problem));
  }
  std::vector<Vec2> points;
  std::ifstream in(file);
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    std::string_view rest = line;
    if (line.find_first_not_of(kSpaces) == std::string::npos || line.front() == '#') continue;
    const double x = take_number(rest), y = take_number(rest);
    const Location here{.file = file.string(), .line = number};
    if (x < 0 || y < 0 || !rest.empty()) {
      throw InputError(here, "expected two numbers in [0, 1), found '" + one_line(line, 40) + "'");
    }
    if (points.size() == SetPlace::kMostSamples) {
      throw InputError(here, fmt::format("more than {} points", SetPlace::kMostSamples));
    }
    points.push_back(
        {number_of(steps_of(static_cast<float>(x))), number_of(steps_of(static_cast<float>(y)))});
  }
  if (points.empty()) throw InputError(Location{.file = file.string()}, "no points");
  return points;
}

void PointListSampler::Settings::describe(Schema<Settings>& s) {
  s.field("file", &Settings::file, "Text file with one point per line: two numbers in [0, 1)")
      .required();
  s.example("{ file: example.txt }");
}

std::unique_ptr<const PreparedSampler> PointListSampler::prepare(const PixelGrid&,
                                                                 const SamplePlan& plan,
                                                                 const IntegrandProbe*) const {
  return std::make_unique<PreparedPointList>(points_, plan.seed);
}

}  // namespace pharos
