// The regions that lines enclose.
#pragma once

#include <nlohmann/json.hpp>

namespace porosph::drawn {

/// {"lines": [[[x, y], ...], ...]} becomes {"regions": [[[[x, y], ...], ...], ...], "gaps": [{"at": [x, y],
/// "gap": d}, ...]}: what the lines enclose once they are cut where they cross, each region as its outline
/// and holes, first point repeated; and ends that meet no other line, with the distance to the nearest one
/// (-1: there is none). Ends of lines that were only drawn too far are no gaps. Throws std::runtime_error
/// without GEOS.
nlohmann::ordered_json regions_between(const nlohmann::ordered_json& asked);

}  // namespace porosph::drawn
