#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <pharos/core/error.h>

namespace pharos {

/// Where a TCP server listens.
struct HostPort {
  std::string host;  ///< a name, an IPv4 address, or an IPv6 address without brackets
  std::uint16_t port = 0;

  /// "host:port"; "[host]:port" for IPv6.
  std::string to_string() const;
};

/// Reads HOST, HOST:PORT, [IPV6] or [IPV6]:PORT; ports are 1 to 65535. Looks no name up. Throws
/// InputError at `where` for any other text.
HostPort parse_host_port(std::string_view text, std::uint16_t default_port,
                         const Location& where = {});

}  // namespace pharos
