#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace tessera::shader {

/// A shader's path as people and editors read it: "shaders/lib/reflectance/brdf.glsl"; a
/// scene's hook, whose path is absolute, is called by that.
std::string displayPath(std::string_view path);

/// Where an #include may mean, in the order of trying: below shaders/, below the folder that holds shaders/, beside the
/// including file. Paths that leave shaders/ are none of them.
std::vector<std::string> includeCandidates(const std::string& wanted, const std::string& including);

} // namespace tessera::shader
