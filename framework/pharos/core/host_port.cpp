#include <algorithm>
#include <arpa/inet.h>
#include <charconv>
#include <optional>

#include <fmt/format.h>

#include <pharos/core/host_port.h>

namespace pharos {
namespace {

bool is_name_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
         c == '-' || c == '_';
}

/// Returns whether `host` can be a host name or an IPv4 address. Names have at most 253 letters
/// (RFC 1035).
bool is_name(std::string_view host) {
  return !host.empty() && host.size() <= 253 &&
         std::all_of(host.begin(), host.end(), is_name_letter);
}

/// Returns whether `host` is an IPv6 address. Local addresses may include a zone ("fe80::1%eth0").
bool is_ipv6(std::string_view host) {
  const std::size_t percent = std::min(host.find('%'), host.size());
  const std::string_view zone = host.substr(std::min(percent + 1, host.size()));
  in6_addr ignored{};
  return inet_pton(AF_INET6, std::string(host.substr(0, percent)).c_str(), &ignored) == 1 &&
         (percent == host.size() || is_name(zone));
}

/// Reads the port after a host. The text is empty or consists of a colon and a number. Returns
/// nothing for any other text.
std::optional<std::uint16_t> read_port(std::string_view text, std::uint16_t default_port) {
  if (text.empty()) return default_port;
  std::uint16_t port = 0;
  const char* const end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data() + 1, end, port);
  if (text[0] != ':' || error != std::errc{} || last != end || port == 0) return std::nullopt;
  return port;
}

}  // namespace

std::string HostPort::to_string() const {
  const bool ipv6 = host.find(':') != std::string::npos;
  return fmt::format(fmt::runtime(ipv6 ? "[{}]:{}" : "{}:{}"), host, port);
}

HostPort parse_host_port(std::string_view text, std::uint16_t default_port, const Location& where) {
  const bool bracketed = !text.empty() && text[0] == '[';
  const std::size_t host_end = std::min(text.find(bracketed ? ']' : ':'), text.size());
  const std::string_view host = text.substr(bracketed, host_end - bracketed);
  const std::string_view rest = text.substr(std::min(host_end + bracketed, text.size()));
  const auto port = read_port(rest, default_port);
  // Without a closing bracket, host_end is the end of the text.
  const bool sound = bracketed ? host_end < text.size() && is_ipv6(host) : is_name(host);
  if (!sound || !port) {
    throw InputError(where,
                     fmt::format("expected HOST, HOST:PORT or [IPV6]:PORT with a port from 1 "
                                 "to 65535, found '{}'",
                                 text));
  }
  return {std::string(host), *port};
}

}  // namespace pharos
