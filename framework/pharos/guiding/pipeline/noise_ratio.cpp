#include <algorithm>
#include <cmath>
#include <utility>

#include <pharos/guiding/pipeline/noise_ratio.h>

namespace pharos {
namespace {

constexpr int kTileSize = 8;
/// Number of samples per pixel of the image whose error is estimated, and so the largest
/// contribution that the image shows, over the mean of its tile.
constexpr double kSamples = 128;

/// Returns the quotient of the densities of guided and unguided sampling of the step from a vertex.
double density_quotient(const PathView& path, const RecordedVertex& vertex) {
  const std::span<const Technique> techniques = path.techniques(vertex);
  if (techniques.size() < 2) return 1;
  return double{vertex.pdf} / double{techniques[0].density};
}

/// Sums over the vertices of one path. Vertices are added from the last to the first.
struct Found {
  double shown = 0, shown_squared = 0, missing = 0;

  /// Adds `x`, of which an image shows at most `limit`. `r` is the quotient r_j.
  void add(double x, double limit, double r) {
    const double visible = std::min(x, limit);
    shown_squared += r * visible * (visible + 2 * shown);
    shown += visible;
    missing += x - visible;
  }
  template <class Sums>
  void add_to(Sums& sums) const {
    sums.shown += shown;
    sums.shown_squared += shown_squared;
    sums.missing += missing;
    sums.missing_squared += missing * missing;
  }
};

}  // namespace

NoiseRatio::NoiseRatio(PixelRect window)
    : window_(window), tiles_per_row_((window.width() + kTileSize - 1) / kTileSize) {
  const int rows = (window.height() + kTileSize - 1) / kTileSize;
  tiles_.resize(static_cast<std::size_t>(tiles_per_row_) * rows);
}

NoiseRatio::Tile& NoiseRatio::tile_at(Vec2 film) {
  const int x = std::clamp(static_cast<int>(film.x), window_.x0, window_.x1 - 1) - window_.x0;
  const int y = std::clamp(static_cast<int>(film.y), window_.y0, window_.y1 - 1) - window_.y0;
  return tiles_[static_cast<std::size_t>(y / kTileSize) * tiles_per_row_ + x / kTileSize];
}

void NoiseRatio::absorb(const PathLog& log) {
  for (std::size_t i = 0; i < log.size(); ++i) {
    if (log[i].transport == Transport::radiance) add(log[i]);
  }
}

void NoiseRatio::add(const PathView& path) {
  const std::size_t count = path.vertices.size();
  found_.assign(count, 0);
  quotients_.assign(count, 1);
  for (const RecordedLightSample& sample : path.light_samples) {
    const Rgb throughput = path.vertices[sample.vertex].throughput;
    found_[sample.vertex] += mean(throughput * sample.contribution);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const RecordedVertex& vertex = path.vertices[i];
    found_[i] += mean(vertex.throughput * vertex.emission);
    if (vertex.parent == kNoVertex) continue;
    quotients_[i] =
        quotients_[vertex.parent] * density_quotient(path, path.vertices[vertex.parent]);
  }

  Tile& tile = tile_at(path.film);
  ++tile.new_paths;
  Found guided, unguided;
  for (std::size_t i = count; i-- > 0;) {
    const double r = quotients_[i];
    if (!(found_[i] > 0) || !std::isfinite(found_[i]) || !std::isfinite(r)) continue;
    tile.new_brightness += found_[i];
    guided.add(found_[i], tile.limit, 1);
    unguided.add(found_[i], tile.limit / r, r);
  }
  guided.add_to(tile.guided);
  unguided.add_to(tile.unguided);
}

/// Takes the ratio as one of two means over tiles, and computes its error to first order.
auto NoiseRatio::ratio() const -> std::optional<Ratio> {
  double guided = 0, unguided = 0;
  double guided_squared = 0, unguided_squared = 0, product = 0;
  int count = 0;
  for (const Tile& tile : tiles_) {
    const double n = tile.new_paths;
    if (!(n > 1) || !(tile.limit > 0)) continue;
    const auto error = [&](const Sums& sums) {
      const double variance = (sums.shown_squared - sums.shown * sums.shown / n) / (n - 1);
      // The square of the mean, without the variance of the mean.
      const double missing = (sums.missing * sums.missing - sums.missing_squared) / (n * (n - 1));
      return n * (variance + kSamples * missing) / tile.limit;
    };
    const double g = error(tile.guided), u = error(tile.unguided);
    guided += g;
    unguided += u;
    guided_squared += g * g;
    unguided_squared += u * u;
    product += g * u;
    ++count;
  }
  if (!(unguided > 0)) return std::nullopt;
  if (!(guided > 0)) return Ratio{};
  const double mean = guided / unguided;
  const double squares = guided_squared - 2 * mean * product + mean * mean * unguided_squared;
  const double scale = count > 1 ? static_cast<double>(count) / (count - 1) : 0;
  return Ratio{mean, std::sqrt(scale * std::max(squares, 0.0)) / guided};
}

void NoiseRatio::end_iteration(bool is_guided) {
  if (is_guided) before_ = std::exchange(value_, ratio());
  double brightness = 0, paths = 0;
  for (Tile& tile : tiles_) {
    tile.brightness += tile.new_brightness;
    tile.paths += tile.new_paths;
    brightness += tile.brightness;
    paths += tile.paths;
    tile.new_brightness = tile.new_paths = 0;
    tile.guided = tile.unguided = {};
  }
  // Each pixel of a tile has another sample of the image's mean brightness, so tiles that have
  // found little or nothing have a limit, too.
  constexpr double kPriorPaths = kTileSize * kTileSize;
  const double prior = paths > 0 ? kPriorPaths * brightness / paths : 0;
  for (Tile& tile : tiles_) {
    tile.limit = kSamples * (tile.brightness + prior) / (tile.paths + kPriorPaths);
  }
}

std::optional<double> NoiseRatio::fall() const {
  if (!before_ || !value_ || !(before_->mean > 0)) return std::nullopt;
  return std::log(before_->mean / value_->mean);
}

std::optional<double> NoiseRatio::possible_fall() const {
  if (!fall()) return std::nullopt;
  return *fall() + std::hypot(before_->relative_error, value_->relative_error);
}

void NoiseRatio::archive(Archive& archive) {
  const std::size_t count = tiles_.size();
  archive(tiles_);
  archive.expect(tiles_.size() == count, "the measure of guiding");
  for (std::optional<Ratio>* ratio : {&before_, &value_}) {
    bool is_known = ratio->has_value();
    Ratio value = ratio->value_or(Ratio{});
    archive(is_known, value);
    *ratio = is_known ? std::optional(value) : std::nullopt;
  }
}

}  // namespace pharos
