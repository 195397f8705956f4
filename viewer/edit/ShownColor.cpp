#include "viewer/edit/ShownColor.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/Srgb.h"

namespace tessera::viewer {

float swatchScale(const glm::vec3& linear) {
    return std::max({1.0f, linear.x, linear.y, linear.z});
}

glm::vec3 codeOfColor(const glm::vec3& linear, float scale) {
    const auto code = [scale](float value) {
        return float(srgbFromLinear(std::clamp(double(value) / double(scale), 0.0, 1.0)));
    };
    return {code(linear.x), code(linear.y), code(linear.z)};
}

glm::vec3 swatchOfColor(const glm::vec3& linear) {
    return codeOfColor(linear, swatchScale(linear));
}

glm::vec3 colorOfCode(const glm::vec3& code, const glm::vec3& codeBefore, const glm::vec3& linearBefore, float scale) {
    const auto byteOf = [](float value) { return std::lround(255.0f * value); };
    // The number and hexadecimal fields of a picker round all channels to bytes, whichever was edited.
    const auto isSame = [&](float value, float before) {
        return value == before || value == float(byteOf(before)) / 255.0f;
    };
    glm::vec3 linear = linearBefore;
    for (int i = 0; i < 3; ++i)
        if (!isSame(code[i], codeBefore[i]))
            linear[i] = float(double(scale) * linearFromSrgb(std::clamp(double(code[i]), 0.0, 1.0)));
    return linear;
}

std::string colorText(const glm::vec3& linear) {
    const float scale = swatchScale(linear);
    const glm::vec3 code = swatchOfColor(linear);
    const auto byteOf = [](float value) { return int(std::lround(255.0f * value)); };
    const std::string times = scale > 1.0f ? fmt::format("{:.3g} x ", scale) : "";
    return fmt::format("{}#{:02x}{:02x}{:02x} in sRGB, linear {:.3g} {:.3g} {:.3g}", times, byteOf(code.x),
                       byteOf(code.y), byteOf(code.z), linear.x, linear.y, linear.z);
}

} // namespace tessera::viewer
