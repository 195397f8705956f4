#pragma once
// Lets one file declare a struct, or define a function, for C++ and GLSL alike. Such structs hold only vec4, uvec4,
// mat4 and arrays of them, whose std140, std430 and C++ layouts are the same; the gpu tests compare the offsets with
// what the driver reports. Those of storage blocks alone may hold plain numbers and arrays of them. Shared functions
// take and return such values, mat3 and plain numbers.
#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>
namespace tessera::shared {
using glm::abs;
using glm::clamp;
using glm::dot;
using glm::exp2;
using glm::inverse;
using glm::length;
using glm::lessThanEqual;
using glm::log2;
using glm::mat3;
using glm::mat4;
using glm::max;
using glm::min;
using glm::mix;
using glm::pow;
using glm::sqrt;
using glm::uintBitsToFloat;
using glm::uvec2;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;
} // namespace tessera::shared
#define SHARED_BEGIN namespace tessera::shared {
#define SHARED_END }
#define SHARED_CONST inline constexpr int
#if defined(__GNUC__)
#define SHARED_FUNCTION inline __attribute__((always_inline)) // compilers do not see how often they are called
#else
#define SHARED_FUNCTION inline
#endif
#define SHARED_PRECISE // C++ is compiled without contraction
#else
#define SHARED_BEGIN
#define SHARED_END
#define SHARED_CONST const int
#define SHARED_FUNCTION
#define SHARED_PRECISE precise
#endif
