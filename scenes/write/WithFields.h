#pragma once
#include "base/Error.h"
#include "scenes/import/JsonReader.h"
#include "scenes/write/JsonFields.h"

namespace tessera::scenes::write {

/// `json` with the "fields" that it takes for `read` to make the same element of it. What the keys cannot hold at all
/// is written as `least`, which `read` accepts, and fields.
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
