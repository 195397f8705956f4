#pragma once
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "validation/bench/BenchResult.h"

/// Conversion of benchmark groups to JSON and back. Points follow the command line's documentation.
namespace tessera::validation {

/// The methods of a key with their settings, one field each; null where a method or setting has no value.
nlohmann::ordered_json choicesJson(const PointKey& key);

/// `pareto`: whether the point is on its group's Pareto front; unset if its error is unknown.
nlohmann::ordered_json pointJson(const BenchGroup& group, const BenchResult& result, std::optional<bool> pareto);
nlohmann::ordered_json lowerBoundJson(const BenchGroup& group);
nlohmann::ordered_json attributionJson(const BenchGroup& group);

/// The complete group, with the file names of its images.
nlohmann::ordered_json groupJson(const BenchGroup& group);
/// Throws nlohmann::json::exception or InputError if groupJson() did not write the JSON.
BenchGroup groupFromJson(const nlohmann::ordered_json& json);

} // namespace tessera::validation
