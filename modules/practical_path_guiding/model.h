#pragma once

#include <span>
#include <vector>

#include <pharos/guiding/contract/model.h>
#include <pharos/guiding/contract/radiance_estimate.h>

#include "cells.h"
#include "quad_density.h"

namespace pharos::practical_path_guiding {

/// Directional densities that depend on position: a directional quadtree in each cell of a binary
/// tree (the SD-tree of Mueller et al. 2017). The regions are the cells. A cell without data has no
/// nodes.
class PracticalPathGuidingModel final : public GuidingModel, public RadianceEstimate {
 public:
  static constexpr std::string_view kName = "practical_path_guiding";

  /// The learned data of a cell.
  struct Cell {
    std::vector<QuadNode> nodes;  ///< quadtree of the density over directions; empty: nothing known
    float light = 0;              ///< mean value of the steps
    float records = 0;            ///< number of records behind the density
    void archive(Archive& archive) { archive(nodes, light, records); }
  };

  PracticalPathGuidingModel() = default;
  /// `learned` is in the order of the numbers of the cells. `of_radiance` states that the densities
  /// are proportional to incident radiance.
  PracticalPathGuidingModel(Cells cells, const std::vector<Cell>& learned, bool of_radiance);

  ModelInfo info() const override;
  void archive(Archive& archive) override;
  Place place(const GuidingVertex& vertex) const override {
    const std::uint32_t cell = cells_.at(vertex.position, vertex.normal);
    return {cell, nodes(cell).empty() ? 0.0f : std::max(known_[cell].records, 1.0f)};
  }
  double density(Point3 point, const Vec3* direction) const override;

  /// The model knows incident radiance only if its densities are proportional to it.
  RadianceTraits radiance_traits() const override {
    return {.incident = of_radiance_, .around = of_radiance_};
  }
  float incident_radiance(Point3 point, Vec3 direction) const override;
  const RadianceAround* radiance_around(const GuidingQuery& query, Arena& arena) const override;

  /// Returns the quadtree of a cell. It is empty if nothing is known there.
  std::span<const QuadNode> nodes(std::uint32_t cell) const {
    const KnownCell& known = known_[cell];
    return {nodes_.data() + known.first, nodes_.data() + known.end};
  }

 private:
  /// The data of a cell. They share a cache line, so that a look-up waits for memory only once.
  struct KnownCell {
    std::uint32_t first = 0, end = 0;  ///< indices of its nodes
    float light = 0, records = 0;
  };
  void add(const Cell& cell);

  Cells cells_;
  std::vector<QuadNode> nodes_;  ///< nodes of all cells, one cell after another
  std::vector<KnownCell> known_{{}};
  bool of_radiance_ = true;
};

}  // namespace pharos::practical_path_guiding
