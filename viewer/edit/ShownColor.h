#pragma once
#include <string>

#include <glm/vec3.hpp>

/// Linear colours as displayed in lists and pickers: by sRGB code values, as in the image at exposure 0 without a tone
/// map.
namespace tessera::viewer {

/// The value that a swatch displays as 1: the largest channel if that exceeds 1, else 1.
float swatchScale(const glm::vec3& linear);

/// sRGB code values, 0 to 1, of a linear colour divided by a scale, clamped.
glm::vec3 codeOfColor(const glm::vec3& linear, float scale);
/// The same with its swatchScale(): the colour of its swatch, normalised if brighter than a display.
glm::vec3 swatchOfColor(const glm::vec3& linear);

/// The linear colour of an edited code. A channel whose code is unchanged, or only rounded to a byte, stays
/// bit-identical.
glm::vec3 colorOfCode(const glm::vec3& code, const glm::vec3& codeBefore, const glm::vec3& linearBefore, float scale);

/// "#674848 in sRGB, linear 0.133 0.0648 0.0648"; if brighter than a display "4 x #ffbc89 ...".
std::string colorText(const glm::vec3& linear);

} // namespace tessera::viewer
