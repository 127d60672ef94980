#pragma once

#include <span>
#include <vector>

#include "../next_group.h"

namespace pharos::vertex_triplets::testing {

/// A component given the prefix. Its weight is its share.
struct NextVertex {
  SpatialGaussian gaussian;
  Event event = Event::none;
  VertexKind kind = VertexKind::surface;
};

/// Returns the components in groups. Neighbors with the same event and kind share a group.
inline std::vector<NextGroup> groups_of(const std::vector<NextVertex>& vertices) {
  std::vector<NextGroup> groups;
  unsigned lane = NextGroup::kLanes;
  for (const NextVertex& v : vertices) {
    const bool fits =
        lane < NextGroup::kLanes && groups.back().event == v.event && groups.back().kind == v.kind;
    if (!fits) {
      NextGroup& group = groups.emplace_back();
      group.clear();
      group.event = v.event;
      group.kind = v.kind;
      lane = 0;
    }
    groups.back().set(lane++, v.gaussian);
  }
  return groups;
}

/// Returns the components of all groups, one by one.
inline std::vector<NextVertex> vertices_of(std::span<const NextGroup> groups) {
  std::vector<NextVertex> vertices;
  for (const NextGroup& group : groups) {
    for (unsigned lane = 0; lane < NextGroup::kLanes; ++lane) {
      if (group.share[lane] > 0) {
        vertices.push_back({group.gaussian(lane), group.event, group.kind});
      }
    }
  }
  return vertices;
}

}  // namespace pharos::vertex_triplets::testing
