#pragma once

#include <array>
#include <string_view>
#include <utility>

#include <pharos/config/values.h>
#include <pharos/sampling/dimension.h>

namespace pharos {

/// The names that configs and command lines use for the purposes whose numbers are points of the
/// square.
template <>
struct EnumNames<Purpose> {
  static constexpr auto names =
      std::to_array<EnumName<Purpose>>({{"pixel", Purpose::pixel},
                                        {"lens", Purpose::lens},
                                        {"light_position", Purpose::light_position},
                                        {"bsdf_direction", Purpose::bsdf_direction},
                                        {"guide_direction", Purpose::guide_direction}});
};

}  // namespace pharos
