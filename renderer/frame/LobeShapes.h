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

} // namespace tessera::frame
