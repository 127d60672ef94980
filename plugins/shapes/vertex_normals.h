#pragma once

#include <pharos/scene/shape.h>

namespace pharos {

/// Gives every vertex without a normal (none in the mesh, or zero) one of length 1: the mean of the
/// normals of the triangles that name it, each weighted by its angle there. So it does not depend
/// on how polygons were cut into triangles. Triangles that are thin to within rounding do not
/// count. Where no triangle counts, or those that do cancel out, each triangle gets a vertex of its
/// own with its own normal; a normal stays zero only where the triangle has no area. The same bits
/// for the same mesh.
///
/// Source: Thuermer and Wuethrich, "Computing vertex normals from polygonal facets", Journal of
/// Graphics Tools 3(1), 1998.
void add_vertex_normals(TriangleMesh& mesh);

}  // namespace pharos
