#pragma once
#include <vector>

#include <glm/glm.hpp>

/// Reflectance of lobes under uniform illumination, by which the split sum scales filtered light. Source: Karis 2013,
/// "Real Shading in Unreal Engine 4".
namespace tessera::frame {

/// RGBA32F, LOBE_TABLE_LAYERS images with a side of LOBE_TABLE_SIDE texels, by the viewer's cosine (to the right) and
/// alpha (upwards), each the square of its coordinate: shaders/lib/reflectance/lobes.glsl. By layer:
/// 0: R of a GGX lobe with height-correlated masking and F = 1, G the same with F = (1 - l.h)^5; B of Blinn's highlight
///    with the exponent p = 2 / alpha^2 - 2, times p + 2; A the mean of (1 - l.h)^5 over a diffuse reflection.
/// 1: R of a white sheen; G the mean over a diffuse reflection of the larger of its albedos by light and viewer; B the
///    root of the cosine c at which a dielectric of an index near 1 reflects the mean over the lobe of layers 2 on.
/// 2 to 12: of a GGX lobe with separable masking and the reflectance F of a dielectric, for LOBE_TABLE_IORS indices of
///    refraction, four per layer; the cosine's coordinate is shared::lobeColumn(). From index 1 on, relative to F at c:
///    it tends to the lobe with F = 1 both as the index goes to 1 and as alpha goes to 0.
std::vector<glm::vec4> makeLobeTable();

} // namespace tessera::frame
