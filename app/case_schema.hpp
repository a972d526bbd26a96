// The JSON schema of case files, for editors that complete and explain keys.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace porosph::app {

/// Draft 7, from the declarations of the keys.
nlohmann::ordered_json case_schema();

}  // namespace porosph::app
