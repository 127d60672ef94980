#pragma once

#include "gltf_value.h"
#include "node_transform.h"

namespace pharos {

/// The map from a glTF node's space to that of its parent: `matrix`, or else `scale`, then
/// `rotation`, then `translation`. Throws InputError when it is damaged or an extension would place
/// the node more than once.
NodeTransform node_transform(const GltfValue& node);

}  // namespace pharos
