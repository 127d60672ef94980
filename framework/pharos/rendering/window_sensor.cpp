#include <pharos/rendering/window_sensor.h>

namespace pharos {
namespace {

class WindowSensor final : public PreparedSensor {
 public:
  WindowSensor(std::unique_ptr<const PreparedSensor> whole, int width, int height,
               const PixelRect& window)
      : whole_(std::move(whole)),
        size_{static_cast<float>(width), static_cast<float>(height)},
        window_(window),
        share_(static_cast<float>(window.area()) / (size_.x * size_.y)) {}

  LensPoint sample_lens(Vec2 u) const override { return whole_->sample_lens(u); }
  Ray ray(const LensPoint& lens, Vec2 film) const override { return whole_->ray(lens, film); }

  std::optional<SensorResponse> response(const LensPoint& lens, Vec3 direction) const override {
    std::optional<SensorResponse> seen = whole_->response(lens, direction);
    if (!seen || !holds({seen->film.x * size_.x, seen->film.y * size_.y})) return std::nullopt;
    seen->direction_pdf /= share_;
    return seen;
  }
  std::optional<SensorConnection> connect(Point3 from, Vec2 u_lens) const override {
    std::optional<SensorConnection> way = whole_->connect(from, u_lens);
    if (!way || !holds({way->film.x * size_.x, way->film.y * size_.y})) return std::nullopt;
    way->pdf /= share_;
    return way;
  }

 private:
  /// Whether the window contains a position in pixels.
  bool holds(Vec2 film) const {
    return film.x >= static_cast<float>(window_.x0) && film.x < static_cast<float>(window_.x1) &&
           film.y >= static_cast<float>(window_.y0) && film.y < static_cast<float>(window_.y1);
  }

  std::unique_ptr<const PreparedSensor> whole_;
  Vec2 size_;  ///< size of the whole film [pixels]
  PixelRect window_;
  float share_;  ///< fraction of the whole film in the window, in (0, 1]
};

}  // namespace

std::unique_ptr<const PreparedSensor> window_sensor(std::unique_ptr<const PreparedSensor> whole,
                                                    int width, int height,
                                                    const PixelRect& window) {
  return std::make_unique<const WindowSensor>(std::move(whole), width, height, window);
}

}  // namespace pharos
