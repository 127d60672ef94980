// heightfield: a landscape over the square [-1,1]^2, made of triangles. `resolution` = [nx, ny]
// gives the corners of a regular grid. At each corner local z is `height` times the mean color of
// `texture`, which is evaluated at the texture coordinates of the corner: [0,1]^2 with local x and
// y, as on a quad. The heightfield faces local +z. `smooth` interpolates normals, computed by
// central differences of the heights; otherwise the facets are visible.
//
// A bitmap that repeats (its default) blends the opposite borders of the image at the borders of
// the square. With `wrap: clamp` each border keeps its own values.
//
//     type: heightfield
//     texture: { type: bitmap, file: hills.exr, wrap: clamp }
//     resolution: [513, 513]
//     height: 0.3
//     to_world: { scale: 10 }

#include "heightfield.h"

#include <algorithm>

namespace pharos {
namespace {

/// The heights of the grid in local space.
class Grid {
 public:
  explicit Grid(const Heightfield::Settings& settings)
      : nx_(settings.resolution[0]), ny_(settings.resolution[1]) {
    check_triangle_count(2.0 * (nx_ - 1) * (ny_ - 1), "heightfield");
    heights_.reserve(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_));
    SurfacePoint point;
    point.normal = {0, 0, 1};
    for (int y = 0; y < ny_; ++y) {
      for (int x = 0; x < nx_; ++x) {
        point.uv = uv(x, y);
        point.position = {2 * point.uv.x - 1, 2 * point.uv.y - 1, 0};
        heights_.push_back(settings.height * mean(settings.texture->evaluate(point)));
      }
    }
  }

  TriangleMesh mesh(bool smooth) const {
    TriangleMesh mesh;
    for (int y = 0; y < ny_; ++y) {
      for (int x = 0; x < nx_; ++x) {
        mesh.positions.push_back(position(x, y));
        mesh.uvs.push_back(uv(x, y));
        if (smooth) mesh.normals.push_back(normal(x, y));
        if (x + 1 < nx_ && y + 1 < ny_) add_cell(mesh, static_cast<std::uint32_t>(index(x, y)));
      }
    }
    return mesh;
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(nx_) +
           static_cast<std::size_t>(x);
  }
  Vec2 uv(int x, int y) const {
    return {static_cast<float>(x) / static_cast<float>(nx_ - 1),
            static_cast<float>(y) / static_cast<float>(ny_ - 1)};
  }
  Point3 position(int x, int y) const {
    const Vec2 t = uv(x, y);
    return {2 * t.x - 1, 2 * t.y - 1, heights_[index(x, y)]};
  }
  /// Computes the slopes between the neighbors on both sides; at the border, between one neighbor
  /// and the corner itself.
  Vec3 normal(int x, int y) const {
    const Vec3 along_x = position(std::min(x + 1, nx_ - 1), y) - position(std::max(x - 1, 0), y);
    const Vec3 along_y = position(x, std::min(y + 1, ny_ - 1)) - position(x, std::max(y - 1, 0));
    return cross(along_x, along_y);
  }
  void add_cell(TriangleMesh& mesh, std::uint32_t corner) const {
    const auto row = static_cast<std::uint32_t>(nx_);
    mesh.triangles.push_back({corner, corner + 1, corner + row + 1});
    mesh.triangles.push_back({corner, corner + row + 1, corner + row});
  }

  int nx_, ny_;
  std::vector<float> heights_;
};

}  // namespace

void Heightfield::Settings::describe(Schema<Settings>& s) {
  s.field("texture", &Settings::texture, "Texture whose mean color is the height").required();
  s.field("resolution", &Settings::resolution, "Number of corners along local x and y")
      .at_least(2)
      .check("two numbers", [](const std::vector<int>& v) { return v.size() == 2; });
  s.field("height", &Settings::height, "Factor for the values of the texture").unit("scene units");
  s.field("smooth", &Settings::smooth, "Interpolate normals instead of showing facets");
  s.field("to_world", &Settings::to_world, "Transform from local to world space");
  s.field("flip_normals", &Settings::flip_normals, "Make the heightfield face -z instead of +z");
  s.example("{ texture: { type: bitmap, file: example.png, wrap: clamp }, resolution: [33, 17] }");
  s.example("{ texture: 0.5, height: -2, smooth: false }");
}

Heightfield::Heightfield(const Settings& settings)
    : TriangleShape(transformed(Grid(settings).mesh(settings.smooth), settings.to_world,
                                settings.flip_normals),
                    "heightfield"),
      along_u_(settings.to_world.vector({2, 0, 0})),
      along_v_(settings.to_world.vector({0, 2, 0})),
      upwards_(settings.to_world.vector({0, 0, 1})) {}

UvTangents Heightfield::uv_tangents(const SurfacePoint& point) const {
  const Vec3 n = point.shading.n;
  const float rise = dot(n, upwards_);  // not zero: the surface is never vertical
  return {along_u_ - dot(n, along_u_) / rise * upwards_,
          along_v_ - dot(n, along_v_) / rise * upwards_};
}

}  // namespace pharos
