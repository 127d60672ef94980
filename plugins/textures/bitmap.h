#pragma once

#include <vector>

#include <pharos/config/schema.h>
#include <pharos/core/color_image.h>
#include <pharos/scene/texture.h>

namespace pharos {

enum class BitmapFilter { bilinear, nearest };
template <>
struct EnumNames<BitmapFilter> {
  static constexpr auto names = std::to_array<EnumName<BitmapFilter>>(
      {{"bilinear", BitmapFilter::bilinear}, {"nearest", BitmapFilter::nearest}});
};

/// How the image continues outside the unit square of texture coordinates.
enum class BitmapWrap { repeat, clamp, mirror };
template <>
struct EnumNames<BitmapWrap> {
  static constexpr auto names =
      std::to_array<EnumName<BitmapWrap>>({{"repeat", BitmapWrap::repeat},
                                           {"clamp", BitmapWrap::clamp},
                                           {"mirror", BitmapWrap::mirror}});
};

template <>
struct EnumNames<ColorSpace> {
  static constexpr auto names = std::to_array<EnumName<ColorSpace>>(
      {{"srgb", ColorSpace::srgb}, {"linear", ColorSpace::linear}});
};

class Bitmap final : public Texture {
 public:
  struct Settings {
    std::filesystem::path file;
    BitmapFilter filter = BitmapFilter::bilinear;
    BitmapWrap wrap = BitmapWrap::repeat;
    ColorSpace color_space = ColorSpace::srgb;
    Vec2 uv_scale{1, 1};
    static void describe(Schema<Settings>& s);
  };
  /// Reads the file. Throws InputError as read_colors() does, and for values that are negative or
  /// not finite.
  explicit Bitmap(const Settings& settings);

  Rgb value_at(const SurfacePoint& point) const override;
  Rgb maximum() const override { return maximum_; }
  Rgb average() const override { return average_; }

 private:
  float wrapped(float coordinate) const;
  int neighbor(int index, int size) const;
  Rgb nearest(float x, float y) const;
  Rgb bilinear(float x, float y) const;

  Settings settings_;
  ColorImage texels_;
  Rgb maximum_;
  Rgb average_;
};

}  // namespace pharos
