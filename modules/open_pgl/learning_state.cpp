#include "learning_state.h"

#include "model.h"

namespace pharos::open_pgl {
namespace {

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
  if (region.empty()) return field;  // the field takes the bounds of its first samples
  // The library knows nothing exactly on the bounds. The margin moves them away from the scene.
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
  if (sample.in_volume) data.flags = openpgl::cpp::SampleData::EInsideVolume;
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
  if (samples_.size() >= settings_.batch_samples) learn();
}

Learned OpenPglLearningState::update(const TrainingStage&) {
  learn();
  if (lessons_ == 0) return {};
  return {std::make_shared<OpenPglModel>(bytes_of(*field_))};
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

void OpenPglLearningState::archive(Archive& archive) {
  archive.heading("open_pgl_learning", 2);
  archive(lessons_, samples_);
  // The library can store only a field that has learned.
  std::string bytes = lessons_ > 0 && !archive.loads() ? bytes_of(*field_) : std::string();
  if (lessons_ > 0) archive_bytes(archive, bytes);
  if (archive.loads()) field_ = lessons_ > 0 ? field_of(bytes) : new_field(settings_, region_);
}

}  // namespace pharos::open_pgl
