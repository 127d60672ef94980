#include "learning_state.h"

#include <pharos/core/binary_stream.h>

#include "model.h"

namespace pharos::open_pgl {
namespace {

constexpr const char* kHeading = "open_pgl_learning";
constexpr std::uint32_t kVersion = 1;

PGL_DIRECTIONAL_DISTRIBUTION_TYPE type_of(Directions directions) {
  switch (directions) {
    case Directions::vmm:
      return PGL_DIRECTIONAL_DISTRIBUTION_VMM;
    case Directions::quadtree:
      return PGL_DIRECTIONAL_DISTRIBUTION_QUADTREE;
    default:
      return PGL_DIRECTIONAL_DISTRIBUTION_PARALLAX_AWARE_VMM;
  }
}

std::unique_ptr<openpgl::cpp::Field> new_field(const OpenPglSettings& settings,
                                               const Bounds3& region) {
  openpgl::cpp::FieldConfig config;
  constexpr bool kDeterministic = true;
  config.Init(PGL_SPATIAL_STRUCTURE_KDTREE, type_of(settings.directions), kDeterministic,
              settings.cell_samples);
  config.SetSpatialStructureArgMaxDepth(settings.max_depth);
  config.SetUseKnnLookup(settings.neighbors);
  auto field = std::make_unique<openpgl::cpp::Field>(&device(), config);
  if (region.empty()) return field;  // it takes the bounds of its first samples
  // The library knows nothing on the very bounds.
  const Vec3 margin = Vec3{1, 1, 1} * (1e-3f * region.diagonal());
  field->SetSceneBounds(
      openpgl::cpp::Box3(to_point(region.low - margin), to_point(region.high + margin)));
  return field;
}

void add(const Sample& sample, openpgl::cpp::SampleStorage& storage) {
  const auto direction = openpgl::cpp::CompressDirection(to_vector(sample.direction));
  if (sample.weight == 0) {
    openpgl::cpp::ZeroValueSampleData zero{};
    zero.position = to_point(sample.position);
    zero.direction = direction;
    zero.volume = sample.in_volume;
    storage.AddZeroValueSample(zero);
    return;
  }
  openpgl::cpp::SampleData data{};
  data.position = to_point(sample.position);
  data.direction = direction;
  data.weight = sample.weight;
  data.pdf = sample.pdf;
  data.distance = sample.distance;
  data.flags = sample.in_volume ? openpgl::cpp::SampleData::EInsideVolume : 0u;
  storage.AddSample(data);
}

}  // namespace

OpenPglLearningState::OpenPglLearningState(const OpenPglSettings& settings, const Bounds3& region)
    : settings_(settings), region_(region), field_(new_field(settings, region)) {
  rule_ = {.least_pdf = settings.least_pdf, .glossy = settings.glossy};
  if (region.diagonal() > 0) rule_.most_distance = 1e3f * region.diagonal();
}

void OpenPglLearningState::absorb(const PathLog& log) {
  for (std::size_t i = 0; i < log.size(); ++i) extract_samples(log[i], rule_, scratch_, samples_);
  if (samples_.size() >= settings_.batch_samples) {
    learn();
    learned_early_ = true;
  }
}

std::shared_ptr<const GuidingModel> OpenPglLearningState::update(std::uint32_t, bool) {
  learn();
  learned_early_ = false;
  return lessons_ == 0 ? nullptr : std::make_shared<OpenPglModel>(bytes_of(*field_));
}

void OpenPglLearningState::learn() {
  if (samples_.empty()) return;
  openpgl::cpp::SampleStorage storage;
  storage.Reserve(samples_.size(), samples_.size());
  for (const Sample& sample : samples_) add(sample, storage);
  samples_.clear();
  field_->Update(storage);
  ++lessons_;
}

void OpenPglLearningState::save(std::ostream& out) const {
  save_heading(out, kHeading, kVersion);
  save_number(out, lessons_);
  save_number(out, static_cast<std::uint8_t>(learned_early_));
  // The library stores only fields that have learned.
  if (lessons_ > 0) save_bytes(bytes_of(*field_), out);
  save_number(out, static_cast<std::uint64_t>(samples_.size()));
  for (const Sample& sample : samples_) save_sample(sample, out);
}

void OpenPglLearningState::load(std::istream& in) {
  expect_heading(in, kHeading, kVersion);
  const auto lessons = load_number<std::uint64_t>(in);
  const bool learned_early = load_number<std::uint8_t>(in) != 0;
  auto field = lessons > 0 ? field_of(load_bytes(in)) : new_field(settings_, region_);
  std::vector<Sample> samples;
  for (auto count = load_number<std::uint64_t>(in); count > 0; --count) {
    samples.push_back(load_sample(in));
  }
  lessons_ = lessons;
  learned_early_ = learned_early;
  field_ = std::move(field);
  samples_ = std::move(samples);
}

void OpenPglLearningState::merge(const LearningState& other) {
  const auto& theirs = dynamic_cast<const OpenPglLearningState&>(other);
  if (theirs.lessons_ != lessons_ || learned_early_ || theirs.learned_early_) {
    throw InputError(
        "learning of Open PGL in another iteration, or after more than `batch_samples`, cannot be "
        "merged");
  }
  samples_.insert(samples_.end(), theirs.samples_.begin(), theirs.samples_.end());
}

}  // namespace pharos::open_pgl
