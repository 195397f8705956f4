#pragma once
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <glm/glm.hpp>

#include "scenes/Hook.h"

namespace tessera::app {

/// Adds an option with a numeric value. Parsing is strict: text that is not a number, or a number that is not finite or
/// not whole, throws InputError naming the option and the value.
CLI::Option* addNumber(CLI::App& command, const std::string& flag, std::optional<double>& target,
                       const std::string& help, const std::string& type);
CLI::Option* addWholeNumber(CLI::App& command, const std::string& flag, std::optional<int>& target,
                            const std::string& help, const std::string& type);
/// Adds an option of three comma-separated numbers.
CLI::Option* addPoint(CLI::App& command, const std::string& flag, std::optional<glm::dvec3>& target,
                      const std::string& help, const std::string& type);

/// Adds a repeatable option NAME=NUMBER; values are kept in order.
CLI::Option* addHookValues(CLI::App& command, const std::string& flag, std::vector<scenes::HookValue>& target,
                           const std::string& help, const std::string& type);

} // namespace tessera::app
