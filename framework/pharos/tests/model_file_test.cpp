// Files of learned models: a model is read back as it was written, and all damage is reported.

#include <fstream>
#include <iterator>

#include <doctest/doctest.h>

#include <pharos/config/registry.h>
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

std::string content(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Returns the error message for a file of these bytes.
std::string refusal(const TemporaryFolder& folder, const std::string& bytes,
                    const std::string& learner = "counting") {
  const std::filesystem::path path = folder.write("changed.model", bytes);
  return input_error_in(folder, [&] { read_model_file(path, *learner_from(learner)); });
}

/// Returns the bytes of a file with the model `number` of the learner 'counting'.
std::string sound_file(const TemporaryFolder& folder, std::uint32_t number = 7) {
  write_model_file(NumberModel(number), "counting", folder / "sound.model");
  return content(folder / "sound.model");
}

/// The offsets of the fields after the names [bytes].
constexpr std::size_t kVersionAt = 8 + 4 + (4 + 8) + (4 + 8), kLengthAt = kVersionAt + 4,
                      kModelAt = kLengthAt + 8;

}  // namespace

TEST_CASE("model files: what was written is read") {
  const TemporaryFolder folder;
  sound_file(folder);
  const ModelHeader header = read_model_header(folder / "sound.model");
  CHECK(header.learner == "counting");
  CHECK(header.model == "a_number");
  CHECK(header.version == 3);
  CHECK(header.bytes == 4);
  const auto model = read_model_file(folder / "sound.model", *learner_from("counting"));
  CHECK(model->density(Point3{}) == 7);
  CHECK(content(folder / "sound.model").size() == kModelAt + 4);
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
  CHECK(refusal(folder, sound.substr(0, kModelAt + 1)) ==
        "the model file 'changed.model' is cut off: it has 1 of 4 bytes");
  CHECK(refusal(folder, sound + "more") ==
        "the model file 'changed.model' goes on for 4 bytes after its model");
}

TEST_CASE("model files: damaged heads") {
  const TemporaryFolder folder;
  const auto changed = [&](std::size_t at, char value) {
    std::string bytes = sound_file(folder);
    bytes[at] = value;
    return refusal(folder, bytes);
  };
  CHECK(changed(0, 'P') == "the model file 'changed.model' is no model of Pharos");
  CHECK(changed(8, 1) == "the model file 'changed.model' is of form 1; this Pharos reads form 2");
  CHECK(changed(13, 2) == "the model file 'changed.model' has a damaged head");
  CHECK(changed(kVersionAt, 2) ==
        "the model file 'changed.model' holds version 2 of the model 'a_number'; the learner "
        "'counting' reads version 3");
  CHECK(changed(kLengthAt + 7, 1).find("is cut off: it has 4 of ") != std::string::npos);
  CHECK(refusal(folder, "") == "the model file 'changed.model' is no model of Pharos");
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
  CHECK(refusal(folder, other_kind) ==
        "the model file 'changed.model' holds a model 'b_number'; the learner 'counting' reads "
        "models 'a_number'");
}

TEST_CASE("model files: what the model makes of the rest") {
  const TemporaryFolder folder;
  CHECK(refusal(folder, sound_file(folder, 0)) ==
        "the model file 'changed.model' cannot be read: the number is damaged");
  std::string longer = sound_file(folder) + "more";
  longer[kLengthAt] = 8;
  CHECK(refusal(folder, longer) == "the model file 'changed.model' holds more than its model");
  std::string shorter = sound_file(folder).substr(0, kModelAt + 2);
  shorter[kLengthAt] = 2;
  CHECK(refusal(folder, shorter) ==
        "the model file 'changed.model' cannot be read: what was saved is cut off");
}

TEST_CASE("model files: no files") {
  const TemporaryFolder folder;
  sound_file(folder);
  const auto read = [&](const char* name) {
    return input_error_in(folder, [&] { read_model_header(folder / name); });
  };
  CHECK(read("sund.model") ==
        "the model file 'sund.model': no such file (did you mean 'sound.model'?)");
  CHECK(input_error([&] { read_model_header(folder.path()); }).find("found a folder") !=
        std::string::npos);
  CHECK(input_error([] { read_model_header("/dev/zero"); }).find("pipe or device") !=
        std::string::npos);
  CHECK_THROWS_AS(write_model_file(NumberModel(1), "counting", folder / "none" / "x"), RunError);
}

}  // namespace pharos::test
