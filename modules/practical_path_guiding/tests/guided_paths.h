#pragma once

#include <pharos/guiding/record/path_record.h>

namespace pharos::practical_path_guiding {

/// Adds a path with one guidable step to a log. It leaves `from`, of which position, direction and
/// density are set, and ends where this light is emitted.
inline void add_step(PathLog& log, RecordedVertex from, Rgb emission) {
  from.event = Event::smooth_reflect;
  from.guidable = true;
  from.parent = 0;
  from.throughput = Rgb(1);
  from.local_weight = Rgb(0.5f * from.continuation);
  log.begin_path({0.5f, 0.5f}, Transport::radiance);
  log.add(RecordedVertex{.throughput = Rgb(1), .local_weight = Rgb(1)});
  log.add(from);
  log.add(RecordedVertex{
      .position = from.position + from.direction, .parent = 1, .emission = emission});
}

}  // namespace pharos::practical_path_guiding
