#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <pharos/guiding/contract/learner.h>

namespace pharos::stubs {

/// A table of numbers and the region to which it belongs.
struct Table {
  std::vector<double> values;
  Bounds3 region;
};

/// A model that consists of one table of numbers over a region.
class TableModel : public GuidingModel {
 public:
  /// Makes a model that knows nothing.
  TableModel() = default;
  explicit TableModel(Table table) : table_(std::move(table)) {}

  Place place(const GuidingVertex&) const override {
    return {.evidence = region().empty() ? 0.0f : 1.0f};
  }
  const std::vector<double>& table() const { return table_.values; }
  const Bounds3& region() const { return table_.region; }

 protected:
  ModelInfo table_info(std::string_view name) const {
    return {.name = std::string(name), .bytes = table_.values.size() * sizeof(double)};
  }

  /// Saves or loads the table. It must have `expected` numbers, or up to `most_times` as many.
  void archive_table(Archive& archive, std::size_t expected, std::size_t most_times = 1) {
    archive(table_.region, table_.values);
    const std::size_t size = table_.values.size();
    const bool fits = size == expected || (expected > 0 && size > 0 && size % expected == 0 &&
                                           size / expected <= most_times);
    archive.expect(fits && !table_.region.empty(), "the table");
  }

 private:
  Table table_;
};

/// A learning state that consists of a table of sums.
class TableState : public LearningState {
 public:
  explicit TableState(std::size_t size) : sums_(size) {}

  void archive(Archive& archive) override {
    const std::size_t size = sums_.size();
    archive(sums_);
    archive.expect(sums_.size() == size, "the table of sums");
  }

 protected:
  std::vector<double> sums_;
};

/// Calls `use(path, i, weight)` for every guidable step of every path. `weight` is the radiance
/// that the step from vertex i found, divided by the density with which it was sampled.
template <class Use>
void for_each_step(const PathLog& log, Use&& use) {
  std::vector<Rgb> incident;
  for (std::size_t p = 0; p < log.size(); ++p) {
    const PathView path = log[p];
    estimate_incident_radiance(path, incident);
    for (std::size_t i = 1; i < path.vertices.size(); ++i) {
      const RecordedVertex& vertex = path.vertices[i];
      if (!vertex.guidable || vertex.pdf <= 0 || is_discrete(vertex.event)) continue;
      use(path, i, mean(incident[i]) / vertex.pdf);
    }
  }
}

}  // namespace pharos::stubs
