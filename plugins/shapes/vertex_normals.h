#pragma once

#include <pharos/scene/shape.h>

namespace pharos {

/// Gives every vertex without a normal (the mesh has none, or it is zero) a unit normal. The normal
/// is the mean of the normals of the triangles at the vertex, weighted by their angles there, so it
/// does not depend on the triangulation of polygons. Triangles whose thickness is within rounding
/// do not count. If no triangle counts, or the sum cancels out, each triangle gets its own vertex
/// with its own normal. A normal remains zero only if the triangle has no area. The result is
/// deterministic: the same mesh gives the same bits.
///
/// Source: Thuermer and Wuethrich, "Computing vertex normals from polygonal facets", Journal of
/// Graphics Tools 3(1), 1998.
void add_vertex_normals(TriangleMesh& mesh);

}  // namespace pharos
