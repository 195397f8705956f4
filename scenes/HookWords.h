#pragma once
#include <string_view>

/// The GLSL words that a hook may use besides its own declarations.
namespace tessera::scenes {

bool isHookType(std::string_view word);      ///< a type: float, mat3, HookInputs
bool isHookQualifier(std::string_view word); ///< a qualifier of types: const, inout, highp
/// Any of those, another keyword, or a function with the same result for the same arguments everywhere. Excludes
/// functions that read textures, memory or neighbours, and the engine's own names.
bool isHookWord(std::string_view word);

} // namespace tessera::scenes
