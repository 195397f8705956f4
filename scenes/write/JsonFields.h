#pragma once
#include <nlohmann/json.hpp>

#include "scenes/Scene.h"

/// Values of a scene as JSON that is read back bit for bit.
namespace tessera::scenes::write {

/// Keys in the order in which they were added.
using Json = nlohmann::ordered_json;

/// The number with the fewest digits that is read back as the same float, or double. Infinity becomes null, which
/// "fields" reads back.
Json number(float value);
Json number(double value);

template <glm::length_t Length, typename Number>
Json numbers(const glm::vec<Length, Number>& vector) {
    Json list = Json::array();
    for (glm::length_t i = 0; i < Length; ++i) list.push_back(number(vector[i]));
    return list;
}
Json numbers(const glm::dmat4& matrix); ///< column by column

/// The members in which `wanted` differs from `got`, by the names of Scene.h; null if all are equal.
Json fieldsThatDiffer(const Light& wanted, const Light& got);
Json fieldsThatDiffer(const Camera& wanted, const Camera& got);
Json fieldsThatDiffer(const Material& wanted, const Material& got);

} // namespace tessera::scenes::write
