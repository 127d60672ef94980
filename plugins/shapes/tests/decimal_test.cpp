#include "../decimal.h"

#include <string>
#include <system_error>

#include <doctest/doctest.h>

#include <pharos/core/vec.h>

namespace pharos {
namespace {

double value_of(const std::string& text) {
  double value = -1;
  const auto [rest, error] = read_decimal(text.data(), text.data() + text.size(), value);
  CHECK(error == std::errc{});
  CHECK(rest == text.data() + text.size());
  return value;
}

TEST_CASE("decimal numbers: too small is 0, too large infinite, however they are written") {
  const std::string zeros(400, '0'), digits(400, '9');
  for (const std::string tiny : {"1e-400", "-1E-400", "123.5e-500", "0.001e-999"}) {
    CAPTURE(tiny);
    CHECK(value_of(tiny) == 0);
  }
  CHECK(value_of("0." + zeros + "1") == 0);
  CHECK(value_of("1" + zeros + "e-800") == 0);
  CHECK(value_of("1e-" + digits) == 0);
  CHECK(value_of("0e" + digits) == 0);
  CHECK(value_of("0." + zeros + "1e401") == doctest::Approx(1));
  CHECK(value_of("1e-310") > 0);  // a denormal number
  CHECK(value_of("1e400") == kInfinity);
  CHECK(value_of("-1e+400") == -kInfinity);
  CHECK(value_of("1" + zeros) == kInfinity);
  CHECK(value_of("0." + zeros + "1e+800") == kInfinity);
  CHECK(value_of("1e" + digits) == kInfinity);
  double value = -1;
  const std::string word = "x";
  CHECK(read_decimal(word.data(), word.data() + 1, value).ec == std::errc::invalid_argument);
}

}  // namespace
}  // namespace pharos
