#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/graph/ProgramDesc.h"
#include "renderer/shader/SourceTree.h"

namespace tessera::shader {

using graph::Defines;

/// Line i of file f is numbered f * kLinesAFile + i, since Mesa reports file 0 for errors after parsing (its
/// glsl_parser.yy clears the source of every location it combines), but keeps the line.
inline constexpr std::size_t kLinesAFile = 1'000'000;

/// Defines that are not passed to shaders: the absolute path of the scene's hook (docs/hooks.md) and its parameters,
/// separated by blanks.
inline constexpr std::string_view kHookFile = "HOOK_FILE";
inline constexpr std::string_view kHookParameters = "HOOK_PARAMETERS";
/// The file that declares a hook's inputs and outputs.
inline constexpr std::string_view kHookInterface = "lib/material/hook_interface.glsl";

/// Shader source as the driver gets it. #line directives carry (encoded line, index into files), so that driver
/// messages can be mapped back.
struct ExpandedSource {
    std::string text;
    std::vector<std::string> files; ///< paths below shaders/, the entry first; those of a hook and its block absolute
};

/// Expands the includes of an entry file. #include "path" is relative to shaders/, to the folder that holds shaders/
/// (as in C++, for shared headers) or to the including file. The text begins with #version 450 core and the defines. A
/// file with #pragma once is included once, by its first active #include. Other directives pass through; #includes in
/// the C++ part of a shared header (#ifdef __cplusplus) are dropped. If a source includes kHookInterface and the
/// defines name a hook, the hook's uniform block and text are appended. Throws InputError naming including file, line
/// and remedy for a missing file, a cycle, a malformed #include or another #version.
ExpandedSource expand(const SourceTree& tree, std::string_view entryPath, const Defines& defines = {});

/// Rewrites source positions of a driver's log, "0:12(5): error: x" (Mesa), "0(12) : error C1: x" (NVIDIA) and
/// "ERROR: 0:12: x" (glslang and others), to "shaders/lib/reflectance/brdf.glsl:12: error: x". Line 0 is no position
/// and is dropped. Lines without a known position stay unchanged.
std::string mapLog(std::string_view log, std::span<const std::string> files);

/// Moves the warnings of a mapped log behind all other lines, since compilers warn before they report the error. Both
/// keep their order.
std::string errorsFirst(std::string_view mappedLog);

} // namespace tessera::shader
