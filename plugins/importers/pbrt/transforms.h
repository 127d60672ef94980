#pragma once

#include <map>
#include <string>

#include <pharos/core/transform.h>

#include "statements.h"

namespace pharos::pbrt {

/// Whether a directive changes the current transformation matrix.
bool is_transform(const Statement& statement);

/// Returns the matrix after a directive. `spaces` are the matrices by CoordinateSystem. Throws
/// InputError, located at the directive, for matrices without an inverse or with a projection, and
/// for unknown coordinate systems.
Transform transformed(const Transform& now, const Statement& statement,
                      const std::map<std::string, Transform>& spaces);

Transform inverse(const Transform& map);

}  // namespace pharos::pbrt
