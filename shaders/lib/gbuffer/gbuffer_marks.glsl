// Integers that pixels hold beside the channels (marks): functions that encode each of them, and that load it.
// markDefines() (renderer/frame/GBufferLayout.h) defines which exist, and where, as the list GBUFFER_MARK_LIST of
//   MARK(code, take, first bit of the words, bits)
#pragma once
#include "lib/surface/surface.glsl"

#ifdef GBUFFER_FACETS
uint codeOfFacets(Surface surface)
{
    return surface.facetCode;
}

void takeFacets(uint code, inout Surface surface)
{
    surface.facetNormalLS = decodeFacet(code);
}
#endif

#ifdef GBUFFER_LIFT
uint codeOfLift(Surface surface)
{
    return surface.liftCode;
}

void takeLift(uint code, inout Surface surface)
{
    surface.liftCode = code;
}
#endif

#ifdef GBUFFER_SUBSURFACE
uint codeOfSubsurface(Surface surface)
{
    return surface.subsurface;
}

void takeSubsurface(uint code, inout Surface surface)
{
    surface.subsurface = code;
}
#endif

#ifdef GBUFFER_OCCLUSION
uint codeOfOcclusion(Surface surface)
{
    return surface.openCode;
}

void takeOcclusion(uint code, inout Surface surface)
{
    surface.openCode = code;
}
#endif
