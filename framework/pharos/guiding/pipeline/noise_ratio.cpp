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

double square(double x) {
  return x * x;
}

/// Sums over the vertices of one path. Vertices are added from the last to the first.
struct Found {
  double shown = 0, second_moment = 0, missing = 0;

  /// Adds `x`, of which an image shows at most `limit`. `r` is the quotient r_j.
  void add(double x, double limit, double r) {
    const double visible = std::min(x, limit);
    second_moment += r * visible * (visible + 2 * shown);
    shown += visible;
    missing += x - visible;
  }
  template <class Sums>
  void add_to(Sums& sums) const {
    sums.shown += shown;
    sums.second_moment += second_moment;
    sums.shown_squared += shown * shown;
    sums.missing += missing;
    sums.missing_squared += missing * missing;
  }
};

}  // namespace

NoiseRatio::NoiseRatio(PixelRect window)
    : window_(window), tiles_per_row_((window.width() + kTileSize - 1) / kTileSize) {
  const int rows = (window.height() + kTileSize - 1) / kTileSize;
  tiles_.resize(static_cast<std::size_t>(tiles_per_row_) * rows);
  pixels_.resize(window.area());
}

void NoiseRatio::absorb(const PathLog& log) {
  for (std::size_t i = 0; i < log.size(); ++i) {
    if (log[i].transport == Transport::radiance) add(log[i]);
  }
}

/// Fills in what the path finds at each of its vertices.
void NoiseRatio::find(const PathView& path) {
  const std::size_t count = path.vertices.size();
  steps_.assign(count, {});
  for (const RecordedLightSample& sample : path.light_samples) {
    Step& step = steps_[sample.vertex];
    const double found = mean(path.vertices[sample.vertex].throughput * sample.contribution);
    step.guided += found;
    if (found > 0) step.unguided += found * sample.unguided_mis_weight / sample.mis_weight;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const RecordedVertex& vertex = path.vertices[i];
    Step& step = steps_[i];
    step.guided += mean(vertex.throughput * vertex.emission);
    step.unguided += mean(vertex.throughput * vertex.unguided_emission);
    if (vertex.parent == kNoVertex) continue;
    step.quotient =
        steps_[vertex.parent].quotient * density_quotient(path, path.vertices[vertex.parent]);
  }
}

void NoiseRatio::add(const PathView& path) {
  find(path);
  const int x = std::clamp(static_cast<int>(path.film.x), window_.x0, window_.x1 - 1);
  const int y = std::clamp(static_cast<int>(path.film.y), window_.y0, window_.y1 - 1);
  const int column = (x - window_.x0) / kTileSize, row = (y - window_.y0) / kTileSize;
  Tile& tile = tiles_[static_cast<std::size_t>(row) * tiles_per_row_ + column];
  ++tile.new_paths;
  Found guided, unguided;
  for (std::size_t i = steps_.size(); i-- > 0;) {
    const Step& step = steps_[i];
    const double r = step.quotient;
    if (!std::isfinite(step.guided) || !std::isfinite(step.unguided * r)) continue;
    tile.new_brightness += step.guided;
    guided.add(step.guided, tile.limit, 1);
    unguided.add(step.unguided, tile.limit / r, r);
  }
  guided.add_to(tile.guided);
  unguided.add_to(tile.unguided);
  Pixel& pixel = pixels_[window_.index(x, y)];
  ++pixel.paths;
  pixel.guided += guided.shown;
  pixel.unguided += unguided.shown;
}

PixelRect NoiseRatio::pixels_of(std::size_t tile) const {
  const int x = window_.x0 + kTileSize * static_cast<int>(tile % tiles_per_row_);
  const int y = window_.y0 + kTileSize * static_cast<int>(tile / tiles_per_row_);
  return {x, y, std::min(x + kTileSize, window_.x1), std::min(y + kTileSize, window_.y1)};
}

auto NoiseRatio::pairs_in(std::size_t tile) const -> Pairs {
  const PixelRect pixels = pixels_of(tile);
  const std::uint32_t paths = pixels_[window_.index(pixels.x0, pixels.y0)].paths;
  bool counts_pixels = paths > 1;
  Pairs of_pixels, of_tile;
  for (int y = pixels.y0; y < pixels.y1; ++y) {
    for (int x = pixels.x0; x < pixels.x1; ++x) {
      const Pixel& pixel = pixels_[window_.index(x, y)];
      of_pixels.add(pixel.paths, pixel.guided, pixel.unguided);
      counts_pixels &= pixel.paths == paths;
    }
  }
  if (counts_pixels) return of_pixels;
  of_tile.add(tiles_[tile].new_paths, tiles_[tile].guided.shown, tiles_[tile].unguided.shown);
  return of_tile;
}

auto NoiseRatio::Quotient::value() const -> std::optional<Ratio> {
  if (!(under > 0)) return std::nullopt;
  if (!(over > 0)) return Ratio{};
  const double mean = over / under;
  const double squares = over_squared - 2 * mean * product + mean * mean * under_squared;
  const double scale = count > 1 ? static_cast<double>(count) / (count - 1) : 0;
  return Ratio{mean, std::sqrt(scale * std::max(squares, 0.0)) / over};
}

auto NoiseRatio::unguided_light() const -> Light {
  Light light;
  for (const Tile& tile : tiles_) {
    if (!tile.is_measured()) continue;
    light.shown += tile.unguided.shown / tile.limit;
    light.missing += tile.unguided.missing / tile.limit;
  }
  return light;
}

auto NoiseRatio::ratio(const Light& unguided) const -> std::optional<Ratio> {
  Quotient of_errors, of_light;
  for (std::size_t i = 0; i < tiles_.size(); ++i) {
    const Tile& tile = tiles_[i];
    if (!tile.is_measured()) continue;
    const double n = tile.new_paths;
    const Pairs pairs = pairs_in(i);
    // Squares of means are products of different paths, so they do not contain variances of means.
    const auto error = [&](const Sums& sums, double squares) {
      const double variance = sums.second_moment / n - (squares - sums.shown_squared) / pairs.count;
      const double hidden = (square(sums.missing) - sums.missing_squared) / (n * (n - 1));
      return n * (variance + kSamples * hidden) / tile.limit;
    };
    of_errors.add(error(tile.guided, pairs.guided), error(tile.unguided, pairs.unguided));
    of_light.add(tile.unguided.shown / tile.limit, tile.guided.shown / tile.limit);
  }
  const std::optional<Ratio> errors = of_errors.value(), light = of_light.value();
  if (!errors || !light || unguided.shown > unguided.missing) return errors;
  return light->mean < errors->mean ? light : errors;
}

void NoiseRatio::end_iteration(bool is_guided) {
  if (is_guided) {
    const Light light = unguided_light();
    before_ = std::exchange(value_, ratio(light));
    hidden_light_ = light.missing > 0 ? light.missing / (light.shown + light.missing) : 0;
  }
  double brightness = 0, paths = 0;
  for (Tile& tile : tiles_) {
    tile.brightness += tile.new_brightness;
    tile.paths += tile.new_paths;
    brightness += tile.brightness;
    paths += tile.paths;
    tile.new_brightness = tile.new_paths = 0;
    tile.guided = tile.unguided = {};
  }
  std::fill(pixels_.begin(), pixels_.end(), Pixel{});
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
  const std::size_t tiles = tiles_.size(), pixels = pixels_.size();
  archive(tiles_, pixels_, hidden_light_);
  archive.expect(tiles_.size() == tiles && pixels_.size() == pixels && hidden_light_ >= 0 &&
                     hidden_light_ <= 1,
                 "the measure of guiding");
  for (std::optional<Ratio>* ratio : {&before_, &value_}) {
    bool is_known = ratio->has_value();
    Ratio value = ratio->value_or(Ratio{});
    archive(is_known, value);
    if (archive.loads()) *ratio = is_known ? std::optional(value) : std::nullopt;
  }
}

}  // namespace pharos
