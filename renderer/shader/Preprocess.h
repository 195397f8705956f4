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

/// Line i of file f is numbered f * kLinesAFile + i: Mesa keeps a message's line but, past the syntax, says file 0 (its
/// glsl_parser.yy clears the source of every location it combines).
inline constexpr std::size_t kLinesAFile = 1'000'000;

/// Names of defines that no shader is given: the hook of the program's scene (docs/hooks.md), its absolute path and its
/// parameters with blanks between.
inline constexpr std::string_view kHookFile = "HOOK_FILE";
inline constexpr std::string_view kHookParameters = "HOOK_PARAMETERS";
/// The file that declares what a hook is called with.
inline constexpr std::string_view kHookInterface = "lib/material/hook_interface.glsl";

/// A shader as the driver gets it. #line directives carry (numbered line, index into files), so that its messages can
/// be mapped back.
struct ExpandedSource {
    std::string text;
    std::vector<std::string> files; ///< paths below shaders/, the entry first; those of a hook and its block absolute
};

/// Resolves #include "path" (relative to shaders/ or to the folder that holds shaders/, as C++ sees shared headers,
/// else to the including file) from an entry file. The text begins with #version 450 core and the defines. A file with
/// #pragma once counts once, also when the first #include stands in a conditional that turns out false. Other
/// preprocessor lines pass through; #includes in the C++ part of a shared header
/// (#ifdef __cplusplus) do not. Where a source includes kHookInterface and the defines name a hook, the block that it
/// reads and its text stand at the end. Throws InputError naming including file, line and remedy on a missing file, a
/// cycle, a malformed #include or a #version of another version.
ExpandedSource expand(const SourceTree& tree, std::string_view entryPath, const Defines& defines = {});

/// Rewrites the places in a driver's log, "0:12(5): error: x" (Mesa), "0(12) : error C1: x" (NVIDIA), "ERROR: 0:12: x"
/// (glslang and others), to "shaders/lib/reflectance/brdf.glsl:12: error: x". Line 0 is no place and left out. Lines
/// without a known place stay as they are.
std::string mapLog(std::string_view log, std::span<const std::string> files);

/// The lines of a mapped log, warnings behind all others: compilers warn before they find the error. Either keep their
/// order.
std::string errorsFirst(std::string_view mappedLog);

} // namespace tessera::shader
