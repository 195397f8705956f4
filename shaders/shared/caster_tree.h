#pragma once
// Bounding volume hierarchy over the triangles of all shadow casters, as RGBA32UI texels of a buffer texture. Caster
// space (CS) has the world's axes, its origin at the per-axis median of the vertices, and about their distance from it
// as its unit, so that fp32 represents positions and squared differences at any scene scale.
//
//   nodes      CASTER_NODE_TEXELS each, in depth-first order. Texel 0: xyz low corner of the box; w next node if the
//              box is missed. Texel 1: xyz high corner; w 0, or packCasterLeaf() in a leaf
//   triangles  three corners, xyz each; w of the first: flag bits, CASTER_PASSED and CASTER_MIRRORED. If the material
//              has a mask, each w is the opacity by material factor and vertex colour, and two texels follow: texture
//              coordinates of the first two corners; those of the third, first texel of the mask, and the flag bits
//   masks      one texel: first texel of the opacities, width and height in texels, CASTER_MASK_*; one more: x the
//              cutoff as a float; then the opacities as floats, four per texel, row by row
#include "interop.h"

#define CASTER_NODE_TEXELS 2u
#define CASTER_TRIANGLE_TEXELS 3u
#define CASTER_MASKED_TRIANGLE_TEXELS 5u
#define CASTER_MASK_TEXELS 2u

// Flag bits: row of SubsurfaceConstants if the material transmits light, else 0; whether the corners wind clockwise as
// seen from the front.
#define CASTER_PASSED 255u
#define CASTER_MIRRORED 256u

// Maximum number of triangles per leaf.
#define CASTER_LEAF_MOST 4u
#define CASTER_LEAF_TEXEL_BITS 29

// Sampling of a mask: scenes::Wrap of u and v; whether the filter is nearest.
#define CASTER_MASK_WRAP_U_SHIFT 0u
#define CASTER_MASK_WRAP_V_SHIFT 2u
#define CASTER_MASK_NEAREST 16u
#define CASTER_WRAP_CLAMP 1u
#define CASTER_WRAP_MIRROR 2u

SHARED_BEGIN

// A packed leaf: 1 to CASTER_LEAF_MOST triangles from `firstTexel` on, all with masks or none.
SHARED_FUNCTION uint packCasterLeaf(uint firstTexel, uint triangles, bool isMasked) {
    return (firstTexel << (32 - CASTER_LEAF_TEXEL_BITS)) | (isMasked ? 4u : 0u) | (triangles - 1u);
}
SHARED_FUNCTION uint casterLeafTexel(uint leaf) {
    return leaf >> (32 - CASTER_LEAF_TEXEL_BITS);
}
SHARED_FUNCTION uint casterLeafTriangles(uint leaf) {
    return (leaf & 3u) + 1u;
}
SHARED_FUNCTION bool isCasterLeafMasked(uint leaf) {
    return (leaf & 4u) != 0u;
}

struct CasterTreeConstants {
    vec4 rwsOriginCS; // xyz origin of lighting space (frame.h) in caster space; w caster-space units per metre
    vec4 rounding; // fp32 position error of surfaces and lights relative to the casters: x constant, in metres, y per
                   // metre of distance from the origin of lighting space; z bounding radius of the casters around the
                   // origin of caster space, in its units
    uvec4 size;    // x number of nodes
};

SHARED_END
