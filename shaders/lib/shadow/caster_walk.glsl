// Shadow rays: traverses the tree of casters (shared/caster_tree.h) from a point to a light.
//
// A triangle hides the light if it crosses the ray between the two ends. A triangle whose plane holds an end within
// rounding hides nothing: fp32 cannot decide on which side of the plane the end lies. The point's own triangle is one
// of these, so the caller decides whether that hides the light. Edges are tested in two coordinates across the ray, so
// that no ray slips through between two triangles that share one (Woop, Benthin, Wald 2013, "Watertight Ray/Triangle
// Intersection"). Triangles are two-sided.
#pragma once
#include "shared/slots.h"
#include "shared/caster_tree.h"
#include "lib/surface/camera.glsl"
#include "lib/maths/cut_loop.glsl"

layout(std140, binding = UNIFORM_CASTER_TREE) uniform CasterTreeBlock
{
    CasterTreeConstants casterTree;
};
layout(binding = TEXTURE_UNIT_SHADOWS) uniform usamplerBuffer casterTexels;

// A ray in caster space (CS).
struct ShadowRay {
    vec3 originCS;
    vec3 toLightCS;        // from the origin to the light
    vec3 inverseToLightCS; // 1 / toLightCS, never infinite
    int longestAxis;       // of toLightCS
    vec2 shear;            // change across that axis per step along it
    float originRounding;  // rounding error of each end, in units of CS
    float lightRounding;
};

vec4 casterTexel(uint texel)
{
    return uintBitsToFloat(texelFetch(casterTexels, int(texel)));
}

// Permutes the axes so that the longest one of the ray becomes z; they stay right-handed.
vec3 turned(vec3 v, int longestAxis)
{
    return longestAxis == 0 ? v.yzx : longestAxis == 1 ? v.zxy : v;
}

vec3 positionCS(vec3 positionLS)
{
    precise vec3 metres = mat3(view.worldFromLS) * positionLS;
    precise vec3 position = metres * casterTree.rwsOriginCS.w + casterTree.rwsOriginCS.xyz;
    return position;
}

// fp32 position error of a surface or a light relative to the casters, in units of CS.
float roundingAt(vec3 positionLS)
{
    precise float metres = casterTree.rounding.x + casterTree.rounding.y * length(positionLS);
    return metres * casterTree.rwsOriginCS.w;
}

ShadowRay shadowRay(vec3 originLS, vec3 toLightCS, float lightRounding)
{
    ShadowRay ray;
    ray.originCS = positionCS(originLS);
    ray.toLightCS = toLightCS;
    ray.originRounding = roundingAt(originLS) + snappingMetres(originLS) * casterTree.rwsOriginCS.w;
    ray.lightRounding = lightRounding;
    vec3 size = abs(toLightCS);
    ray.longestAxis = size.x >= max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
    vec3 ahead = turned(toLightCS, ray.longestAxis);
    precise vec2 shear = ahead.xy * (1.0 / ahead.z);
    ray.shear = shear;
    // Keeps the inverse finite: a ray across an axis still misses the boxes beside it by far.
    vec3 least = vec3(1e-18 * max(size.x, max(size.y, size.z)));
    precise vec3 inverse = 1.0 / mix(max(toLightCS, least), min(toLightCS, -least), lessThan(toLightCS, vec3(0.0)));
    ray.inverseToLightCS = inverse;
    return ray;
}

// Whether the ray may pass through a box. The ray parameter of a plane has a relative rounding error below 2^-20, even
// if a division is off by 2.5 of its last digits, as GLSL allows (Ize 2013, "Robust BVH Ray Traversal").
bool meetsBox(ShadowRay ray, vec3 lowCS, vec3 highCS)
{
    precise vec3 toLow = (lowCS - ray.originCS) * ray.inverseToLightCS;
    precise vec3 toHigh = (highCS - ray.originCS) * ray.inverseToLightCS;
    vec3 nearest = min(toLow, toHigh);
    vec3 farthest = max(toLow, toHigh);
    float enters = max(max(nearest.x, nearest.y), max(nearest.z, 0.0));
    precise float leaves = min(min(farthest.x, farthest.y), min(farthest.z, 1.0)) * 1.000001;
    return enters <= leaves;
}

#if HAS_ALPHA_MASK
// Wraps a texel coordinate into 0 .. size - 1.
int wrappedTexel(int at, int size, uint wrap)
{
    if (wrap == CASTER_WRAP_CLAMP) return clamp(at, 0, size - 1);
    int period = wrap == CASTER_WRAP_MIRROR ? 2 * size : size;
    int inside = at - period * int(floor(float(at) / float(period)));
    inside = inside < 0 ? inside + period : inside >= period ? inside - period : inside;
    return inside < size ? inside : 2 * size - 1 - inside;
}

float maskTexel(uvec4 mask, ivec2 at)
{
    ivec2 size = ivec2(mask.yz);
    int column = wrappedTexel(at.x, size.x, (mask.w >> CASTER_MASK_WRAP_U_SHIFT) & 3u);
    int row = wrappedTexel(at.y, size.y, (mask.w >> CASTER_MASK_WRAP_V_SHIFT) & 3u);
    uint texel = uint(row) * mask.y + uint(column);
    return casterTexel(mask.x + (texel >> 2))[texel & 3u];
}

// Alpha test of a caster with a mask, by the magnification filter of its texture: a ray has no size in texels.
// `weights`: barycentric.
bool isSolid(uint triangle, vec3 weights, vec3 opacities)
{
    vec4 texCoord01 = casterTexel(triangle + 3u);
    uvec4 last = texelFetch(casterTexels, int(triangle + 4u));
    uvec4 mask = texelFetch(casterTexels, int(last.z));
    float cutoff = casterTexel(last.z + 1u).x;
    precise vec2 texCoord =
        weights.x * texCoord01.xy + weights.y * texCoord01.zw + weights.z * uintBitsToFloat(last.xy);
    precise vec2 place = texCoord * vec2(mask.yz);
    // Beyond this, fp32 cannot resolve a texel.
    place = clamp(place, vec2(-1e9), vec2(1e9));
    precise float texel;
    if ((mask.w & CASTER_MASK_NEAREST) != 0u) {
        texel = maskTexel(mask, ivec2(floor(place)));
    } else {
        precise vec2 between = place - 0.5;
        vec2 corner = floor(between);
        precise vec2 share = between - corner;
        ivec2 at = ivec2(corner);
        precise float top = mix(maskTexel(mask, at), maskTexel(mask, at + ivec2(1, 0)), share.x);
        precise float bottom = mix(maskTexel(mask, at + ivec2(0, 1)), maskTexel(mask, at + ivec2(1, 1)), share.x);
        texel = mix(top, bottom, share.y);
    }
    precise float opacity = dot(weights, opacities) * texel;
    return opacity >= cutoff;
}
#endif

// Intersection of a ray with a triangle, if there is one between the ray's ends.
struct Crossing {
    bool isThere;
#if HAS_SUBSURFACE_PASSAGE
    bool isOnce;  // for a ray through the common edge of two triangles, true for only one of them
    float share;  // ray parameter; negative if the ray enters here, through the front
    uint passed;  // row of SubsurfaceConstants if the material transmits light, else 0
#endif
};

#if HAS_SUBSURFACE_PASSAGE
#define NO_CROSSING Crossing(false, false, 0.0, 0u)

// Whether an edge that a ray meets counts for the triangle on this side of it, and not for one on the other.
bool ownsEdge(vec2 along, float orientation)
{
    vec2 turnedAlong = orientation > 0.0 ? along : -along;
    return turnedAlong.y > 0.0 || (turnedAlong.y == 0.0 && turnedAlong.x < 0.0);
}
#else
#define NO_CROSSING Crossing(false)
#endif

// `triangle`: its first texel.
Crossing crossingOf(ShadowRay ray, uint triangle, bool isMasked)
{
    vec4 corner0 = casterTexel(triangle);
    vec4 corner1 = casterTexel(triangle + 1u);
    vec4 corner2 = casterTexel(triangle + 2u);
    precise vec3 a = turned(corner0.xyz - ray.originCS, ray.longestAxis);
    precise vec3 b = turned(corner1.xyz - ray.originCS, ray.longestAxis);
    precise vec3 c = turned(corner2.xyz - ray.originCS, ray.longestAxis);
    precise vec2 aAcross = a.xy - ray.shear * a.z;
    precise vec2 bAcross = b.xy - ray.shear * b.z;
    precise vec2 cAcross = c.xy - ray.shear * c.z;
    precise float u = cAcross.x * bAcross.y - cAcross.y * bAcross.x;
    precise float v = aAcross.x * cAcross.y - aAcross.y * cAcross.x;
    precise float w = bAcross.x * aAcross.y - bAcross.y * aAcross.x;
    if (min(u, min(v, w)) < 0.0 && max(u, max(v, w)) > 0.0) return NO_CROSSING;
    // Side and distance of each end relative to the plane, times the normal's length. Corner 0 lies between the shorter
    // edges, so that their product keeps the normal's digits in thin triangles too.
    precise vec3 edge1 = corner1.xyz - corner0.xyz;
    precise vec3 edge2 = corner2.xyz - corner0.xyz;
    precise vec3 fromCorner = ray.originCS - corner0.xyz;
    precise vec3 normal = cross(edge1, edge2);
    // fp32 cannot hold the squares of small triangles' areas.
    vec3 components = abs(normal);
    float largest = max(max(components.x, components.y), max(components.z, 1e-37));
    precise float area = largest * length(normal / largest);
    precise float originSide = dot(normal, fromCorner);
    precise float lightSide = originSide + dot(normal, ray.toLightCS);
    // A component of the normal is off by about 2^-23 of the product of the edges, and its factor by 2^-24 of itself;
    // three of each are summed. The corner is off by 2^-24 of its distance from the origin of caster space, which is at
    // most the point's distance, as in originRounding, plus the way between them.
    precise float digits = 7.0e-7 * length(edge1) * length(edge2);
    precise float originError = ray.originRounding * area + digits * length(fromCorner);
    precise float lightError = ray.lightRounding * area + digits * (length(fromCorner) + length(ray.toLightCS));
    bool isBetween = abs(originSide) > originError && abs(lightSide) > lightError &&
                     (originSide > 0.0) != (lightSide > 0.0);
    if (!isBetween) return NO_CROSSING;
    Crossing crossing = NO_CROSSING;
    crossing.isThere = true;
#if HAS_ALPHA_MASK || HAS_SUBSURFACE_PASSAGE
    precise float sum = u + v + w;
#endif
#if HAS_ALPHA_MASK
    if (isMasked && sum != 0.0)
        crossing.isThere = isSolid(triangle, vec3(u, v, w) / sum, vec3(corner0.w, corner1.w, corner2.w));
#endif
#if HAS_SUBSURFACE_PASSAGE
    // As integers: small values are denormal floats, which GPUs may flush to 0.
    uint mark = texelFetch(casterTexels, int(isMasked ? triangle + 4u : triangle)).w;
    crossing.passed = mark & CASTER_PASSED;
    crossing.isOnce = (u != 0.0 || ownsEdge(cAcross - bAcross, sum)) && (v != 0.0 || ownsEdge(aAcross - cAcross, sum)) &&
                      (w != 0.0 || ownsEdge(bAcross - aAcross, sum));
    precise float share = originSide / (originSide - lightSide);
    bool goesIn = (originSide > 0.0) != ((mark & CASTER_MIRRORED) != 0u);
    crossing.share = goesIn ? -share : share;
#endif
    return crossing;
}

// State of a traversal.
struct CasterWalk {
    uint node;      // next node; past the last: the traversal ends when no triangles are left
    uint triangle;  // next triangle of the current leaf
    uint triangles; // number of triangles left in that leaf
    bool isMasked;  // whether they have masks
    bool isHidden;  // whether the light is hidden
#if HAS_SUBSURFACE_PASSAGE
    uint passed;    // row of SubsurfaceConstants of bodies that transmit the light; 0: none do
    float inside;   // fraction of the ray inside these bodies
#endif
};

#if HAS_SUBSURFACE_PASSAGE
#define CASTER_WALK(node, isHidden) CasterWalk(node, 0u, 0u, false, isHidden, 0u, 0.0)
#else
#define CASTER_WALK(node, isHidden) CasterWalk(node, 0u, 0u, false, isHidden)
#endif

bool goesOn(CasterWalk walk)
{
    return walk.node < casterTree.size.x || walk.triangles > 0u;
}

// Takes one step: a triangle, or a node if no triangles are left.
void takeStep(ShadowRay ray, inout CasterWalk walk)
{
    if (walk.triangles > 0u) {
        Crossing crossing = crossingOf(ray, walk.triangle, walk.isMasked);
#if HAS_SUBSURFACE_PASSAGE
        bool passes = walk.passed != 0u && crossing.passed == walk.passed;
        precise float inside = walk.inside + (crossing.isThere && passes && crossing.isOnce ? crossing.share : 0.0);
        walk.inside = inside;
        walk.isHidden = crossing.isThere && !passes;
#else
        walk.isHidden = crossing.isThere;
#endif
        walk.triangle += walk.isMasked ? CASTER_MASKED_TRIANGLE_TEXELS : CASTER_TRIANGLE_TEXELS;
        --walk.triangles;
        if (walk.isHidden) {
            walk.node = casterTree.size.x;
            walk.triangles = 0u;
        }
    } else {
        int texel = int(walk.node * CASTER_NODE_TEXELS);
        uvec4 low = texelFetch(casterTexels, texel);
        uvec4 high = texelFetch(casterTexels, texel + 1);
        bool meets = meetsBox(ray, uintBitsToFloat(low.xyz), uintBitsToFloat(high.xyz));
        walk.node = meets ? walk.node + 1u : low.w;
        if (meets && high.w != 0u) {
            walk.triangle = casterLeafTexel(high.w);
            walk.triangles = casterLeafTriangles(high.w);
            walk.isMasked = isCasterLeafMasked(high.w);
        }
    }
}

// Traverses all nodes, or stops when the light is hidden. If it could go on after that, Mesa truncated the loop.
void walkOn(ShadowRay ray, inout CasterWalk walk)
{
    // CASTER_STEPS (renderer/frame/FrameDefines.cpp) are unrolled by hand: Mesa counts the iterations of all loops of a
    // shader together and truncates loops when there are too many.
#define NEXT_STEP if (goesOn(walk)) takeStep(ray, walk);
    while (goesOn(walk)) {
        takeStep(ray, walk);
#if CASTER_STEPS > 1
        NEXT_STEP NEXT_STEP NEXT_STEP
#endif
#if CASTER_STEPS > 4
        NEXT_STEP NEXT_STEP NEXT_STEP NEXT_STEP NEXT_STEP NEXT_STEP
        NEXT_STEP NEXT_STEP NEXT_STEP NEXT_STEP NEXT_STEP NEXT_STEP
#endif
    }
}

// Returns 0 if casters hide the light, or (isBehind) the point's own triangle does, else 1.
float visibilityAlong(ShadowRay ray, bool isBehind)
{
    // Skips helper invocations: their rays may meet every box, and neighbouring pixels would wait for them.
    CasterWalk walk = CASTER_WALK(isBehind || IS_HELPER ? casterTree.size.x : 0u, isBehind);
    walkOn(ray, walk);
    // A truncated loop yields NaN, which is visible, instead of unknown light.
    if (goesOn(walk)) return CUT_LOOP;
    return walk.isHidden ? 0.0 : 1.0;
}

#if HAS_SUBSURFACE_PASSAGE
const float PASSAGE_HIDDEN = -1e30;

// Fraction of the ray inside bodies whose row of SubsurfaceConstants is `subsurface`, by where it enters and leaves
// them; PASSAGE_HIDDEN if something else hides the light.
float passageAlong(ShadowRay ray, uint subsurface)
{
    CasterWalk walk = CASTER_WALK(IS_HELPER ? casterTree.size.x : 0u, false);
    walk.passed = subsurface;
    walkOn(ray, walk);
    if (goesOn(walk)) return CUT_LOOP;
    return walk.isHidden ? PASSAGE_HIDDEN : walk.inside;
}
#endif
