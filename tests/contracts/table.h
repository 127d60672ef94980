#pragma once

#include <cstdint>
#include <istream>
#include <ostream>
#include <string>
#include <vector>

#include <pharos/core/error.h>
#include <pharos/guiding/contract/learner.h>

namespace pharos::stubs {

/// A table of numbers and the region it is about.
struct Table {
  std::vector<double> values;
  Bounds3 region;
};

inline void write_table(std::ostream& out, const std::vector<double>& table) {
  const std::uint64_t size = table.size();
  out.write(reinterpret_cast<const char*>(&size), sizeof size);
  out.write(reinterpret_cast<const char*>(table.data()),
            static_cast<std::streamsize>(size * sizeof(double)));
}

/// `expected` numbers, or up to `most_times` that many.
inline std::vector<double> read_table(std::istream& in, std::size_t expected,
                                      std::size_t most_times = 1) {
  std::uint64_t size = 0;
  in.read(reinterpret_cast<char*>(&size), sizeof size);
  const bool fits = size == expected || (expected > 0 && size > 0 && size % expected == 0 &&
                                         size / expected <= most_times);
  if (!in || !fits) throw InputError("the model file holds another kind of model");
  std::vector<double> table(size);
  in.read(reinterpret_cast<char*>(table.data()),
          static_cast<std::streamsize>(size * sizeof(double)));
  if (!in) throw InputError("the model file is cut off");
  return table;
}

/// A model that is one table of numbers over a region.
class TableModel : public GuidingModel {
 public:
  explicit TableModel(Table table) : table_(std::move(table)) {}

  std::uint32_t version() const override { return 1; }
  std::size_t size_bytes() const override { return table_.values.size() * sizeof(double); }
  void save(std::ostream& out) const override {
    out.write(reinterpret_cast<const char*>(&table_.region), sizeof(Bounds3));
    write_table(out, table_.values);
  }
  const std::vector<double>& table() const { return table_.values; }
  const Bounds3& region() const { return table_.region; }

 private:
  Table table_;
};

/// What TableModel::save() wrote, of `expected` numbers or up to `most_times` that many.
inline Table load_table(std::istream& in, std::size_t expected, std::size_t most_times = 1) {
  Table table;
  in.read(reinterpret_cast<char*>(&table.region), sizeof(Bounds3));
  table.values = read_table(in, expected, most_times);
  return table;
}

/// Learning that is a table of sums.
class TableState : public LearningState {
 public:
  explicit TableState(std::size_t size) : sums_(size) {}

  void save(std::ostream& out) const override { write_table(out, sums_); }
  void load(std::istream& in) override { sums_ = read_table(in, sums_.size()); }
  void merge(const LearningState& other) override {
    const auto& theirs = static_cast<const TableState&>(other).sums_;
    for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += theirs[i];
  }

 protected:
  std::vector<double> sums_;
};

/// Calls `use(vertex, weight)` for every guidable step of every path, with the radiance found over
/// the density it was sampled with.
template <class Use>
void for_each_step(const PathLog& log, Use&& use) {
  std::vector<Rgb> incident;
  for (std::size_t p = 0; p < log.size(); ++p) {
    const PathView path = log[p];
    estimate_incident_radiance(path, incident);
    for (std::size_t i = 1; i < path.vertices.size(); ++i) {
      const RecordedVertex& vertex = path.vertices[i];
      if (!vertex.guidable || vertex.pdf() <= 0 || is_discrete(vertex.event)) continue;
      use(path, i, mean(incident[i]) / vertex.pdf());
    }
  }
}

}  // namespace pharos::stubs
