// The schema of cases against the cases that come with the program.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <regex>

#include "solver/case/case_file.hpp"
#include "solver/case/case_keys.hpp"
#include "tests/app/porosph.hpp"

using namespace porosph;
using Json = nlohmann::json;

namespace {

/// The schema of a key, as case_keys() names it; null where there is none.
Json schema_of(Json schema, const std::string& path) {
  std::istringstream parts(path);
  for (std::string part; std::getline(parts, part, '.');) {
    if (schema.contains("items")) schema = Json(schema["items"]);
    if (part == "0") continue;
    if (!schema.contains("properties") || !schema["properties"].contains(part)) return nullptr;
    schema = Json(schema["properties"][part]);
  }
  return schema;
}

}  // namespace

TEST_CASE("the schema explains every key of a case, and no other") {
  const Workplace place;
  const Outcome printed = place.porosph("schema");
  REQUIRE(printed.status == 0);
  const Json schema = Json::parse(printed.out);
  CHECK(schema["$schema"] == "http://json-schema.org/draft-07/schema#");
  CHECK(schema["additionalProperties"] == false);
  for (const CaseKey& key : case_keys()) {
    CAPTURE(key.path);
    const Json own = schema_of(schema, key.path);
    REQUIRE(own.is_object());
    CHECK(own["description"].get<std::string>().size() > 5);
  }
  CHECK(schema_of(schema, "soil.0.youngs_modulus")["exclusiveMinimum"] == 0);
  const std::regex stiffness(schema_of(schema, "soil.0.youngs_modulus")["pattern"].get<std::string>());
  CHECK(std::regex_search("1.5e1 MPa", stiffness));
  CHECK_FALSE(std::regex_search("15 m", stiffness));
  CHECK(schema_of(schema, "water.level_over_time")["items"]["items"].size() == 2);
  CHECK(schema_of(schema, "formulation.motion")["enum"].size() == 4);
  const Json required = schema_of(schema, "soil")["items"]["required"];
  CHECK(std::find(required.begin(), required.end(), "youngs_modulus") != required.end());
}
