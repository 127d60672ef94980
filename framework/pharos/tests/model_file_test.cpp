// Files of learned models: a model is read back as it was written, and all damage is reported.

#include <cstring>

#include <doctest/doctest.h>

#include <pharos/config/registry.h>
#include <pharos/core/checksum.h>
#include <pharos/guiding/pipeline/model_file.h>

#include "fixtures.h"

namespace pharos::test {
namespace {

/// A model that is one number, which is not 0.
class NumberModel final : public GuidingModel {
 public:
  explicit NumberModel(std::uint32_t number, std::uint32_t version = 3)
      : number_(number), version_(version) {}

  ModelInfo info() const override {
    return {.name = "a_number", .version = version_, .bytes = sizeof number_};
  }
  void archive(Archive& archive) override {
    archive(number_);
    archive.expect(number_ != 0, "the number");
  }
  double density(Point3, const Vec3*) const override { return number_; }

 private:
  std::uint32_t number_, version_;
};

/// Reads such models.
class NumberLearner final : public Learner {
 public:
  struct Settings {
    std::uint32_t version = 3;
    static void describe(Schema<Settings>& s) {
      s.field("version", &Settings::version, "That it reads");
    }
  };
  explicit NumberLearner(const Settings& settings) : settings_(settings) {}

  LearnerTraits traits() const override { return {}; }
  std::unique_ptr<LearningState> begin(const LearningContext&) const override { return nullptr; }
  std::shared_ptr<GuidingModel> empty_model() const override {
    return std::make_shared<NumberModel>(0, settings_.version);
  }

 private:
  Settings settings_;
};

Ref<Learner> learner_from(const std::string& yaml) {
  Registry registry;
  registry.add<NumberLearner>("counting", "Counts");
  registry.add<NumberLearner>("guessing", "Guesses");
  BuildContext context{registry};
  ConfigNode resolved;
  return registry.build<Learner>(parse_yaml(yaml, "test"), context, resolved);
}

/// Returns the error message for a file of these bytes.
std::string refusal(const TemporaryFolder& folder, const std::string& bytes,
                    const std::string& learner = "counting") {
  const std::filesystem::path path = folder.write("changed.model", bytes);
  return input_error_in(folder, [&] { read_model_file(path, *learner_from(learner)); });
}

/// Returns the bytes of a file with the model `number` of the learner 'counting' and a mixing
/// policy that has learned "even".
std::string sound_file(const TemporaryFolder& folder, std::uint32_t number = 7) {
  write_model_file({.models = {{"counting", std::make_shared<NumberModel>(number)}},
                    .methods = {{0, 1}},
                    .mixing = "fair",
                    .mixing_config = "fair: 1",
                    .mixing_state = "even"},
                   folder / "sound.model");
  return bytes_of(folder / "sound.model");
}

/// Returns a changed file with a checksum that fits.
std::string sealed(std::string bytes) {
  const std::size_t size = bytes.size() - sizeof(std::uint64_t);
  const std::uint64_t sum = checksum(std::string_view(bytes).substr(0, size));
  std::memcpy(bytes.data() + size, &sum, sizeof sum);
  return bytes;
}

/// The offsets of some fields [bytes].
constexpr std::size_t kVersionAt = 8 + 4 + 8 + (8 + 8) + (8 + 8), kLengthAt = kVersionAt + 4,
                      kMethodsAt = kLengthAt + 8, kMixingAt = kMethodsAt + 8 + 4 + 4,
                      kMixingLengthAt = kMixingAt + (8 + 4) + (8 + 7),
                      kModelAt = kMixingLengthAt + 8;

}  // namespace

TEST_CASE("model files: what was written is read") {
  const TemporaryFolder folder;
  CHECK(sound_file(folder).size() == kModelAt + 4 + 4 + 8);
  const ModelFileHead head = read_model_head(folder / "sound.model");
  REQUIRE(head.models.size() == 1);
  CHECK(head.models[0].learner == "counting");
  CHECK(head.models[0].model == "a_number");
  CHECK(head.models[0].version == 3);
  CHECK(head.models[0].bytes == 4);
  CHECK(head.methods.size() == 1);
  CHECK(head.mixing == "fair");
  CHECK(head.mixing_config == "fair: 1");
  CHECK(read_mixing_state(folder / "sound.model") == "even");
  const auto model = read_model_file(folder / "sound.model", *learner_from("counting"));
  CHECK(model->density(Point3{}) == 7);
}

TEST_CASE("model files: several models, chosen by their learner and their order") {
  const TemporaryFolder folder;
  const auto number = [](std::uint32_t n) { return std::make_shared<NumberModel>(n); };
  write_model_file(
      {.models = {{"counting", number(1)}, {"guessing", number(2)}, {"counting", number(3)}},
       .methods = {{0, 1}, {2, 0.5f}, {1, 2}}},
      folder / "three.model");
  const auto read = [&](const char* learner, std::size_t skip) {
    return read_model_file(folder / "three.model", *learner_from(learner), skip)->density(Point3{});
  };
  CHECK(read("counting", 0) == 1);
  CHECK(read("guessing", 0) == 2);
  CHECK(read("counting", 1) == 3);
  CHECK_THROWS_WITH_AS(read("counting", 2),
                       doctest::Contains("has only 2 models of the learner 'counting'"),
                       InputError);
  CHECK_THROWS_WITH_AS(read("guessing", 1),
                       doctest::Contains("has only one model of the learner 'guessing'"),
                       InputError);
  CHECK(read_model_head(folder / "three.model").methods[1].model == 2);
  CHECK(read_mixing_state(folder / "three.model").empty());
}

TEST_CASE("model files: cut off anywhere, or too long") {
  const TemporaryFolder folder;
  const std::string sound = sound_file(folder);
  REQUIRE(refusal(folder, sound) == "no error");
  for (std::size_t length = 0; length < sound.size(); ++length) {
    const std::string message = refusal(folder, sound.substr(0, length));
    CAPTURE(message);
    CHECK(message.find("the model file 'changed.model' is ") == 0);
    CHECK((message.find("is cut off") != std::string::npos) == (length >= 8));
  }
  CHECK(
      refusal(folder, sound.substr(0, kModelAt + 1)) ==
      "the model file 'changed.model' is cut off: it has 1 bytes after its head, too few for what "
      "the head lists");
  CHECK(refusal(folder, sound + "more") ==
        "the model file 'changed.model' goes on for 4 bytes after its end");
}

TEST_CASE("model files: damaged heads") {
  const TemporaryFolder folder;
  const auto changed = [&](std::size_t at, char value) {
    std::string bytes = sound_file(folder);
    bytes[at] = value;
    return refusal(folder, sealed(bytes));
  };
  CHECK(changed(0, 'P') == "the model file 'changed.model' is no model of Pharos");
  CHECK(changed(8, 3) == "the model file 'changed.model' is of form 3; this Pharos reads form 5");
  CHECK(changed(8 + 4 + 8 + 3, 2) == "the model file 'changed.model' is cut off in its head");
  CHECK(changed(kVersionAt, 2) ==
        "the model file 'changed.model' holds version 2 of the model 'a_number'; the learner "
        "'counting' reads version 3");
  for (const std::size_t length : {kLengthAt, kMixingLengthAt}) {
    CHECK(changed(length + 7, 1).find("is cut off: it has 16 bytes") != std::string::npos);
    CHECK(changed(length + 7, '\xff').find("is cut off: it has 16 bytes") != std::string::npos);
  }
  CHECK(changed(kMethodsAt + 8, 1) == "the model file 'changed.model' has a damaged head");
  CHECK(refusal(folder, "") == "the model file 'changed.model' is no model of Pharos");
  // No render has so many methods, and policies make room for no more.
  write_model_file({.models = {{"counting", std::make_shared<NumberModel>(7)}},
                    .methods = std::vector<LearnedMethod>(9)},
                   folder / "many.model");
  CHECK(refusal(folder, bytes_of(folder / "many.model")) ==
        "the model file 'changed.model' has a damaged head");
}

TEST_CASE("model files: every flipped bit is refused") {
  const TemporaryFolder folder;
  const std::string sound = sound_file(folder);
  for (std::size_t i = 0; i < sound.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = sound;
      damaged[i] = static_cast<char>(damaged[i] ^ (1 << bit));
      CHECK(refusal(folder, damaged) != "no error");
    }
  }
}

TEST_CASE("model files: of another learner, of another kind or of another version") {
  const TemporaryFolder folder;
  CHECK(refusal(folder, sound_file(folder), "guessing") ==
        "the model file 'changed.model' was learned by 'counting', which the learner 'guessing' "
        "cannot read");
  CHECK(refusal(folder, sound_file(folder), "{ type: counting, version: 4 }")
            .find("reads version 4") != std::string::npos);
  std::string other_kind = sound_file(folder);
  other_kind[kVersionAt - 8] = 'b';
  CHECK(refusal(folder, sealed(other_kind)) ==
        "the model file 'changed.model' holds a model 'b_number'; the learner 'counting' reads "
        "models 'a_number'");
}

TEST_CASE("model files: what the model makes of the rest") {
  const TemporaryFolder folder;
  CHECK(refusal(folder, sound_file(folder, 0)) ==
        "the model file 'changed.model' cannot be read: the number is damaged");
  // The length of the model takes from or gives to what the policy has learned.
  std::string longer = sound_file(folder), shorter = longer;
  longer[kLengthAt] = 8;
  longer[kMixingLengthAt] = 0;
  CHECK(refusal(folder, sealed(longer)) ==
        "the model file 'changed.model' holds more than its model");
  shorter[kLengthAt] = 2;
  shorter[kMixingLengthAt] = 6;
  CHECK(refusal(folder, sealed(shorter)) ==
        "the model file 'changed.model' cannot be read: what was saved is cut off");
}

TEST_CASE("model files: no files") {
  const TemporaryFolder folder;
  sound_file(folder);
  const auto read = [&](const char* name) {
    return input_error_in(folder, [&] { read_model_head(folder / name); });
  };
  CHECK(read("sund.model") ==
        "the model file 'sund.model': no such file (did you mean 'sound.model'?)");
  CHECK(input_error([&] { read_model_head(folder.path()); }).find("found a folder") !=
        std::string::npos);
  CHECK(input_error([] { read_model_head("/dev/zero"); }).find("pipe or device") !=
        std::string::npos);
  CHECK_THROWS_AS(write_model_file({}, folder / "none" / "x"), RunError);
}

}  // namespace pharos::test
