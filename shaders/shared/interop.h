#pragma once
// Macros for structs and functions shared by C++ and GLSL. Shared structs hold only vec4, uvec4, mat4 and arrays of
// them, whose std140, std430 and C++ layouts agree; the gpu tests compare the offsets with those the driver reports.
// Structs used in storage blocks only may also hold scalars and arrays of scalars. Shared functions also take and
// return vectors, mat3 and scalars.
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
#define SHARED_FUNCTION inline __attribute__((always_inline)) // compilers cannot know how often they are called
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
