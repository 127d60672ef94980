#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include <pharos/core/archive.h>
#include <pharos/core/atomic_file.h>
#include <pharos/core/checksum.h>
#include <pharos/core/error.h>
#include <pharos/guiding/pipeline/guiding_settings.h>
#include <pharos/guiding/pipeline/model_file.h>

namespace pharos {
namespace {

constexpr std::array<char, 8> kMagic{'p', 'h', 'a', 'r', 'o', 's', 'g', 'm'};
constexpr std::uint32_t kForm = 5;
constexpr std::uint64_t kChecksumBytes = sizeof(std::uint64_t);

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
  throw InputError(fmt::format("the model file '{}' {}", path.string(), what));
}

/// Reads parts of a model file after its head.
class FileReader {
 public:
  explicit FileReader(const std::filesystem::path& path) : path_(path) {
    if (const std::string problem = file_problem(path); !problem.empty()) {
      throw InputError(fmt::format("the model file '{}': {}", path.string(), problem));
    }
    in_.open(path, std::ios::binary);
    read_head();
    check_size(std::filesystem::file_size(path));
    check_sum();
  }

  const ModelFileHead& head() const { return head_; }

  std::string model(std::size_t index) {
    std::uint64_t skipped = 0;
    for (std::size_t i = 0; i < index; ++i) skipped += head_.models[i].bytes;
    return bytes(data_begin_ + skipped, head_.models[index].bytes);
  }
  std::string mixing() { return bytes(data_begin_ + model_bytes(), head_.mixing_bytes); }

 private:
  void read_head() {
    std::array<char, kMagic.size()> magic{};
    in_.read(magic.data(), magic.size());
    if (!in_ || magic != kMagic) fail(path_, "is no model of Pharos");
    Archive archive(in_);
    std::uint32_t form = 0;
    try {
      archive(form);
      if (form == kForm) archive(head_);
    } catch (const InputError&) {
      if (!in_) fail(path_, "is cut off in its head");
      fail(path_, "has a damaged head");
    }
    if (form != kForm) {
      fail(path_, fmt::format("is of form {}; this Pharos reads form {}", form, kForm));
    }
    data_begin_ = static_cast<std::uint64_t>(in_.tellg());
    const bool is_sound =
        !head_.models.empty() && !head_.methods.empty() &&
        head_.methods.size() <= GuidingSettings::kMostMethods &&
        std::all_of(head_.methods.begin(), head_.methods.end(), [&](const LearnedMethod& method) {
          return method.model < head_.models.size() && method.weight > 0;
        });
    if (!is_sound) fail(path_, "has a damaged head");
  }

  std::uint64_t model_bytes() const {
    std::uint64_t sum = 0;
    for (const ModelHeader& model : head_.models) sum += model.bytes;
    return sum;
  }

  void check_size(std::uint64_t size) const {
    const std::uint64_t found = size - data_begin_;
    std::uint64_t left = found;
    for (const ModelHeader& model : head_.models) {
      if (left < model.bytes) fail_short(found);
      left -= model.bytes;
    }
    if (left < head_.mixing_bytes) fail_short(found);
    left -= head_.mixing_bytes;
    if (left < kChecksumBytes) fail_short(found);
    left -= kChecksumBytes;
    if (left > 0) fail(path_, fmt::format("goes on for {} bytes after its end", left));
  }
  /// check_size() has checked that the bytes exist.
  void check_sum() {
    const std::uint64_t size = data_begin_ + model_bytes() + head_.mixing_bytes;
    const std::string covered = bytes(0, size), saved = bytes(size, kChecksumBytes);
    const std::uint64_t sum = checksum(covered);
    if (std::memcmp(saved.data(), &sum, kChecksumBytes) != 0) fail(path_, "is damaged");
  }
  [[noreturn]] void fail_short(std::uint64_t found) const {
    fail(path_, fmt::format("is cut off: it has {} bytes after its head, too few for what the "
                            "head lists",
                            found));
  }

  /// check_size() has checked that the bytes exist.
  std::string bytes(std::uint64_t begin, std::uint64_t count) {
    std::string text(count, '\0');
    in_.seekg(static_cast<std::streamoff>(begin));
    in_.read(text.data(), static_cast<std::streamsize>(count));
    if (!in_) fail(path_, "cannot be read");
    return text;
  }

  std::filesystem::path path_;
  std::ifstream in_;
  ModelFileHead head_;
  std::uint64_t data_begin_ = 0;
};

/// Returns the number of the model that read_model_file() looks for.
std::size_t find_model(const std::filesystem::path& path, const ModelFileHead& head,
                       const Learner& learner, std::size_t skip) {
  std::vector<std::string> others;
  std::size_t found = 0;
  for (std::size_t i = 0; i < head.models.size(); ++i) {
    const std::string& own = head.models[i].learner;
    if (own == learner.plugin_name() && found++ == skip) return i;
    others.push_back(own);
  }
  if (found > 0) {
    fail(path, fmt::format("has only {} of the learner '{}'",
                           found == 1 ? "one model" : fmt::format("{} models", found),
                           learner.plugin_name()));
  }
  fail(path, fmt::format("was learned by {}, which the learner '{}' cannot read",
                         quoted_list(others), learner.plugin_name()));
}

void check_kind(const std::filesystem::path& path, const ModelHeader& header,
                const ModelInfo& known) {
  if (header.model != known.name) {
    fail(path, fmt::format("holds a model '{}'; the learner '{}' reads models '{}'", header.model,
                           header.learner, known.name));
  }
  if (header.version != known.version) {
    fail(path, fmt::format("holds version {} of the model '{}'; the learner '{}' reads version {}",
                           header.version, header.model, header.learner, known.version));
  }
}

/// Loads an object from `saved`, a part of the file. Throws InputError with the text `surplus` if
/// something is left.
template <class Saved>
void load_all(const std::filesystem::path& path, const std::string& saved, Saved& object,
              const char* surplus) {
  std::istringstream in(saved);
  try {
    load(in, object);
  } catch (const InputError& error) {
    fail(path, fmt::format("cannot be read: {}", error.what()));
  }
  if (in.peek() != std::istringstream::traits_type::eof()) fail(path, surplus);
}

}  // namespace

void write_model_file(const LearnedGuiding& learned, const std::filesystem::path& path) {
  ModelFileHead head{.methods = learned.methods,
                     .mixing = learned.mixing,
                     .mixing_config = learned.mixing_config,
                     .mixing_bytes = learned.mixing_state.size()};
  std::string data;
  for (const LearnedModel& each : learned.models) {
    std::ostringstream saved;
    save(saved, *each.model);
    const std::string bytes = std::move(saved).str();
    const ModelInfo info = each.model->info();
    head.models.push_back({each.learner, info.name, info.version, bytes.size()});
    data += bytes;
  }
  data += learned.mixing_state;
  std::ostringstream out;
  out.write(kMagic.data(), kMagic.size());
  std::uint32_t form = kForm;
  Archive archive(out);
  archive(form, head);
  out << data;
  std::uint64_t sum = checksum(out.view());
  archive(sum);
  write_text_atomically(path, out.view());
}

ModelFileHead read_model_head(const std::filesystem::path& path) {
  return FileReader(path).head();
}

std::shared_ptr<const GuidingModel> read_model_file(const std::filesystem::path& path,
                                                    const Learner& learner, std::size_t skip) {
  FileReader file(path);
  const std::size_t index = find_model(path, file.head(), learner, skip);
  std::shared_ptr<GuidingModel> model = learner.empty_model();
  check_kind(path, file.head().models[index], model->info());
  load_all(path, file.model(index), *model, "holds more than its model");
  return model;
}

std::string read_mixing_state(const std::filesystem::path& path) {
  return FileReader(path).mixing();
}

void load_mixing_state(const std::filesystem::path& path, const std::string& saved,
                       MixingState& state) {
  load_all(path, saved, state, "holds more than its policy has learned");
}

}  // namespace pharos
