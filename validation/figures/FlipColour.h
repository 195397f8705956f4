#pragma once
#include <glm/glm.hpp>

/// The colour spaces of FLIP (Flip.h). The white point is that of sRGB, D65.
namespace tessera::validation {

/// Opponent colours, linear in light: Y runs from 0 (black) to 100 (white), offset by -16 like lightness; Cx from green
/// to red, Cz from blue to yellow. Source: Flohr et al. 1993, "Model Based Color Image Quantization", as used by
/// Andersson et al. 2020.
glm::dvec3 opponentFromLinear(const glm::dvec3& linearRgb);
glm::dvec3 linearFromOpponent(const glm::dvec3& opponent);

/// CIE L*a*b* 1976 of a linear Rec.709 colour, with a* and b* scaled by 0.01 L* for the Hunt effect: chroma is less
/// visible in the dark.
glm::dvec3 huntLabFromLinear(const glm::dvec3& linearRgb);

/// The distance of two such colours, valid for large differences too: |dL| + sqrt(da^2 + db^2).
/// Source: Abasi et al. 2020, "Distance Metrics for Very Large Color Differences".
double hyab(const glm::dvec3& labA, const glm::dvec3& labB);

} // namespace tessera::validation
