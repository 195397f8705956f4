// The vertex shader of every rasterising pass, so that a surface has the same depth to the last bit in all of them.
#include "shared/slots.h"
#include "shared/diffusion.h"
#include "shared/facet.h"
#include "shared/hook.h"
#include "shared/views.h"
#include "lib/surface/camera.glsl"

layout(location = ATTRIBUTE_POSITION) in vec3 positionOS;
layout(location = ATTRIBUTE_NORMAL) in vec3 normalOS;
layout(location = ATTRIBUTE_TANGENT) in vec4 tangentOS;
layout(location = ATTRIBUTE_TEXCOORD0) in vec2 inTexCoord0;
layout(location = ATTRIBUTE_TEXCOORD1) in vec2 inTexCoord1;
layout(location = ATTRIBUTE_COLOR) in vec4 inColor;
layout(location = ATTRIBUTE_FACET_NORMAL) in vec3 facetNormalOS; // of the triangle whose last corner this is

// Per draw: rows of RWS-from-object, and of the cofactor matrix of LS-from-object times the sign of its determinant
// (xyz). w of the first normal row: that sign, times 1 + diffusionNumber; of the second: the largest of the mesh's
// vertex colours, 0 if it has none; of the third: 1 + the index of the mesh instance in the scene.
layout(location = ATTRIBUTE_DRAW_POSITION_ROW0) in vec4 drawRow0;
layout(location = ATTRIBUTE_DRAW_POSITION_ROW0 + 1) in vec4 drawRow1;
layout(location = ATTRIBUTE_DRAW_POSITION_ROW0 + 2) in vec4 drawRow2;
layout(location = ATTRIBUTE_DRAW_NORMAL_ROW0) in vec4 drawNormal0;
layout(location = ATTRIBUTE_DRAW_NORMAL_ROW0 + 1) in vec4 drawNormal1;
layout(location = ATTRIBUTE_DRAW_NORMAL_ROW0 + 2) in vec4 drawNormal2;

invariant gl_Position;
#if !DEPTH_ONLY
layout(location = 0) out vec3 normalLS;
#endif
#if HAS_TANGENTS && !DEPTH_ONLY
layout(location = 1) out vec4 tangentLS;
#endif
#if HAS_TEXCOORDS || IN_ATLAS
layout(location = 2) out vec2 texCoord0;
#if HAS_TEXCOORD1
layout(location = 3) out vec2 texCoord1;
#endif
#endif
#if HAS_VERTEX_COLOR
layout(location = 4) out vec4 vertexColor;
layout(location = 8) flat out float largestColor;
#endif
#if HAS_OBJECT_SPACE_NORMALS && !DEPTH_ONLY
layout(location = 5) flat out vec3 normalFromObject0;
layout(location = 6) flat out vec3 normalFromObject1;
layout(location = 7) flat out vec3 normalFromObject2;
#endif
#if HAS_SHADOWS && !DEPTH_ONLY
layout(location = 9) flat out vec3 facetNormalLS;
#endif
// With --filter exact, fragments have the whole triangle.
#define LIFTS (HAS_SHADOW_LIFT && !DEPTH_ONLY && (!FILTER_EXACT || IN_ATLAS))
#if LIFTS
layout(location = 18) out float tangentPlane; // dot(normalLS, the vertex's position)
#endif
#if HAS_SHADOW_LIFT && !DEPTH_ONLY
layout(location = 19) flat out float facetIsLifted; // 1 if shadow look-ups start above the triangle, else 0
#endif
#if VIEW == VIEW_NORMAL_OBJECT && !DEPTH_ONLY
layout(location = 11) flat out vec3 objectRow0;
layout(location = 12) flat out vec3 objectRow1;
layout(location = 13) flat out vec3 objectRow2;
#endif
#if FILTER_EXACT && !IN_ATLAS
layout(location = 10) out vec3 vertexLS; // for passes/triangle.geom
#endif
#if HAS_SUBSURFACE_DIFFUSION && !DEPTH_ONLY
layout(location = 14) flat out int diffusionNumber;
#endif
#if IN_ATLAS
layout(location = 15) out vec3 positionLS;
#endif
#if HOOKED
layout(location = 16) out vec3 hookedOS;
layout(location = 17) flat out float hookedInstance;
#endif
#ifdef DRAW_IDS
layout(location = 9) flat out float drawnObject;
#endif

#if FILTER_EXACT || HAS_TANGENTS || IN_ATLAS || LIFTS
// Rotates by the transpose; exact if both are the same space.
vec3 lsFromRWS(vec3 directionRWS)
{
    precise vec3 directionLS = directionRWS * mat3(view.worldFromLS);
    return directionLS;
}
#endif

void main()
{
    precise vec4 object = vec4(positionOS, 1.0);
    precise vec3 positionRWS = vec3(dot(drawRow0, object), dot(drawRow1, object), dot(drawRow2, object));
#if IN_ATLAS
    // At its texture coordinates.
    const float side = float(ATLAS_TEXELS);
    precise vec2 place = PLACE_IN_UV_ATLAS(inTexCoord0, float(ATLAS_BORDER), side) / side;
    gl_Position = vec4(place * 2.0 - 1.0, 0.5, 1.0);
    positionLS = lsFromRWS(positionRWS);
#else
    precise vec4 clip = view.clipFromRWS * vec4(positionRWS, 1.0);
    gl_Position = clip;
#if FILTER_EXACT
    vertexLS = lsFromRWS(positionRWS);
#endif
#endif
#if HAS_SUBSURFACE_DIFFUSION && !DEPTH_ONLY
    diffusionNumber = int(abs(drawNormal0.w)) - 1;
#endif
#if !DEPTH_ONLY
    normalLS = vec3(dot(drawNormal0.xyz, normalOS), dot(drawNormal1.xyz, normalOS), dot(drawNormal2.xyz, normalOS));
#if HAS_TANGENTS
    vec3 tangentRWS = vec3(dot(drawRow0.xyz, tangentOS.xyz), dot(drawRow1.xyz, tangentOS.xyz), dot(drawRow2.xyz, tangentOS.xyz));
    tangentLS = vec4(lsFromRWS(tangentRWS), tangentOS.w * sign(drawNormal0.w));
#endif
#if HAS_SHADOWS
    precise vec3 turnedFacet = vec3(dot(drawNormal0.xyz, facetNormalOS), dot(drawNormal1.xyz, facetNormalOS), dot(drawNormal2.xyz, facetNormalOS));
    facetNormalLS = turnedFacet;
#endif
#if LIFTS
    precise float onNormal = dot(normalLS, lsFromRWS(positionRWS));
    tangentPlane = onNormal;
#endif
#if HAS_SHADOW_LIFT
    facetIsLifted = dot(facetNormalOS, facetNormalOS) > 0.5 * (1.0 + LIFTED_FACET * LIFTED_FACET) ? 1.0 : 0.0;
#endif
#if HAS_OBJECT_SPACE_NORMALS
    normalFromObject0 = drawNormal0.xyz;
    normalFromObject1 = drawNormal1.xyz;
    normalFromObject2 = drawNormal2.xyz;
#endif
#if VIEW == VIEW_NORMAL_OBJECT
    objectRow0 = drawRow0.xyz;
    objectRow1 = drawRow1.xyz;
    objectRow2 = drawRow2.xyz;
#endif
#endif
#if HAS_TEXCOORDS || IN_ATLAS
    texCoord0 = inTexCoord0;
#if HAS_TEXCOORD1
    texCoord1 = inTexCoord1;
#endif
#endif
#if HAS_VERTEX_COLOR
    vertexColor = inColor;
    largestColor = drawNormal1.w;
#endif
#if HOOKED
    hookedOS = positionOS;
    hookedInstance = drawNormal2.w;
#endif
#ifdef DRAW_IDS
    drawnObject = drawNormal2.w;
#endif
}
