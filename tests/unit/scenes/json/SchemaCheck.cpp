#if defined(__GNUC__) && !defined(__clang__)
// GCC 12 wrongly warns of an overlapping copy in valijson's use of std::string::replace (GCC bug 105651). It warns
// where the code is inlined, so the warning is off for the whole file.
#pragma GCC diagnostic ignored "-Wrestrict"
#endif
#include <memory>

#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "scenes/Schema.h"
#include "tests/unit/scenes/json/SceneFiles.h"

namespace tessera::scenes::test {
namespace {

std::unique_ptr<valijson::Schema> parsedSchema() {
    const nlohmann::json document = nlohmann::json::parse(sceneSchema());
    auto schema = std::make_unique<valijson::Schema>();
    valijson::SchemaParser parser(valijson::SchemaParser::kDraft7);
    parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(document), *schema);
    return schema;
}

} // namespace

bool schemaAccepts(std::string_view document) {
    static const std::unique_ptr<valijson::Schema> schema = parsedSchema();
    const nlohmann::json parsed = nlohmann::json::parse(document);
    valijson::Validator validator;
    return validator.validate(*schema, valijson::adapters::NlohmannJsonAdapter(parsed), nullptr);
}

} // namespace tessera::scenes::test
