#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <fstream>
#include <sstream>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <pharos/core/error.h>
#include <pharos/experiments/runner/claims.h>

namespace pharos {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using std::chrono::duration;

std::string first_line(const fs::path& file) {
  std::string line;
  std::getline(std::ifstream(file), line);
  return line;
}

std::string host_name() {
  char name[256] = {};
  gethostname(name, sizeof name - 1);
  return name;
}

/// Returns when a process of this machine started; empty: there is no such process.
std::string start_of(std::int64_t process) {
  const std::string line = first_line(fmt::format("/proc/{}/stat", process));
  // The name of the program is in parentheses and may contain blanks. Behind it are the state, and
  // as the 20th word the start.
  const std::size_t name_end = line.rfind(')');
  if (name_end == line.npos) return "";
  std::istringstream words(line.substr(name_end + 1));
  std::string state, word;
  words >> state;
  // A killed process remains until its parent has noticed.
  if (state == "Z" || state == "X") return "";
  for (int i = 1; i < 20; ++i) words >> word;
  return word;
}

std::string own_machine() {
  std::error_code none;
  return fmt::format("{} {} {}", host_name(), first_line("/proc/sys/kernel/random/boot_id"),
                     fs::read_symlink("/proc/self/ns/pid", none).string());
}

json to_json(const Claimant& claimant) {
  return {{"host", claimant.host},
          {"machine", claimant.machine},
          {"process", claimant.process},
          {"started", claimant.started},
          {"since", claimant.since}};
}

/// Returns none if the file is being written, or cannot be read.
std::optional<Claimant> claimant_in(const fs::path& file) {
  std::ifstream in(file);
  try {
    const json node = json::parse(in);
    return Claimant{.host = node.at("host"),
                    .machine = node.at("machine"),
                    .process = node.at("process"),
                    .started = node.at("started"),
                    .since = node.at("since")};
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

/// Returns when a file was touched, by the clock of its file system [s]; none: there is no file.
std::optional<double> touched(const fs::path& file) {
  // Opening a file makes network file systems look at the server's state.
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return std::nullopt;
  struct stat state {};
  fstat(descriptor, &state);
  close(descriptor);
  return static_cast<double>(state.st_mtim.tv_sec) +
         1e-9 * static_cast<double>(state.st_mtim.tv_nsec);
}

/// Returns the number of a file that begins with the name of the work; 0 if it is no claim on it.
std::uint32_t number_of(const fs::path& file, const std::string& name) {
  const std::string digits = file.filename().string().substr(name.size() + 1);
  if (digits.find_first_not_of("0123456789") != digits.npos) return 0;
  return static_cast<std::uint32_t>(std::strtoul(digits.c_str(), nullptr, 10));
}

/// Creates a file with this text. Returns false if it exists.
bool create(const fs::path& file, const std::string& text) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0 && errno == EEXIST) return false;
  const bool is_written = descriptor >= 0 && write(descriptor, text.data(), text.size()) ==
                                                 static_cast<ssize_t>(text.size());
  const int reason = errno;
  if (descriptor >= 0) close(descriptor);
  if (is_written) return true;
  std::error_code ignored;
  if (descriptor >= 0) fs::remove(file, ignored);
  throw RunError(fmt::format("cannot write '{}': {}", file.string(), std::strerror(reason)));
}

}  // namespace

Claimant Claimant::self() {
  return {.host = host_name(),
          .machine = own_machine(),
          .process = getpid(),
          .started = start_of(getpid()),
          .since = static_cast<std::int64_t>(std::time(nullptr))};
}

Claim::Claim(ClaimBoard& board, fs::path file) : board_(&board), file_(std::move(file)) {}

Claim::~Claim() {
  if (board_ != nullptr) board_->release(file_);
}

Claim::Claim(Claim&& other) noexcept
    : board_(std::exchange(other.board_, nullptr)), file_(std::move(other.file_)) {}

Claim& Claim::operator=(Claim&& other) noexcept {
  std::swap(board_, other.board_);
  std::swap(file_, other.file_);
  return *this;
}

ClaimBoard::~ClaimBoard() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  changed_.notify_one();
  if (beat_.joinable()) beat_.join();
}

std::optional<Claim> ClaimBoard::try_claim(const std::string& name) {
  std::error_code failed;
  fs::create_directories(folder_, failed);
  const auto before = files_of(name);
  if (!before.empty() && is_alive(before.rbegin()->second)) return std::nullopt;
  const std::uint32_t number = before.empty() ? 1 : before.rbegin()->first + 1;
  fs::path file = folder_ / fmt::format("{}.{}", name, number);
  if (!create(file, to_json(Claimant::self()).dump() + "\n")) return std::nullopt;
  {
    const std::lock_guard lock(mutex_);
    held_.insert(file);
    if (!beat_.joinable()) beat_ = std::thread([this] { touch_until_end(); });
  }
  Claim claim(*this, std::move(file));
  // If the last claim was given back just now, another process may have taken its number.
  for (const auto& [other, other_file] : files_of(name)) {
    if (other != number && is_alive(other_file)) return std::nullopt;
  }
  return claim;
}

std::optional<Claimant> ClaimBoard::holder(const std::string& name) const {
  const auto files = files_of(name);
  if (files.empty()) return std::nullopt;
  const fs::path& last = files.rbegin()->second;
  std::optional<Claimant> owner = claimant_in(last);
  if (!is_alive(last)) return std::nullopt;
  return owner ? owner : Claimant{.host = "an unknown machine"};
}

std::vector<std::string> ClaimBoard::names(const std::string& start) const {
  std::set<std::string> names;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder_, none)) {
    const std::string name = entry.path().stem().string();
    if (name.starts_with(start)) names.insert(name);
  }
  return {names.begin(), names.end()};
}

std::map<std::uint32_t, fs::path> ClaimBoard::files_of(const std::string& name) const {
  std::map<std::uint32_t, fs::path> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder_, none)) {
    if (!entry.path().filename().string().starts_with(name + ".")) continue;
    if (const std::uint32_t number = number_of(entry.path(), name)) files[number] = entry.path();
  }
  return files;
}

bool ClaimBoard::is_alive(const fs::path& file) const {
  const std::optional<Claimant> claimant = claimant_in(file);
  if (claimant && claimant->machine == own_machine()) {
    return start_of(claimant->process) == claimant->started;
  }
  const std::optional<double> last = touched(file);
  return last && file_system_time() - *last <= duration<double>(times_.patience).count();
}

/// Returns the time on the clock by which files are touched [s since 1970].
double ClaimBoard::file_system_time() const {
  const Claimant self = Claimant::self();
  const fs::path clock = folder_ / fmt::format("clock-{}-{}", self.host, self.process);
  std::ofstream(clock) << "now\n";
  const std::optional<double> now = touched(clock);
  std::error_code ignored;
  fs::remove(clock, ignored);
  // Where nothing can be written, the clock of this machine must do.
  return now.value_or(static_cast<double>(std::time(nullptr)));
}

void ClaimBoard::touch_until_end() {
  std::unique_lock lock(mutex_);
  while (!is_over_) {
    changed_.wait_for(lock, times_.beat);
    // Null: now, by the clock of the file system.
    for (const fs::path& file : held_) utimensat(AT_FDCWD, file.c_str(), nullptr, 0);
  }
}

void ClaimBoard::release(const fs::path& file) {
  const std::lock_guard lock(mutex_);
  held_.erase(file);
  std::error_code ignored;
  // The files of dead owners have smaller numbers. They are removed first, because the work is free
  // as soon as this file is gone. A larger number belongs to a process that took this one for dead.
  const std::string name = file.stem().string();
  for (std::uint32_t number = 1; number < number_of(file, name); ++number) {
    fs::remove(folder_ / fmt::format("{}.{}", name, number), ignored);
  }
  fs::remove(file, ignored);
}

}  // namespace pharos
