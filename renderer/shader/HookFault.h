#pragma once
#include <string>
#include <string_view>

#include "renderer/shader/ProgramDesc.h"

/// Detects whether a scene's hook (docs/hooks.md) breaks the build of a program, and formats the error for its author.
namespace tessera::shader {

/// The program's hook file; empty: none.
std::string hookFileOf(const ProgramDesc& desc);

/// The same program with an empty hook and without the scene's parameters. If it builds and the program does not, the
/// hook is at fault. Link errors need this test, since they name no file.
ProgramDesc withEmptyHook(const ProgramDesc& desc);

/// Whether a log, mapped by mapLog(), has an error in the program's hook; ignores warnings.
bool namesHook(const ProgramDesc& desc, std::string_view log);

/// The error text for a program's hook, from the driver's mapped log: the hook's file, the errors and a remedy. If the
/// log has no line of the hook, adds that of the first quoted name. Lists all fields if a quoted name is used as a
/// field.
std::string hookFaultText(const SourceTree& tree, const ProgramDesc& desc, std::string_view log);

} // namespace tessera::shader
