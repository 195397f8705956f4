#pragma once
#include <string>

#include <glm/vec3.hpp>

/// Linear colours as lists and pickers show them: by sRGB code values, as the picture shows the same colour at exposure
/// 0 without a tone map.
namespace tessera::viewer {

/// The brightness that a swatch shows as 1: the greatest channel of a colour that is brighter than a display, else 1.
float swatchScale(const glm::vec3& linear);

/// sRGB code values, 0 to 1, of a linear colour divided by a scale; what lies outside is clamped.
glm::vec3 codeOfColor(const glm::vec3& linear, float scale);
/// The same by its own swatchScale(): what a swatch shows, of brighter colours without their brightness.
glm::vec3 swatchOfColor(const glm::vec3& linear);

/// The linear colour of a code that was edited. A channel whose code is the same as before, or that rounded to a byte,
/// stays to the last bit.
glm::vec3 colorOfCode(const glm::vec3& code, const glm::vec3& codeBefore, const glm::vec3& linearBefore, float scale);

/// "#674848 in sRGB, linear 0.133 0.0648 0.0648"; brighter ones "4 x #ffbc89 ...".
std::string colorText(const glm::vec3& linear);

} // namespace tessera::viewer
