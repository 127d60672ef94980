#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include <pharos/core/archive.h>
#include <pharos/core/atomic_file.h>
#include <pharos/core/checksum.h>
#include <pharos/core/error.h>
#include <pharos/core/version.h>
#include <pharos/rendering/checkpoint.h>

namespace pharos {
namespace {

namespace fs = std::filesystem;

constexpr std::array<char, 8> kMagic{'p', 'h', 'a', 'r', 'o', 's', 'c', 'p'};
constexpr std::uint32_t kForm = 2;
/// More than the config of any scene takes [bytes].
constexpr std::uint64_t kLongestHead = std::uint64_t{1} << 30;

/// The head of a checkpoint file, without the version of Pharos.
struct Head {
  std::string config, build;
  bool finished = false;
  std::uint64_t state_bytes = 0, state_checksum = 0;

  void archive(Archive& archive) { archive(config, build, finished, state_bytes, state_checksum); }
};

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw InputError(fmt::format("the checkpoint '{}' {}", path.string(), what));
}

/// Reads `count` bytes of a file that has so many.
std::string read_bytes(std::ifstream& in, const fs::path& path, std::uint64_t count) {
  std::string bytes(count, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(count));
  if (!in) fail(path, "cannot be read");
  return bytes;
}

/// Reads the first bytes of a file. Returns whether it is a checkpoint.
bool has_magic(std::ifstream& in) {
  std::array<char, kMagic.size()> magic{};
  in.read(magic.data(), magic.size());
  return in && magic == kMagic;
}

/// Reads what comes before the head. Returns the length of the head [bytes].
std::uint64_t read_start(std::ifstream& in, const fs::path& path) {
  if (!has_magic(in)) fail(path, "is no checkpoint of Pharos");
  std::uint32_t form = 0;
  std::uint64_t length = 0;
  try {
    Archive archive(in);
    archive(form, length);
  } catch (const InputError&) {
    fail(path, "is cut off");
  }
  if (form != kForm) {
    fail(path, fmt::format("is of form {}; this Pharos reads form {}", form, kForm));
  }
  return length;
}

Head parse_head(const std::string& bytes, const fs::path& path) {
  std::istringstream in(bytes);
  Archive archive(in);
  std::string saved_by;
  Head head;
  archive(saved_by);
  if (saved_by != version()) {
    fail(path, fmt::format("was written by Pharos {}; this is Pharos {}", saved_by, version()));
  }
  archive(head);
  return head;
}

/// Returns the temporary files of write_atomically() for `path`.
std::vector<fs::path> left_overs(const fs::path& path) {
  std::vector<fs::path> found;
  const std::string begin = path.filename().string() + ".", end = ".tmp";
  std::error_code failed;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  for (const auto& entry : fs::directory_iterator(folder, failed)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(begin) || !name.ends_with(end)) continue;
    const std::string process = name.substr(begin.size(), name.size() - begin.size() - end.size());
    const bool is_number =
        !process.empty() && process.find_first_not_of("0123456789") == process.npos;
    if (is_number) found.push_back(entry.path());
  }
  return found;
}

/// Throws InputError if `path` is a file with content that is no checkpoint.
void check_replaceable(const fs::path& path) {
  std::error_code failed;
  if (!fs::exists(path) || fs::file_size(path, failed) == 0) return;
  std::ifstream in(path, std::ios::binary);
  if (has_magic(in)) return;
  fail(path,
       "exists and is no checkpoint of Pharos, so it is not overwritten: choose another name");
}

/// Returns the lock of a render that writes the checkpoint `path`; none where files cannot be
/// locked.
std::optional<FileLock> locked(const fs::path& path, const CheckpointWriter::Warn& warn) {
  std::optional<FileLock> lock;
  try {
    lock = FileLock::try_lock(path.string() + ".pharos-lock");
  } catch (const RunError& error) {
    warn(fmt::format("another render could write the same checkpoint: {}", error.what()));
    return std::nullopt;
  }
  if (!lock) {
    fail(path, "is being written by another render: choose another name, or wait until it ends");
  }
  return lock;
}

}  // namespace

void write_checkpoint(const SavedRender& checkpoint, const fs::path& path) {
  std::ostringstream head_out;
  Archive archive(head_out);
  std::string saved_by = version();
  Head head{checkpoint.config, checkpoint.build, checkpoint.finished, checkpoint.state.size(),
            checksum(checkpoint.state)};
  archive(saved_by, head);
  const std::string bytes = std::move(head_out).str();
  write_atomically(path, [&](const fs::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    out.write(kMagic.data(), kMagic.size());
    std::uint32_t form = kForm;
    std::uint64_t length = bytes.size(), head_checksum = checksum(bytes);
    Archive start(out);
    start(form, length);
    out << bytes;
    start(head_checksum);
    out << checkpoint.state << std::flush;
    if (!out) {
      throw RunError(fmt::format("cannot write '{}': {}", path.string(), std::strerror(errno)));
    }
  });
}

SavedRender read_checkpoint(const fs::path& path) {
  if (const std::string problem = access_problem(path); !problem.empty()) {
    throw InputError(fmt::format("the checkpoint '{}': {}", path.string(), problem));
  }
  std::ifstream in(path, std::ios::binary);
  const std::uint64_t size = fs::file_size(path), length = read_start(in, path);
  const auto begin = static_cast<std::uint64_t>(in.tellg());
  if (length > kLongestHead) fail(path, "is damaged");
  if (size < begin + length + sizeof(std::uint64_t)) fail(path, "is cut off");
  const std::string bytes = read_bytes(in, path, length);
  std::uint64_t head_checksum = 0;
  Archive archive(in);
  archive(head_checksum);
  if (head_checksum != checksum(bytes)) fail(path, "is damaged");
  const Head head = parse_head(bytes, path);
  const std::uint64_t found = size - begin - length - sizeof head_checksum;
  if (found < head.state_bytes) fail(path, "is cut off");
  if (found > head.state_bytes) fail(path, "goes on after its end");
  SavedRender checkpoint{head.config, head.build, head.finished, read_bytes(in, path, found)};
  if (checksum(checkpoint.state) != head.state_checksum) fail(path, "is damaged");
  return checkpoint;
}

CheckpointWriter::CheckpointWriter(const fs::path& path, SavedRender head, double every, Warn warn)
    : path_(link_target(path)),
      head_(std::move(head)),
      every_(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(every))),
      warn_(std::move(warn)),
      next_(Clock::now() + every_) {
  check_replaceable(path_);
  lock_ = locked(path_, warn_);
  std::error_code failed;
  for (const fs::path& file : left_overs(path_)) fs::remove(file, failed);
}

CheckpointWriter::~CheckpointWriter() {
  finish();
  if (lock_) lock_->remove_file();
}

bool CheckpointWriter::is_due() {
  using std::chrono::seconds;
  const bool is_busy =
      writing_.valid() && writing_.wait_for(seconds(0)) != std::future_status::ready;
  if (!is_busy) finish();
  return Clock::now() >= next_ && !is_busy;
}

void CheckpointWriter::write(std::string state, bool finished) {
  finish();
  next_ = Clock::now() + every_;
  SavedRender checkpoint{head_.config, head_.build, finished, std::move(state)};
  try {
    writing_ = std::async(std::launch::async, [path = path_, checkpoint = std::move(checkpoint)] {
      write_checkpoint(checkpoint, path);
    });
  } catch (const std::exception& error) {  // there is no thread or no memory for it
    skip(error.what());
  }
}

void CheckpointWriter::skip(const std::string& reason) {
  finish();
  next_ = Clock::now() + every_;
  is_written_ = false;
  warn_(fmt::format("no checkpoint: {}", reason));
}

bool CheckpointWriter::finish() {
  if (!writing_.valid()) return is_written_;
  try {
    writing_.get();
    is_written_ = true;
  } catch (const std::exception& error) {
    is_written_ = false;
    warn_(fmt::format("no checkpoint: {}", error.what()));
  }
  return is_written_;
}

}  // namespace pharos
