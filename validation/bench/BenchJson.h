#pragma once
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "validation/bench/BenchResult.h"

/// Groups as JSON, and back. Points are written as the command line's documentation has them.
namespace tessera::validation {

/// The fields of a key that say how it finds shadows and what happens below surfaces; null where they say nothing.
nlohmann::ordered_json choicesJson(const PointKey& key);

/// `pareto`: whether the point is on its group's front; none where the error is not known.
nlohmann::ordered_json pointJson(const BenchGroup& group, const BenchResult& result, std::optional<bool> pareto);
nlohmann::ordered_json lowerBoundJson(const BenchGroup& group);
nlohmann::ordered_json attributionJson(const BenchGroup& group);

/// The group whole, with the names of its pictures.
nlohmann::ordered_json groupJson(const BenchGroup& group);
/// Throws nlohmann::json::exception or InputError where the JSON is not what groupJson() wrote.
BenchGroup groupFromJson(const nlohmann::ordered_json& json);

} // namespace tessera::validation
