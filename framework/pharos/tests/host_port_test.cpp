// Addresses of servers, as people type them.

#include <doctest/doctest.h>

#include <pharos/core/host_port.h>

namespace pharos {
namespace {

std::string read(const std::string& text) {
  return parse_host_port(text, 14158).to_string();
}

TEST_CASE("hosts with and without port") {
  CHECK(read("localhost") == "localhost:14158");
  CHECK(read("localhost:1") == "localhost:1");
  CHECK(read("render-node_2.example.org:65535") == "render-node_2.example.org:65535");
  CHECK(read("127.0.0.1:080") == "127.0.0.1:80");
  CHECK(read("[::1]") == "[::1]:14158");
  CHECK(read("[fe80::12:3%eth0]:7") == "[fe80::12:3%eth0]:7");
  CHECK(parse_host_port("[::1]:9", 1).host == "::1");
  CHECK(parse_host_port("[::1]:9", 1).port == 9);
}

TEST_CASE("texts that are no address are refused") {
  for (
      const char* text :
      {"",           ":",          ":80",       "host:",       "host:0",      "host:65536",
       "host:-1",    "host:+1",    "host: 1",   "host:1 ",     "host:0x10",   "host:99999999999999",
       "host:port",  "host:1:2",   "::1",       "fe80::1:80",  "[::1",        "[::1]80",
       "[::1]:",     "[]",         "[]:80",     "[host]:80",   "[1.2.3.4]",   "[::1%]:80",
       "[::1]:80:1", "http://x:1", "two words", "host/path:1", "h\xc3\xb6st", "["}) {
    CAPTURE(text);
    CHECK_THROWS_AS(read(text), InputError);
  }
  CHECK_THROWS_AS(read(std::string(254, 'x')), InputError);
  CHECK_THROWS_AS(read(std::string("host\0", 5)), InputError);
}

TEST_CASE("a refusal says where and what") {
  CHECK_THROWS_WITH_AS(parse_host_port("a b", 1, {"--option"}),
                       "--option: error: expected HOST, HOST:PORT or [IPV6]:PORT with a port from "
                       "1 to 65535, found 'a b'",
                       InputError);
}

}  // namespace
}  // namespace pharos
