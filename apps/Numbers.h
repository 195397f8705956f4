#pragma once
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <glm/glm.hpp>

#include "scenes/Hook.h"

namespace tessera::app {

/// Options that take a number. Their value is read strictly: a text that is no number, or a number that is not finite
/// or not whole, throws an InputError that names the option and the value.
CLI::Option* addNumber(CLI::App& command, const std::string& flag, std::optional<double>& target,
                       const std::string& help, const std::string& type);
CLI::Option* addWholeNumber(CLI::App& command, const std::string& flag, std::optional<int>& target,
                            const std::string& help, const std::string& type);
/// Three numbers and commas between them.
CLI::Option* addPoint(CLI::App& command, const std::string& flag, std::optional<glm::dvec3>& target,
                      const std::string& help, const std::string& type);

/// A name, = and a number, any number of times: all are kept, in order.
CLI::Option* addHookValues(CLI::App& command, const std::string& flag, std::vector<scenes::HookValue>& target,
                           const std::string& help, const std::string& type);

} // namespace tessera::app
