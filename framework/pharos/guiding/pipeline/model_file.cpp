#include <array>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include <pharos/core/archive.h>
#include <pharos/core/atomic_file.h>
#include <pharos/core/error.h>
#include <pharos/guiding/pipeline/model_file.h>

namespace pharos {
namespace {

constexpr std::array<char, 8> kMagic{'p', 'h', 'a', 'r', 'o', 's', 'g', 'm'};
constexpr std::uint32_t kForm = 2;
/// Largest length of a name [bytes]. It prevents a damaged length from allocating too much memory.
constexpr std::uint32_t kLongestName = 256;

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
  throw InputError(fmt::format("the model file '{}' {}", path.string(), what));
}

template <class T>
void write_number(std::ostream& out, T number) {
  out.write(reinterpret_cast<const char*>(&number), sizeof number);
}

void write_name(std::ostream& out, std::string_view name) {
  write_number(out, static_cast<std::uint32_t>(name.size()));
  out.write(name.data(), static_cast<std::streamsize>(name.size()));
}

/// Reads a model file from the beginning, one field at a time.
class FileReader {
 public:
  explicit FileReader(const std::filesystem::path& path) : path_(path) {
    if (const std::string problem = file_problem(path); !problem.empty()) {
      throw InputError(fmt::format("the model file '{}': {}", path.string(), problem));
    }
    in_.open(path, std::ios::binary);
    size_ = std::filesystem::file_size(path);
  }

  ModelHeader header() {
    if (size_ < kMagic.size() || number<std::array<char, 8>>() != kMagic) {
      fail(path_, "is no model of Pharos");
    }
    if (const auto form = number<std::uint32_t>(); form != kForm) {
      fail(path_, fmt::format("is of form {}; this Pharos reads form {}", form, kForm));
    }
    ModelHeader header;
    header.learner = name();
    header.model = name();
    header.version = number<std::uint32_t>();
    header.bytes = number<std::uint64_t>();
    check_rest(header.bytes);
    return header;
  }

  /// Returns the `bytes` bytes after the head. check_rest() has checked that they exist.
  std::string rest(std::uint64_t bytes) {
    std::string text(bytes, '\0');
    in_.read(text.data(), static_cast<std::streamsize>(bytes));
    if (!in_) fail(path_, "cannot be read");
    return text;
  }

 private:
  template <class T>
  T number() {
    T value{};
    in_.read(reinterpret_cast<char*>(&value), sizeof value);
    if (!in_) fail(path_, "is cut off in its head");
    return value;
  }

  std::string name() {
    const auto length = number<std::uint32_t>();
    if (length > kLongestName) fail(path_, "has a damaged head");
    std::string text(length, '\0');
    in_.read(text.data(), length);
    if (!in_) fail(path_, "is cut off in its head");
    return text;
  }

  void check_rest(std::uint64_t expected) {
    const std::uint64_t found = size_ - static_cast<std::uint64_t>(in_.tellg());
    if (found < expected) {
      fail(path_, fmt::format("is cut off: it has {} of {} bytes", found, expected));
    }
    if (found > expected) {
      fail(path_, fmt::format("goes on for {} bytes after its model", found - expected));
    }
  }

  std::filesystem::path path_;
  std::ifstream in_;
  std::uint64_t size_ = 0;
};

void check_learner(const std::filesystem::path& path, const ModelHeader& header,
                   const Learner& learner, const ModelInfo& known) {
  if (header.learner != learner.plugin_name()) {
    fail(path, fmt::format("was learned by '{}', which the learner '{}' cannot read",
                           header.learner, learner.plugin_name()));
  }
  if (header.model != known.name) {
    fail(path, fmt::format("holds a model '{}'; the learner '{}' reads models '{}'", header.model,
                           header.learner, known.name));
  }
  if (header.version != known.version) {
    fail(path, fmt::format("holds version {} of the model '{}'; the learner '{}' reads version {}",
                           header.version, header.model, header.learner, known.version));
  }
}

}  // namespace

void write_model_file(const GuidingModel& model, std::string_view learner,
                      const std::filesystem::path& path) {
  std::ostringstream saved;
  save(saved, model);
  const std::string bytes = std::move(saved).str();
  const ModelInfo info = model.info();
  write_atomically(path, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    out.write(kMagic.data(), kMagic.size());
    write_number(out, kForm);
    write_name(out, learner);
    write_name(out, info.name);
    write_number(out, info.version);
    write_number(out, static_cast<std::uint64_t>(bytes.size()));
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.flush();
    if (!out) throw RunError(fmt::format("cannot write '{}'", path.string()));
  });
}

ModelHeader read_model_header(const std::filesystem::path& path) {
  return FileReader(path).header();
}

std::shared_ptr<const GuidingModel> read_model_file(const std::filesystem::path& path,
                                                    const Learner& learner) {
  FileReader file(path);
  const ModelHeader header = file.header();
  std::shared_ptr<GuidingModel> model = learner.empty_model();
  check_learner(path, header, learner, model->info());
  std::istringstream in(file.rest(header.bytes));
  try {
    load(in, *model);
  } catch (const InputError& error) {
    fail(path, fmt::format("cannot be read: {}", error.what()));
  }
  if (in.peek() != std::istringstream::traits_type::eof()) fail(path, "holds more than its model");
  return model;
}

}  // namespace pharos
