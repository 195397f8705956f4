#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace tessera::shader {

/// A shader's path in messages: "shaders/lib/reflectance/brdf.glsl"; a scene's hook keeps its absolute path.
std::string displayPath(std::string_view path);

/// Candidate paths of an #include, in search order: below shaders/, below the folder that holds shaders/, beside the
/// including file. Excludes paths outside of shaders/.
std::vector<std::string> includeCandidates(const std::string& wanted, const std::string& including);

} // namespace tessera::shader
