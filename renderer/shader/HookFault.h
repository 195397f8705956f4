#pragma once
#include <string>
#include <string_view>

#include "renderer/shader/ProgramDesc.h"

/// Whether the hook of a scene (docs/hooks.md) is why a program cannot be built, and what its author is told.
namespace tessera::shader {

/// The file of the hook that a program is made with; empty: it has none.
std::string hookFileOf(const ProgramDesc& desc);

/// The same program with a hook that changes nothing and without its scene's parameters. A driver that takes it and
/// refuses the program finds fault with the hook: what is found where programs are linked has no file.
ProgramDesc withEmptyHook(const ProgramDesc& desc);

/// Whether an error of a log, mapped by mapLog(), stands in the hook of the program; warnings are none.
bool namesHook(const ProgramDesc& desc, std::string_view log);

/// What is wrong with the hook of a program, as a driver's mapped log says: the hook's file, the line of what the log
/// names in quotes where the log itself tells none, the errors, and what to write instead. Where it names what stands
/// behind a dot, the fields that there are.
std::string hookFaultText(const SourceTree& tree, const ProgramDesc& desc, std::string_view log);

} // namespace tessera::shader
