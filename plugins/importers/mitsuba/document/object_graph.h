#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

#include "document.h"

namespace pharos::mitsuba {

/// The graph of objects, their nested objects and their references, before the references are
/// filled in. If references with cycles were filled in, objects would own themselves.
class ObjectGraph {
 public:
  /// Records that `from` refers to `to`.
  void add(const Object& from, const Object& to, const Location& where);

  /// Throws InputError for cycles, for objects nested more than 64 deep (references included), and
  /// for objects that expand to more than ten million. A shape that is referenced counts once,
  /// because it is a group that instances show.
  void check(const Object& scene);

 private:
  struct Edge {
    const Object* to;
    Location where;
  };
  /// The extent of an object and everything below it.
  struct Extent {
    std::size_t height = 0;  ///< levels; 0 during the visit
    std::size_t objects = 0;
  };

  Extent visit(const Object& object, const Location& where, std::size_t depth);
  Extent extent_below(const Object& object, std::size_t depth);

  std::unordered_map<const Object*, std::vector<Edge>> references_;
  std::unordered_map<const Object*, Extent> extents_;
};

}  // namespace pharos::mitsuba
