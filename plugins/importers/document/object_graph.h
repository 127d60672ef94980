#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

#include "document.h"

namespace pharos::mitsuba {

/// Objects, what is nested in them and what they refer to, before the references are filled in:
/// with cycles filled in, objects would own themselves.
class ObjectGraph {
 public:
  /// `from` refers to `to`.
  void add(const Object& from, const Object& to, const Location& where);

  /// Throws InputError for cycles, for objects nested more than 64 deep with references counted,
  /// and for objects that stand for more than ten million. A shape that is referred to counts once:
  /// it is a group that instances show.
  void check(const Object& scene);

 private:
  struct Edge {
    const Object* to;
    Location where;
  };
  /// Of an object with all below it.
  struct Extent {
    std::size_t height = 0;  ///< levels; 0 while it is being looked at
    std::size_t objects = 0;
  };

  Extent visit(const Object& object, const Location& where, std::size_t depth);
  Extent extent_below(const Object& object, std::size_t depth);

  std::unordered_map<const Object*, std::vector<Edge>> references_;
  std::unordered_map<const Object*, Extent> extents_;
};

}  // namespace pharos::mitsuba
