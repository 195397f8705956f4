#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace tessera::app {

/// Whether a name given for a file stands for the standard output: "-". What else a command prints is then left out.
bool isStandardOutput(const std::string& path);

/// Throws std::runtime_error where no file of that name can be written: before work that would be in vain.
void requireOutput(const std::string& path);

/// Throws InputError where an output is one of the inputs, or two outputs are one file; links are followed. Empty names
/// and "-" are none.
void requireNotRead(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs);

/// Writes the text to the standard output, or as a whole file or not at all. Throws std::runtime_error.
void writeOutput(const std::string& path, std::string_view text);

} // namespace tessera::app
