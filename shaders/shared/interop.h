#pragma once
// Lets one file declare a struct for C++ and GLSL alike. Such structs hold only vec4, uvec4, mat4 and arrays of them,
// whose std140, std430 and C++ layouts are the same; the gpu tests compare the offsets with what the driver reports.
#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>
namespace tessera::shared {
using glm::mat4;
using glm::uvec4;
using glm::vec4;
} // namespace tessera::shared
#define SHARED_BEGIN namespace tessera::shared {
#define SHARED_END }
#define SHARED_CONST inline constexpr int
#else
#define SHARED_BEGIN
#define SHARED_END
#define SHARED_CONST const int
#endif
