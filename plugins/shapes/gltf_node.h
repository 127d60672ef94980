#pragma once

#include "gltf_value.h"
#include "node_transform.h"

namespace pharos {

/// Returns the map from a glTF node's space to its parent's space: `matrix`, or else `scale`, then
/// `rotation`, then `translation`. Throws InputError if the data is damaged or an extension would
/// place the node more than once.
NodeTransform node_transform(const GltfValue& node);

}  // namespace pharos
