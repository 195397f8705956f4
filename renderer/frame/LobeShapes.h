#pragma once
#include <span>

#include <glm/glm.hpp>

/// The shapes of GGX lobes, for the light of areas: transformed cosines (docs/area-lights.md). Source: Heitz, Dupuy,
/// Hill, Neubelt 2016, "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines".
namespace tessera::frame {

/// Four numbers an entry, LOBE_SHAPES_SIDE squared of them, row after row from the smallest alpha on:
/// shaders/shared/lobe_shapes.h. Of the lobe with height-correlated masking and without Fresnel, times the cosine of
/// the light.
std::span<const glm::vec4> lobeShapes();

/// The matrix that takes lights to a clamped cosine (shared::inverseOfShape), from numbers interpolated as by a shader:
/// linearly between four entries. Smaller alphas and cosines count as the smallest of the table.
glm::dmat3 inverseShape(double alpha, double cosView);

} // namespace tessera::frame
