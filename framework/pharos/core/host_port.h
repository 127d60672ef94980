#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <pharos/core/error.h>

namespace pharos {

/// The address of a TCP server.
struct HostPort {
  std::string host;  ///< a name, an IPv4 address, or an IPv6 address without brackets
  std::uint16_t port = 0;

  /// Returns "host:port", or "[host]:port" for IPv6.
  std::string to_string() const;
};

/// Parses HOST, HOST:PORT, [IPV6] or [IPV6]:PORT. Ports are 1 to 65535; `default_port` replaces a
/// missing port. The host name is not looked up. Throws InputError at `where` for any other text.
HostPort parse_host_port(std::string_view text, std::uint16_t default_port,
                         const Location& where = {});

}  // namespace pharos
