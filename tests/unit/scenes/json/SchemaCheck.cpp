#if defined(__GNUC__) && !defined(__clang__)
// GCC 12 sees an overlapping copy in valijson's use of std::string::replace that cannot happen (GCC bug 105651), and
// reports it where the code is inlined, so the whole file must be told.
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
