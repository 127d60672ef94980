#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <utility>

#include <pharos/core/saved_bytes.h>
#include <pharos/rendering/integrator.h>
#include <pharos/rendering/ranks.h>

/// The messages between the ranks of a render. Each one begins with its kind.
namespace pharos::messages {

enum class Kind : std::uint8_t {
  ready,      ///< to rank 0: the scene is loaded; a Ready follows
  failure,    ///< to rank 0: the rank cannot go on; the reason follows as text
  iteration,  ///< to all: whether it is a training iteration follows, and a broadcast of what all
              ///< units of the iteration share
  unit,       ///< to one: a Unit to render
  result,     ///< to rank 0: the number of a unit and its WorkResult
  end,        ///< to all: there is no more work
  left        ///< to rank 0: the last message of a rank
};

struct Ready {
  std::uint32_t threads = 0;  ///< that render
  std::string render;         ///< key of what the rank renders
  void archive(Archive& archive) { archive(threads, render); }
};

struct Unit {
  std::uint64_t number = 0;  ///< in its pass
  WorkUnit unit;
  bool is_recorded = false;  ///< the result shall have a log
  void archive(Archive& archive) { archive(number, unit, is_recorded); }
};

/// Returns a message with the given parts. Throws std::bad_alloc if there is no memory for it.
template <class... Parts>
std::string write(Kind kind, Parts&&... parts) {
  return saved_bytes([&](Archive& archive) {
    archive(kind);
    (archive(parts), ...);
  });
}

/// Reads a message part by part.
class Reader {
 public:
  explicit Reader(std::string bytes) : in_(std::move(bytes)), archive_(in_) { archive_(kind_); }

  Kind kind() const { return kind_; }
  template <class T>
  T next() {
    T part{};
    archive_(part);
    return part;
  }
  /// Reads into an object that cannot be made from nothing.
  template <class T>
  void read(T& part) {
    archive_(part);
  }

 private:
  std::istringstream in_;
  Archive archive_;
  Kind kind_ = Kind::end;
};

/// The pauses of a thread between two looks for messages. Waiting within MPI would take a whole
/// core, and looking often takes a part of one. The pauses get longer while nothing happens.
class Pauses {
 public:
  void rest() {
    std::this_thread::sleep_for(next_);
    next_ = std::min(2 * next_, kLongest);
  }
  /// Something has happened.
  void wake() { next_ = kShortest; }

 private:
  static constexpr std::chrono::microseconds kShortest{50}, kLongest{2000};
  std::chrono::microseconds next_ = kShortest;
};

/// Waits for the next message. Returns none once `goes_on()` is false.
template <class GoesOn>
std::optional<Ranks::Message> wait_for_message(Ranks& ranks, GoesOn&& goes_on) {
  for (Pauses pauses; goes_on(); pauses.rest()) {
    if (std::optional<Ranks::Message> message = ranks.receive()) return message;
  }
  return std::nullopt;
}

}  // namespace pharos::messages
