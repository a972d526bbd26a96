#include "solver/space/place_text.hpp"

#include <catch2/catch.hpp>

using namespace porosph;

TEST_CASE("places are written to six digits, and to the millimetre at least") {
  CHECK(place_text({0, -2.5}) == "(0, -2.5)");
  CHECK(place_text({40.0 / 3, 1e-3 / 3}) == "(13.3333, 0.000333333)");
  CHECK(place_text({1000013.125, 4512345.25}) == "(1000013.125, 4512345.25)");
  CHECK(place_text({-2000, 99999.9996}) == "(-2000, 100000)");
}
