#pragma once
#include "base/Error.h"
#include "scenes/import/JsonReader.h"
#include "scenes/write/JsonFields.h"

namespace tessera::scenes::write {

/// Adds to `json` the "fields" that `read` needs to restore the element. If `read` rejects `json`, `least`, which it
/// accepts, is written with fields instead.
template <typename Element, typename Read>
Json withFields(const Element& element, Json json, const Json& least, Read read) {
    const std::filesystem::path noFile;
    const auto readBack = [&](const Json& written) {
        const nlohmann::json document(written);
        return read(JsonValue(document, noFile));
    };
    Element back;
    try {
        back = readBack(json);
    } catch (const InputError&) {
        json = least;
        back = readBack(json);
    }
    if (Json fields = fieldsThatDiffer(element, back); !fields.is_null()) json["fields"] = std::move(fields);
    return json;
}

} // namespace tessera::scenes::write
