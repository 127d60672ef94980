#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace pharos {

/// A process that has claimed work.
struct Claimant {
  std::string host;          ///< name of its machine, for people
  std::string machine;       ///< tells machines and their containers apart
  std::int64_t process = 0;  ///< number on its machine
  std::string started;       ///< when the process started, on a clock of its machine
  std::int64_t since = 0;    ///< when it claimed the work [s since 1970]

  /// Returns this process, now.
  static Claimant self();
};

class ClaimBoard;

/// Work that belongs to this process as long as the object lives.
class Claim {
 public:
  Claim(ClaimBoard& board, std::filesystem::path file);
  /// Gives the work back.
  ~Claim();
  Claim(Claim&& other) noexcept;
  Claim& operator=(Claim&& other) noexcept;

 private:
  ClaimBoard* board_;
  std::filesystem::path file_;
};

/// Divides work among processes that share a folder, perhaps on several machines. A claim is a file
/// that only one process can create. Its owner touches it every `beat`. A claim belongs to a dead
/// process if it was not touched for `patience`, or, on the same machine, if the process does not
/// exist any more. Only file times are compared with each other, so the clocks of the machines need
/// not agree.
///
/// The files are `NAME.1`, `NAME.2`, …: the claim of a dead process stays, and whoever creates the
/// next file has taken over. A process that finds another living claim beside its own withdraws.
class ClaimBoard {
 public:
  struct Times {
    std::chrono::milliseconds beat{10'000}, patience{60'000};
  };

  explicit ClaimBoard(std::filesystem::path folder) : ClaimBoard(std::move(folder), Times{}) {}
  ClaimBoard(std::filesystem::path folder, Times times)
      : folder_(std::move(folder)), times_(times) {}
  ~ClaimBoard();
  ClaimBoard(const ClaimBoard&) = delete;
  ClaimBoard& operator=(const ClaimBoard&) = delete;

  /// Returns the claim on the work `name`, which is a name of a file; none if another process that
  /// is alive has it. The board must outlive the claim. Creates the folder. Throws RunError if the
  /// claim cannot be written.
  std::optional<Claim> try_claim(const std::string& name);
  /// Returns the process that has the work and is alive; none if the work is free.
  std::optional<Claimant> holder(const std::string& name) const;
  /// Returns the names of all work that begin with `start` and that a process has claimed. The
  /// process may be dead.
  std::vector<std::string> names(const std::string& start) const;

 private:
  friend class Claim;
  /// Returns the files of all claims on a work by their numbers.
  std::map<std::uint32_t, std::filesystem::path> files_of(const std::string& name) const;
  bool is_alive(const std::filesystem::path& file) const;
  double file_system_time() const;
  void touch_until_end();
  void release(const std::filesystem::path& file);

  std::filesystem::path folder_;
  Times times_;
  std::mutex mutex_;  ///< guards what follows
  std::condition_variable changed_;
  bool is_over_ = false;
  std::set<std::filesystem::path> held_;
  std::thread beat_;  ///< runs from the first claim on
};

}  // namespace pharos
