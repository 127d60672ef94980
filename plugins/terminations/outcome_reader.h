#pragma once

#include <cstdint>
#include <vector>

#include <pharos/core/archive.h>
#include <pharos/guiding/contract/termination.h>
#include <pharos/guiding/record/path_record.h>

namespace pharos {

/// What one step from a vertex has found, or what one light sample at the vertex has found. It is
/// weighted as if it had been the only one. If all lights are sampled together, this counts as one
/// light sample here.
struct Outcome {
  Point3 origin;        ///< of the vertex
  Vec3 towards_viewer;  ///< unit, from the vertex along the path back to the sensor
  /// Estimate of the radiance that leaves the vertex towards the viewer, mean of the channels,
  /// without emission of the vertex itself. Steps and light samples estimate a part of it each.
  float radiance = 0;
  float limited = 0;  ///< the same, at most what the limit on contributions to a pixel allows
  /// Number of steps and light samples: this one, and all that follow a step, in all branches.
  float cost = 0;
  float count = 1;  ///< number of steps or light samples for which it counts, > 0
  bool of_light = false;

  void archive(Archive& archive) {
    archive(origin, towards_viewer, radiance, limited, cost, count, of_light);
    archive.expect(count > 0, "what was learned of steps");
  }
};

/// What a whole path has found.
struct PathOutcome {
  double radiance = 0;  ///< value of the path, mean of the channels
  double cost = 0;      ///< number of its steps and light samples, in all branches
  /// Number of paths of evenly chosen film positions for which it counts. A guide of the camera
  /// chooses some pixels more often than others.
  double paths = 1;
};

/// Reads what steps and light samples have found from recorded paths. It keeps scratch memory from
/// path to path.
///
/// If the number of steps from a vertex was decided before they were drawn, it depends on the path
/// before it alone. Every step then counts once, survivors of roulette and branches too: larger
/// weights of survivors would only add noise. But roulette that is played after the step was drawn
/// lets steps of some kinds survive more often than others, such as those that refract. A survivor
/// then counts for the steps that have not survived, too. Light samples always count once.
class OutcomeReader {
 public:
  /// Reads a path from the sensor. Appends the outcomes of the steps after the first one, and of
  /// the light samples, to `outcomes`. Vertices whose events are all discrete are left out, because
  /// paths are left alone there (TerminationQuery::discrete). `stage` is the stage of the rule by
  /// which the path has ended or split. A limited estimate adds at most `limit` to the mean of the
  /// channels of its pixel.
  PathOutcome read(const PathView& path, TerminationRule::Stage stage, double limit,
                   std::vector<Outcome>& outcomes);

 private:
  /// Reads the light samples at vertex `vertex`. `sample` is the first one in the path; it becomes
  /// the first one of a later vertex.
  void read_lights(const PathView& path, std::uint32_t vertex, double limit, std::size_t& sample,
                   std::vector<Outcome>& outcomes);
  /// Counts what each step leads to, itself included.
  void count_costs(const PathView& path);

  std::vector<Rgb> incident_;
  std::vector<double> found_by_copy_;
  std::vector<float> costs_;
};

}  // namespace pharos
