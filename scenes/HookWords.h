#pragma once
#include <string_view>

/// The words of GLSL that a hook may use, beside those that it declares itself.
namespace tessera::scenes {

bool isHookType(std::string_view word);      ///< of a variable: float, mat3, HookInputs
bool isHookQualifier(std::string_view word); ///< what may stand before a type: const, inout, highp
/// Any of those, another keyword, or a function that gives the same result for the same arguments wherever it runs.
/// Nothing that reads textures, memory or neighbours, and no word of the program's own.
bool isHookWord(std::string_view word);

} // namespace tessera::scenes
