// aligned: draws points whose power spectrum is low along the directions in which the power
// spectrum of the integrand is high (Werner, Hanika and Dachsbacher, "Optimized and Aligned
// Anisotropic Monte Carlo Sampling Patterns"). An edge, such as the edge of an occluder before a
// light, makes the integrand of two random numbers discontinuous across a line. If the points are
// evenly spread along the normal of this line and along both axes, the variance of the estimate
// falls about as n^-1.75 instead of n^-1.5.
//
// Before rendering, the sampler probes the integrands in blocks of pixels and estimates the
// principal directions of their edges. The numbers of `purposes` are then points of the set for
// these directions. A random toroidal shift moves the set for each pixel, and each dimension visits
// its points in an order of its own. The sampler can align the lens, the lights at the first hit
// and the direction at the first hit. Each light is a dimension of its own; this requires the
// integrator to sample `all` lights. The base sampler provides all other numbers, and the numbers
// of integrands without an edge.
//
// With guiding, a part of the samples is drawn by the BSDF. With `ordered_choice`, the direction
// numbers of these samples are evenly spread along the (first) normal, up to the seam of the shift.
//
// Sets have 64, 256, 1024 or 4096 points. The sampler uses the largest set that the samples of a
// pixel fill. With fewer than 64 samples, the base sampler provides all numbers and nothing is
// probed. With `directions: 4`, the points are aligned with two edges at once. The sets for two
// edges are synthesized when they are first needed, which takes a few seconds for a set of 4096
// points. They are kept in the user's cache.
//
//     sampler: { type: aligned }
//     integrator: { type: path, light_selection: all }
#include "aligned_sampler.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include <pharos/config/registry.h>
#include <pharos/core/error.h>
#include <pharos/core/random.h>

#include "aligned_dimensions.h"
#include "point_set_library.h"
#include "set_order.h"
#include "shipped_sets.h"

namespace pharos::aligned {
namespace {

/// Collects the point sets in use.
class SetTable {
 public:
  static constexpr std::uint32_t kNone = 0xffffffff;

  SetTable(const PointSetLibrary& library, std::uint32_t size) : library_(library), size_(size) {}

  /// Returns the index in points() at which the set for these directions begins, or kNone if there
  /// are no directions.
  std::uint32_t begin_of(const FreeDirections& directions) {
    if (directions.count == 0) return kNone;
    const std::vector<double> wanted(directions.begin(), directions.end());
    const auto next = static_cast<std::uint32_t>(points_.size());
    const auto [entry, is_new] = begins_.try_emplace(library_.snapped(wanted), next);
    if (is_new) {
      PointSet set = library_.find(wanted, size_);
      sort_into_cells(set);
      points_.insert(points_.end(), set.begin(), set.end());
      const std::vector<std::uint32_t> of_set = spread_choices(set, entry->first.front());
      choices_.insert(choices_.end(), of_set.begin(), of_set.end());
    }
    return entry->second;
  }
  /// The points of all sets, one set after the other, each sorted into cells.
  const PointSet& points() const { return points_; }
  /// The numbers of spread_choices() of these points.
  const std::vector<std::uint32_t>& choices() const { return choices_; }

 private:
  const PointSetLibrary& library_;
  std::uint32_t size_;
  std::map<std::vector<int>, std::uint32_t> begins_;
  PointSet points_;
  std::vector<std::uint32_t> choices_;
};

/// The choice between guide and BSDF at the first hit, and the number of the BSDF's direction.
constexpr Dimension kChoice{Purpose::mix_choice, 1}, kChosen{Purpose::bsdf_direction, 1};

/// The 128 bits of a product.
struct WideProduct {
  std::uint64_t high, low;
};
WideProduct wide_product(std::uint64_t a, std::uint64_t b) {
  __extension__ using Long = unsigned __int128;
  const Long product = Long{a} * b;
  return {static_cast<std::uint64_t>(product >> 64), static_cast<std::uint64_t>(product)};
}

class PreparedAligned final : public PreparedSampler {
 public:
  PreparedAligned(std::unique_ptr<const PreparedSampler> base, const DirectionField& field,
                  const PointSetLibrary& library, std::uint32_t size, bool ordered_choice)
      : base_(std::move(base)),
        places_(field.dimensions()),
        bits_(std::countr_zero(size)),
        orders_(bits_),
        pixel_count_(field.regions().pixel_count()),
        film_samples_(field.samples()) {
    const auto of_base = base_->film_samples();
    film_samples_.insert(film_samples_.end(), of_base.begin(), of_base.end());
    SetTable table(library, size);
    for (std::size_t i = 0; i < field.dimensions().size(); ++i) {
      std::vector<std::uint32_t> of_regions;
      for (std::size_t region = 0; region < field.regions().count(); ++region) {
        of_regions.push_back(table.begin_of(field.at(i, region)));
      }
      for (std::size_t pixel = 0; pixel < pixel_count_; ++pixel) {
        sets_.push_back(of_regions[field.regions().of(pixel)]);
      }
    }
    points_ = table.points();
    choices_ = table.choices();
    if (ordered_choice) chosen_place_ = places_.find(kChosen);
  }

  std::uint64_t begin(const PathKey& key) const override { return base_->begin(key); }
  float value_1d(const SampleStream& stream, Dimension dimension) const override {
    if (dimension == kChoice && chosen_place_ >= 0) {
      const std::uint32_t set = set_of(stream.key().index, chosen_place_);
      if (set != SetTable::kNone) return choice(set, stream.key());
    }
    return base_->value_1d(stream, dimension);
  }
  Vec2 value_2d(const SampleStream& stream, Dimension dimension) const override {
    const int place = places_.find(dimension);
    if (place < 0) return base_->value_2d(stream, dimension);
    const std::uint32_t set = set_of(stream.key().index, place);
    if (set == SetTable::kNone) return base_->value_2d(stream, dimension);
    return shifted(set, stream.key(), dimension);
  }
  std::span<const FilmSample> film_samples() const override { return film_samples_; }

 private:
  /// Returns the index in `points_` at which the set begins. Paths that belong to no pixel of the
  /// film use the set of the first pixel, because the points of any set are uniform.
  std::uint32_t set_of(std::uint64_t pixel, int place) const {
    const std::size_t known = pixel < pixel_count_ ? pixel : 0;
    return sets_[static_cast<std::size_t>(place) * pixel_count_ + known];
  }

  /// Two random words that all samples of a pixel's set share.
  struct SetKey {
    std::uint64_t offset;
    std::uint32_t order;
  };
  /// The hash uses both halves of two wide products, because every path pays for it. Each bit of
  /// these products depends on many bits of both factors.
  SetKey set_key(const PathKey& key, Dimension dimension) const {
    const std::uint64_t pixel = key.index * 0xb564ef22ec7aece5ull + key.seed;
    const std::uint64_t part = dimension.code() * 0x9fb21c651e98df25ull +
                               ((std::uint64_t{key.iteration} << 32) | (key.sample >> bits_));
    const WideProduct mixed =
        wide_product(pixel ^ 0xd1342543de82ef95ull, part ^ 0xaf251af3b0f025b5ull);
    const WideProduct bits = wide_product(mixed.high ^ mixed.low, 0xf7c2ebc08f67f2b5ull);
    return {bits.high ^ bits.low, static_cast<std::uint32_t>(bits.high)};
  }

  /// Returns the sample's point, shifted on the torus.
  Vec2 shifted(std::uint32_t set, const PathKey& key, Dimension dimension) const {
    const auto [offset, order] = set_key(key, dimension);
    const GridPoint p = points_[set + orders_.place(key.sample, order)];
    // Sums of 32 bits wrap around like the torus.
    return {to_unit_float((std::uint32_t{p.x} << 16) + static_cast<std::uint32_t>(offset >> 32)),
            to_unit_float((std::uint32_t{p.y} << 16) + static_cast<std::uint32_t>(offset))};
  }

  /// Returns the number that decides whether a guide or the BSDF draws the direction for which the
  /// sample has a point of the set.
  float choice(std::uint32_t set, const PathKey& key) const {
    const std::uint32_t order = set_key(key, kChosen).order;
    const auto offset = static_cast<std::uint32_t>(set_key(key, kChoice).offset);
    return to_unit_float(choices_[set + orders_.place(key.sample, order)] + offset);
  }

  std::unique_ptr<const PreparedSampler> base_;
  DimensionPlaces places_;
  int bits_;  ///< binary logarithm of the number of points per set
  SetOrders orders_;
  std::size_t pixel_count_;
  std::vector<std::uint32_t> sets_;  ///< by dimension, then by pixel
  PointSet points_;
  std::vector<std::uint32_t> choices_;  ///< of the points, see spread_choices()
  int chosen_place_ = -1;               ///< of kChosen; -1: choices are numbers of the base
  std::vector<FilmSample> film_samples_;
};

/// Returns a field with the stated directions for all dimensions and all pixels.
DirectionField stated_directions(const std::vector<double>& angles,
                                 std::vector<Dimension> dimensions) {
  FreeDirections stated;
  for (const double angle : angles) stated.add(as_direction(static_cast<int>(std::lround(angle))));
  std::vector<FreeDirections> directions(dimensions.size(), stated);
  constexpr std::uint32_t kAnyPixel = 0;
  return {PixelRegions(std::span(&kAnyPixel, 1)), std::move(dimensions), std::move(directions)};
}

}  // namespace

void AlignedSettings::describe(Schema<AlignedSettings>& s) {
  using S = AlignedSettings;
  s.field("base", &S::base, "Sampler of all numbers that are not aligned").otherwise("pmj02bn");
  s.field("purposes", &S::purposes,
          "Which numbers are aligned: light_position and bsdf_direction at the first hit, and lens")
      .check("of light_position, bsdf_direction and lens", [](const std::vector<Purpose>& all) {
        return std::all_of(all.begin(), all.end(), can_be_aligned);
      });
  s.field("lights", &S::lights,
          "Largest number of lights that are aligned; the first lights of the scene are taken")
      .at_least(1)
      .at_most(256);
  s.field("directions", &S::directions,
          "Largest number of directions that points are aligned with, including both axes")
      .at_least(3)
      .at_most(2 + kMostFree);
  s.field("ordered_choice", &S::ordered_choice,
          "If bsdf_direction is aligned: choose between guide and BSDF so that the numbers of the "
          "directions that the BSDF draws stay evenly spread along the normal of the edge");
  s.field("angles", &S::angles,
          "Normals of the edges for all pixels; if empty, they are estimated for each block")
      .unit("degrees")
      .at_least(-360)
      .at_most(360);
  s.field("samples", &S::samples,
          "Number of points per set, a power of two; by default the size of the largest set of the "
          "program that the samples per pixel fill, or 64 with a time budget")
      .check("a power of two from 64 to 65536",
             [](const std::optional<std::uint32_t>& n) { return !n || is_set_size(*n); });
  s.field("synthesize", &S::synthesize,
          "Whether sets may have any power of two of points; sizes that the program lacks are "
          "synthesized");
  s.field("estimation", &S::estimation, "How directions are estimated");
  s.field("pair_step", &S::pair_step,
          "Spacing of the grid of directions for sets of two directions")
      .unit("degrees")
      .check("a divisor of 45", [](const int& step) { return step > 0 && 45 % step == 0; });
  s.field("cache_folder", &S::cache_folder,
          "Folder in which synthesized sets are kept; by default in the user's cache");
  s.example("{ angles: [30], samples: 64 }");
  s.example("{ estimation: { surfaces: {} } }");
}

AlignedSampler::AlignedSampler(const Settings& settings) : settings_(settings) {
  const ProbeGrid& grid = settings.estimation.grid;
  if (grid.tiles < 1 || grid.cells % grid.tiles != 0) {
    throw InputError(fmt::format("a grid of {} cells cannot be divided into {} tiles along an axis",
                                 grid.cells, grid.tiles));
  }
  const int most = settings.directions - 2;
  if (static_cast<int>(settings.angles.size()) > most) {
    throw InputError(fmt::format("{} directions are both axes and {} more, found {} angles",
                                 settings.directions, most, settings.angles.size()));
  }
}

std::uint32_t AlignedSampler::set_size(std::uint32_t samples_per_pixel) const {
  if (settings_.samples) return *settings_.samples;
  if (settings_.synthesize) {
    return std::bit_floor(std::clamp(samples_per_pixel, kFewestPoints, kMostPoints));
  }
  const auto above =
      std::upper_bound(kShippedSizes.begin(), kShippedSizes.end(), samples_per_pixel);
  return above == kShippedSizes.begin() ? kShippedSizes.front() : *(above - 1);
}

std::uint32_t AlignedSampler::preferred_samples(const SamplePlan& plan) const {
  const bool sets_are_passes = settings_.samples || plan.samples_per_pixel == 0;
  const std::uint32_t own = sets_are_passes ? set_size(plan.samples_per_pixel) : 1;
  return std::lcm(own, settings_.base->preferred_samples(plan));
}

DirectionField AlignedSampler::estimate(const IntegrandProbe* probe, std::uint64_t seed) const {
  if (probe == nullptr) {
    throw InputError(
        "the sampler 'aligned' looks at integrands before rendering, which this integrator keeps "
        "to itself: state its angles");
  }
  const int lights = std::min(settings_.lights, probe->light_branches());
  return estimate_directions(*probe, aligned_dimensions(settings_.purposes, lights),
                             settings_.estimation, settings_.directions - 2, seed);
}

std::unique_ptr<const PreparedSampler> AlignedSampler::prepare(const PixelGrid& grid,
                                                               const SamplePlan& plan,
                                                               const IntegrandProbe* probe) const {
  auto base = settings_.base->prepare(grid, plan, probe);
  const std::uint32_t size = set_size(plan.samples_per_pixel);
  const bool is_filled =
      settings_.samples || plan.samples_per_pixel == 0 || plan.samples_per_pixel >= size;
  if (!is_filled) return base;
  const DirectionField field =
      settings_.angles.empty()
          ? estimate(probe, plan.seed)
          : stated_directions(settings_.angles,
                              aligned_dimensions(settings_.purposes, settings_.lights));
  const PointSetLibrary library(
      {.cache_folder = settings_.cache_folder, .pair_step = settings_.pair_step});
  return std::make_unique<PreparedAligned>(std::move(base), field, library, size,
                                           settings_.ordered_choice);
}

}  // namespace pharos::aligned
