#pragma once

#include <pharos/guiding/path_record.h>
#include <pharos/sampling/dimension.h>

namespace pharos {

/// What a PathWalk reports to. Nobody listens here: everything compiles to nothing.
struct SilentRecorder {
  static constexpr bool kRecords = false;
  void light_contribution(std::uint16_t, std::uint16_t, Rgb) {}
};

/// Writes a PathLog.
class LogRecorder {
 public:
  static constexpr bool kRecords = true;
  explicit LogRecorder(PathLog& log) : log_(log) {}

  void begin(Vec2 film) {
    log_.begin_path(film, Transport::radiance);
    current_ = kNoVertex;
  }
  void arrive(RecordedVertex vertex) {
    vertex.parent = current_;
    current_ = log_.add(vertex);
  }
  RecordedVertex& current() { return log_.vertex(current_); }
  void light_sample(RecordedLightSample sample) {
    sample.vertex = current_;
    sample.light.parent = current_;
    log_.add(sample);
  }
  void light_contribution(std::uint16_t, std::uint16_t, Rgb) {}

 private:
  PathLog& log_;
  std::uint32_t current_ = kNoVertex;
};

/// Keeps the contribution of one light sample, for the integrand probe.
class LightProbeRecorder {
 public:
  static constexpr bool kRecords = false;
  explicit LightProbeRecorder(Dimension dimension) : dimension_(dimension) {}

  void light_contribution(std::uint16_t bounce, std::uint16_t branch, Rgb value) {
    if (bounce == dimension_.bounce && branch == dimension_.branch) sum_ += value;
  }
  Rgb sum() const { return sum_; }

 private:
  Dimension dimension_;
  Rgb sum_;
};

}  // namespace pharos
