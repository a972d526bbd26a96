#include "app/left_out.hpp"

#include <fmt/format.h>

#include <boost/algorithm/string.hpp>

#include "app/command.hpp"
#include "app/numbers.hpp"

namespace porosph::app {

std::vector<LeftOut> read_left_out(const std::vector<std::string>& texts) {
  std::vector<LeftOut> all;
  for (const std::string& text : texts) {
    std::vector<std::string> parts;
    boost::split(parts, text, boost::is_any_of(","));
    if (parts.size() != 3) throw UsageError(fmt::format("--leave-out = {}: must be X,Y,RADIUS", text));
    LeftOut place{{read_number("--leave-out", parts[0]), read_number("--leave-out", parts[1])},
                  read_number("--leave-out", parts[2])};
    if (place.radius <= 0) throw UsageError(fmt::format("--leave-out = {}: the radius must be > 0 m", text));
    all.push_back(place);
  }
  return all;
}

}  // namespace porosph::app
