#pragma once
// What hides lights from surfaces: the triangles of all casters in a bounding volume hierarchy, as RGBA32UI texels of a
// buffer texture. Casters' space (CS) has the axes of the world, its origin at the median of the corners on each axis,
// and about their distance from it as its unit, so that fp32 keeps the digits of positions, and the squares of their
// differences, at any size.
//
//   nodes      CASTER_NODE_TEXELS each, in the order of a walk that goes down first. Texel 0: xyz of the box's low
//              corner; w the node to go on with where the box is missed. Texel 1: xyz of its high corner; w 0, or in
//              a leaf packCasterLeaf()
//   triangles  three corners, xyz each; the first one's w is the triangle's mark, CASTER_PASSED and CASTER_MIRRORED.
//              Where the material has a mask, each w is the opacity that its factor and the vertex colour give, and
//              two texels follow: the coordinates of the first two corners; those of the third, the first texel of
//              the mask, and the mark
//   masks      one texel: the first texel of opacities, width and height in texels, CASTER_MASK_*; one more: x the
//              cutoff as a float; then the opacities as floats, four a texel, row after row
#include "interop.h"

#define CASTER_NODE_TEXELS 2u
#define CASTER_TRIANGLE_TEXELS 3u
#define CASTER_MASKED_TRIANGLE_TEXELS 5u
#define CASTER_MASK_TEXELS 2u

// Of a mark: the row of SubsurfaceConstants that lets light through the material, 0 for none; that the corners run
// clockwise as seen from the front.
#define CASTER_PASSED 255u
#define CASTER_MIRRORED 256u

// Triangles of a leaf at most.
#define CASTER_LEAF_MOST 4u
#define CASTER_LEAF_TEXEL_BITS 29

// How a mask's texels are read: scenes::Wrap of u and v, and whether the nearest one is taken.
#define CASTER_MASK_WRAP_U_SHIFT 0u
#define CASTER_MASK_WRAP_V_SHIFT 2u
#define CASTER_MASK_NEAREST 16u
#define CASTER_WRAP_CLAMP 1u
#define CASTER_WRAP_MIRROR 2u

SHARED_BEGIN

// What a leaf holds: 1 to CASTER_LEAF_MOST triangles from a texel on, all of them with masks or none.
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
    vec4 rwsOriginCS; // xyz the origin of lighting space (frame.h) in casters' space; w that space's units in a metre
    vec4
        rounding; // x metres, y share of the distance from that origin: by how much fp32 may move a surface or a light
                  // against the casters; z the radius around the origin of casters' space that holds them, in its units
    uvec4 size;   // x number of nodes
};

SHARED_END
