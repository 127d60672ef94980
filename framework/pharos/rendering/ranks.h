#pragma once

#include <optional>
#include <string>

namespace pharos {

/// The processes that render one image together, as one of them sees them. Rank 0 leads: it hands
/// out work, learns and writes the image. The other ranks help. Messages between two ranks arrive
/// in the order in which they were sent. Only one thread at a time may use the object.
class Ranks {
 public:
  struct Message {
    int from = 0;  ///< rank of the sender
    std::string bytes;
  };

  virtual ~Ranks() = default;

  /// Returns the rank of this process, from 0 to count() - 1.
  virtual int rank() const = 0;
  virtual int count() const = 0;
  /// Returns how many of these processes share this one's cores, this one included.
  virtual int count_on_cores() const = 0;
  /// Sends a message. It may still be on its way when the function returns.
  virtual void send(int to, std::string bytes) = 0;
  /// Returns the next message that has arrived; none if there is none now. Sending goes on
  /// meanwhile, so the function must be called now and then.
  virtual std::optional<Message> receive() = 0;
  /// Gives every rank the `bytes` of rank 0. All ranks call it; it returns when they are here.
  virtual void broadcast(std::string& bytes) = 0;
};

}  // namespace pharos
