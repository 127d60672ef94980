#include <limits>

#include <pharos/core/parallel.h>
#include <pharos/experiments/pictures/share_slices.h>

namespace pharos {
namespace {

/// The number of places of mean_shares() along each axis.
constexpr int kGrid = 24;

struct Shares {
  std::vector<float> values;
  bool is_known = false;  ///< whether any model knows the place
};

Shares find_shares(const LearnedMixing& mixing, Point3 position, const ShownVertex& vertex) {
  GuidingQuery query{.current = {.position = position, .roughness = vertex.roughness},
                     .bounce = vertex.bounce};
  Shares shares{std::vector<float>(1 + mixing.methods.size(), 0.0f)};
  std::vector<Place> places;
  for (const LearnedMixing::Method& method : mixing.methods) {
    Place place = method.model->place(query.current);
    place.region += method.first_region;
    places.push_back(place);
    shares.is_known |= place.evidence > 0;
  }
  shares.values[0] = 1;
  if (shares.is_known) mixing.shares->at({query, places}, shares.values);
  return shares;
}

}  // namespace

std::vector<float> shares_at(const LearnedMixing& mixing, Point3 position,
                             const ShownVertex& vertex) {
  return find_shares(mixing, position, vertex).values;
}

Image share_slices(const LearnedMixing& mixing, const SlicePlane& plane,
                   const std::vector<ShownVertex>& vertices) {
  const int columns = static_cast<int>(mixing.methods.size()) + 1;
  const int rows = static_cast<int>(vertices.size());
  Image image(columns * (plane.width + kPanelGap) - kPanelGap,
              rows * (plane.height + kPanelGap) - kPanelGap, {"Y"});
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      *image.pixel(x, y) = std::numeric_limits<float>::quiet_NaN();
    }
  }
  for (int row = 0; row < rows; ++row) {
    parallel_for(static_cast<std::size_t>(plane.height), [&](std::size_t line) {
      const int y = static_cast<int>(line);
      for (int x = 0; x < plane.width; ++x) {
        const Point3 p =
            plane.at((static_cast<float>(x) + 0.5f) / static_cast<float>(plane.width),
                     (static_cast<float>(y) + 0.5f) / static_cast<float>(plane.height));
        const std::vector<float> shares = shares_at(mixing, p, vertices[row]);
        for (int column = 0; column < columns; ++column) {
          *image.pixel(column * (plane.width + kPanelGap) + x,
                       row * (plane.height + kPanelGap) + y) = shares[column];
        }
      }
    });
  }
  return image;
}

std::vector<float> mean_shares(const LearnedMixing& mixing, const Bounds3& bounds,
                               const ShownVertex& vertex) {
  std::vector<double> sums(1 + mixing.methods.size(), 0.0);
  int known = 0;
  for (int i = 0; i < kGrid * kGrid * kGrid; ++i) {
    const int cell[3] = {i % kGrid, i / kGrid % kGrid, i / (kGrid * kGrid)};
    Point3 p = bounds.low;
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] += bounds.extent()[axis] * (static_cast<float>(cell[axis]) + 0.5f) / kGrid;
    }
    const Shares shares = find_shares(mixing, p, vertex);
    if (!shares.is_known) continue;
    ++known;
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += shares.values[k];
  }
  std::vector<float> means;
  for (const double sum : sums) {
    if (known > 0) means.push_back(static_cast<float>(sum / known));
  }
  return means;
}

}  // namespace pharos
