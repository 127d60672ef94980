#include <algorithm>
#include <cmath>
#include <map>

#include <pharos/rendering/film.h>

namespace pharos {
namespace {

/// Channels of Film::layers(): the color first, then each Layer in order.
struct LayerChannels {
  int first;
  std::vector<std::string> names;
};

const std::vector<LayerChannels>& all_channels() {
  static const std::vector<LayerChannels> channels{
      {0, {"R", "G", "B"}},
      {3, {"albedo.R", "albedo.G", "albedo.B"}},
      {6, {"normal.X", "normal.Y", "normal.Z"}},
      {9, {"depth.Z"}},
      {10, {"variance.R", "variance.G", "variance.B"}},
      {13, {"samples.N"}},
      {14, {"splitting.1", "splitting.2"}},
      {16, {"cost.N"}},
  };
  return channels;
}

/// Returns the pixels within `bounds` whose centers are less than `radius` from a film position.
PixelRect footprint(Vec2 film, float radius, const PixelRect& bounds) {
  const auto first = [&](float v) { return static_cast<int>(std::ceil(v - 0.5f - radius)); };
  const auto end = [&](float v) { return static_cast<int>(std::floor(v - 0.5f + radius)) + 1; };
  return {std::max(first(film.x), bounds.x0), std::max(first(film.y), bounds.y0),
          std::min(end(film.x), bounds.x1), std::min(end(film.y), bounds.y1)};
}

Vec2 offset_from_center(Vec2 film, int x, int y) {
  return {film.x - (static_cast<float>(x) + 0.5f), film.y - (static_cast<float>(y) + 0.5f)};
}

/// Returns the integral of a pixel filter over the offsets between `low` and `high`, by the
/// midpoint rule.
double filter_integral(const Filter& filter, Vec2 low, Vec2 high) {
  constexpr int kSteps = 64;
  const Vec2 step = (1.0f / kSteps) * (high - low);
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const auto x = static_cast<float>(i) + 0.5f, y = static_cast<float>(j) + 0.5f;
      sum += filter.evaluate(low + Vec2{step.x * x, step.y * y});
    }
  }
  return sum * step.x * step.y;
}

/// Returns the fraction of a pixel filter's integral that falls on the film. The film extends
/// `margins` whole pixels to the left, right, top and bottom of the pixel. The integral ends
/// exactly at the film's edge: a grid over the whole filter would be off by up to half a step
/// there.
float share_on_film(const Filter& filter, const std::array<int, 4>& margins) {
  const float radius = filter.radius();
  const auto reach = [&](int margin) {
    return std::min(radius, static_cast<float>(margin) + 0.5f);
  };
  const Vec2 low{-reach(margins[0]), -reach(margins[2])},
      high{reach(margins[1]), reach(margins[3])};
  return static_cast<float>(filter_integral(filter, low, high) /
                            filter_integral(filter, {-radius, -radius}, {radius, radius}));
}

/// Returns the index of the pixel that contains a film position, clamped to `bounds`.
std::size_t pixel_index(Vec2 film, const PixelRect& bounds) {
  return bounds.index(std::clamp(static_cast<int>(film.x), bounds.x0, bounds.x1 - 1),
                      std::clamp(static_cast<int>(film.y), bounds.y0, bounds.y1 - 1));
}

PixelRect with_border(PixelRect inner, const PixelRect& film, float radius) {
  const int border = std::max(0, static_cast<int>(std::ceil(radius - 0.5f)));
  return {std::max(inner.x0 - border, film.x0), std::max(inner.y0 - border, film.y0),
          std::min(inner.x1 + border, film.x1), std::min(inner.y1 + border, film.y1)};
}

}  // namespace

Features& Features::operator+=(const Features& other) {
  albedo += other.albedo;
  normal += other.normal;
  depth += other.depth;
  for (std::size_t i = 0; i < splitting.size(); ++i) {
    splitting[i].sum += other.splitting[i].sum;
    splitting[i].vertices += other.splitting[i].vertices;
  }
  cost += other.cost;
  return *this;
}

FilmTile::Pixel& FilmTile::Pixel::operator+=(const Pixel& other) {
  radiance += other.radiance;
  weight += other.weight;
  absolute_weight += other.absolute_weight;
  features += other.features;
  samples += other.samples;
  luminance += other.luminance;
  squared_luminance += other.squared_luminance;
  return *this;
}

Rgb FilmTile::Pixel::weighted_mean(float least_weight) const {
  if (absolute_weight == 0) return {};
  const float least = least_weight * absolute_weight;
  return radiance / std::copysign(std::max(std::abs(weight), least), weight);
}

FilmTile::FilmTile(PixelRect pixels, PixelRect film, const Filter& filter,
                   const PixelShares& shares)
    : inner_(pixels),
      bordered_(with_border(pixels, film, filter.radius())),
      filter_(&filter),
      shares_(&shares),
      pixels_(bordered_.area()) {}

void FilmTile::add_sample(Vec2 film, Rgb radiance, const Features& features) {
  Pixel& own = pixels_[pixel_index(film, bordered_)];
  own.features += features;
  own.samples += 1;
  const float value = pharos::luminance(radiance);
  own.luminance += value;
  own.squared_luminance += value * value;
  add_radiance(film, radiance);
}

void FilmTile::add_radiance(Vec2 film, Rgb radiance) {
  if (filter_->radius() <= 0.5f) {  // the sample reaches its own pixel only
    const int x = static_cast<int>(film.x), y = static_cast<int>(film.y);
    const float weight = filter_->evaluate(offset_from_center(film, x, y));
    pixels_[pixel_index(film, bordered_)].add(weight, radiance);
    return;
  }
  const PixelRect reach = footprint(film, filter_->radius(), bordered_);
  const float to_even =
      1 / shares_->at(std::clamp(static_cast<int>(film.x), inner_.x0, inner_.x1 - 1),
                      std::clamp(static_cast<int>(film.y), inner_.y0, inner_.y1 - 1));
  for (int y = reach.y0; y < reach.y1; ++y) {
    for (int x = reach.x0; x < reach.x1; ++x) {
      const float weight = to_even * filter_->evaluate(offset_from_center(film, x, y));
      pixels_[bordered_.index(x, y)].add(weight, radiance);
    }
  }
}

void FilmTile::archive(Archive& archive) {
  archive.block(pixels_);
  archive.expect(pixels_.size() == bordered_.area(), "a tile of the film");
  archive.block(splats_);
  archive.block(landings_);
  archive(paths_);
}

const PixelShares Film::kEvenShares;

Film::Pixel& Film::Pixel::operator+=(const Pixel& other) {
  sum += other.sum;
  splats += other.splats;
  return *this;
}

Film::Film(PixelRect window, Ref<Filter> filter, float least_weight)
    : pixels_(window),
      filter_(std::move(filter)),
      least_weight_(least_weight),
      total_(pixels_.area()),
      pass_(pixels_.area()),
      moments_(pixels_.area()) {}

void Film::merge(const FilmTile& tile) {
  is_in_pass_ = true;
  const PixelRect& from = tile.bordered_;
  for (int y = from.y0; y < from.y1; ++y) {
    for (int x = from.x0; x < from.x1; ++x) {
      pass_[pixels_.index(x, y)].sum += tile.pixels_[from.index(x, y)];
    }
  }
  if (!tile.splats_.empty() && splat_norms_.empty()) find_splat_norms();
  for (const FilmTile::Splat& splat : tile.splats_) add_splat(splat);
  pass_has_splats_ |= !tile.splats_.empty();
  for (const FilmTile::Landing& landing : tile.landings_) {
    FilmTile::Pixel& pixel = pass_[pixel_index(landing.film, pixels_)].sum;
    pixel.features += landing.features;
    pixel.samples += 1;
  }
  pass_paths_ += tile.paths_;
}

void Film::add_splat(const FilmTile::Splat& splat) {
  const PixelRect reach = footprint(splat.film, filter_->radius(), pixels_);
  for (int y = reach.y0; y < reach.y1; ++y) {
    for (int x = reach.x0; x < reach.x1; ++x) {
      const float weight = filter_->evaluate(offset_from_center(splat.film, x, y));
      const std::size_t i = pixels_.index(x, y);
      pass_[i].splats += (weight * splat_norms_[i]) * splat.contribution;
    }
  }
}

void Film::find_splat_norms() {
  splat_norms_.assign(pixels_.area(), 1 / filter_->integral());
  const int reach = static_cast<int>(std::ceil(filter_->radius() - 0.5f));
  // Pixels share their norm if they have the same distances, capped at the filter's reach, from the
  // four borders.
  std::map<std::array<int, 4>, float> known;
  for (int y = 0; y < height(); ++y) {
    for (int x = 0; x < width(); ++x) {
      const std::array<int, 4> margins{std::min(x, reach), std::min(width() - 1 - x, reach),
                                       std::min(y, reach), std::min(height() - 1 - y, reach)};
      if (*std::min_element(margins.begin(), margins.end()) == reach) continue;
      const auto [entry, is_new] = known.try_emplace(margins, 0.0f);
      if (is_new) {
        entry->second = 1 / (filter_->integral() * share_on_film(*filter_, margins));
      }
      splat_norms_[pixels_.index(pixels_.x0 + x, pixels_.y0 + y)] = entry->second;
    }
  }
}

Rgb Film::value(const Pixel& pixel, double paths) const {
  Rgb sum = pixel.sum.weighted_mean(least_weight_);
  if (paths > 0) sum += static_cast<float>(1 / paths) * pixel.splats;
  return sum;
}

void Film::end_pass(double samples, bool complete) {
  is_in_pass_ = false;
  if (!complete && pass_has_splats_ && complete_passes_ > 0) {
    std::fill(pass_.begin(), pass_.end(), Pixel{});
    pass_paths_ = 0;
    return;
  }
  samples_ += samples;
  if (complete) {
    ++complete_passes_;
    complete_samples_ += samples;
  }
  const auto weight = static_cast<float>(samples);
  const auto share = static_cast<float>(samples / std::max(complete_samples_, 1e-30));
  for (std::size_t i = 0; i < pass_.size(); ++i) {
    // Where a pixel gets few samples, a small pass may have none.
    if (complete && (pass_[i].sum.absolute_weight > 0 || pass_has_splats_)) {
      const Rgb now = value(pass_[i], pass_paths_);
      const Rgb delta = now - moments_[i].mean;
      moments_[i].mean += share * delta;
      moments_[i].squares += weight * delta * (now - moments_[i].mean);
    }
    total_[i] += pass_[i];
    pass_[i] = {};
  }
  total_paths_ += pass_paths_;
  pass_paths_ = 0;
}

void Film::merge(const Film& other) {
  const double together = complete_samples_ + other.complete_samples_;
  const auto share = static_cast<float>(other.complete_samples_ / std::max(together, 1e-30));
  const auto own = static_cast<float>(complete_samples_);
  for (std::size_t i = 0; i < total_.size(); ++i) {
    const Rgb delta = other.moments_[i].mean - moments_[i].mean;
    moments_[i].squares += other.moments_[i].squares + own * share * delta * delta;
    moments_[i].mean += share * delta;
    total_[i] += other.total_[i];
  }
  samples_ += other.samples_;
  complete_samples_ = together;
  complete_passes_ += other.complete_passes_;
  total_paths_ += other.total_paths_;
}

void Film::archive(Archive& archive) {
  archive.heading("film", 3);
  archive.block(total_);
  archive.block(moments_);
  archive(is_in_pass_);
  if (is_in_pass_) archive.block(pass_);
  const std::size_t area = pixels_.area();
  archive.expect(total_.size() == area && moments_.size() == area && pass_.size() == area,
                 "the film");
  bool has_splats = !splat_norms_.empty();
  archive(samples_, total_paths_, pass_paths_, pass_has_splats_, has_splats, complete_samples_,
          complete_passes_);
  if (archive.loads() && has_splats) find_splat_norms();
}

SampleSums Film::sample_sums(int x, int y) const {
  const FilmTile::Pixel& sum = total_[pixels_.index(x, y)].sum;
  return {sum.samples, sum.luminance, sum.squared_luminance};
}

double Film::mean_cost() const {
  double cost = 0, samples = 0;
  for (const Pixel& pixel : total_) {
    cost += pixel.sum.features.cost;
    samples += pixel.sum.samples;
  }
  return samples > 0 ? cost / samples : 0;
}

Image Film::layers() const {
  std::vector<std::string> names;
  for (const LayerChannels& channels : all_channels()) {
    names.insert(names.end(), channels.names.begin(), channels.names.end());
  }
  Image image(width(), height(), std::move(names));
  // Pass values have variance s^2 / samples. Their weighted squares thus estimate (passes - 1) s^2,
  // and the mean of all samples has variance s^2 / (all samples).
  const double freedom = complete_passes_ - 1;
  const auto variance_scale = static_cast<float>(
      freedom > 0 ? 1 / (freedom * samples_) : std::numeric_limits<double>::infinity());
  for (int y = 0; y < height(); ++y) {
    for (int x = 0; x < width(); ++x) {
      const std::size_t i = pixels_.index(pixels_.x0 + x, pixels_.y0 + y);
      const FilmTile::Pixel& sum = total_[i].sum;
      const float per_sample = sum.samples > 0 ? 1 / sum.samples : 0.0f;
      const Vec3 normal = per_sample * sum.features.normal;
      image.set_rgb(x, y, value(total_[i], total_paths_), 0);
      image.set_rgb(x, y, per_sample * sum.features.albedo, 3);
      image.set_rgb(x, y, {normal.x, normal.y, normal.z}, 6);
      image.pixel(x, y)[9] = per_sample * sum.features.depth;
      const Rgb variance = freedom > 0 ? variance_scale * moments_[i].squares : Rgb(kInfinity);
      image.set_rgb(x, y, variance, 10);
      image.pixel(x, y)[13] = sum.samples;
      image.pixel(x, y)[14] = sum.features.splitting[0].mean();
      image.pixel(x, y)[15] = sum.features.splitting[1].mean();
      image.pixel(x, y)[16] = per_sample * sum.features.cost;
    }
  }
  return image;
}

Image select_layers(const Image& all, const std::vector<Layer>& layers) {
  std::vector<int> sources;
  std::vector<std::string> names;
  const auto take = [&](const LayerChannels& channels) {
    for (std::size_t i = 0; i < channels.names.size(); ++i) {
      sources.push_back(channels.first + static_cast<int>(i));
      names.push_back(channels.names[i]);
    }
  };
  take(all_channels().front());
  for (const Layer layer : layers) take(all_channels()[static_cast<std::size_t>(layer) + 1]);
  Image selected(all.width(), all.height(), std::move(names));
  for (int y = 0; y < all.height(); ++y) {
    for (int x = 0; x < all.width(); ++x) {
      for (std::size_t c = 0; c < sources.size(); ++c) {
        selected.pixel(x, y)[c] = all.pixel(x, y)[sources[c]];
      }
    }
  }
  return selected;
}

}  // namespace pharos
