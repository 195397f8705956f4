// Fragment-shader inputs of rasterised geometry: gathers the outputs of geometry.vert for lib/material/material.glsl.
#pragma once
#include "lib/surface/camera.glsl"
#include "lib/material/material.glsl"
#if FILTER_EXACT && !IN_ATLAS
#define BY_TRIANGLE 1
#include "lib/surface/triangle.glsl"
#else
#define BY_TRIANGLE 0
#endif
#if !DEPTH_ONLY
#include "lib/raster/facing.glsl"
#include "lib/raster/shading_place.glsl"
#if HAS_SHADOWS
#include "lib/raster/facet_normal.glsl"
#endif
#endif

#if !DEPTH_ONLY
#if !BY_TRIANGLE
layout(location = 0) in vec3 normalLS;
#endif
#if HAS_TANGENTS
layout(location = 1) in vec4 tangentLS;
#endif
#if HAS_OBJECT_SPACE_NORMALS
layout(location = 5) flat in vec3 normalFromObject0;
layout(location = 6) flat in vec3 normalFromObject1;
layout(location = 7) flat in vec3 normalFromObject2;
#endif
#if VIEW == VIEW_NORMAL_OBJECT
#if BY_TRIANGLE
#define OBJECT_ROWS 20 // passes/triangle.geom has more outputs than a vertex shader may have
#else
#define OBJECT_ROWS 11
#endif
layout(location = OBJECT_ROWS) flat in vec3 objectRow0;
layout(location = OBJECT_ROWS + 1) flat in vec3 objectRow1;
layout(location = OBJECT_ROWS + 2) flat in vec3 objectRow2;
#endif
#endif
#if (HAS_TEXCOORDS || IN_ATLAS) && !BY_TRIANGLE
layout(location = 2) in vec2 texCoord0;
#if HAS_TEXCOORD1
layout(location = 3) in vec2 texCoord1;
#endif
#endif
#if HAS_VERTEX_COLOR
layout(location = 4) in vec4 vertexColor;
layout(location = 8) flat in float largestColor; // 0 without vertex colours
#endif

#if HAS_SHADOW_LIFT && !DEPTH_ONLY
#include "lib/raster/rasterised_lift.glsl"
#include "lib/shadow/shadow_lift.glsl"
#endif

#if HOOKED
#if BY_TRIANGLE
#define HOOK_ROWS 23
#else
#define HOOK_ROWS 16
#endif
layout(location = HOOK_ROWS) in vec3 hookedOS;
layout(location = HOOK_ROWS + 1) flat in float hookedInstance;
#endif

Fragment rasterisedFragment()
{
    Fragment fragment = plainFragment();
    fragment.frontFacing = IN_ATLAS != 0 || gl_FrontFacing;
#if BY_TRIANGLE
    dvec3 weights = triangleWeights(gl_FragCoord.xy);
#endif
#if !DEPTH_ONLY
#if !IN_ATLAS
    ShadingPlace place = shadingPlace();
#endif
    // The centre of a partly covered pixel may lie outside the triangle, where extrapolated normals may face lights
    // behind it. So normals are evaluated at the shading position.
#if BY_TRIANGLE
#if SAMPLES > 1
    dvec3 placeWeights = triangleWeights(place.pixel);
#else
    dvec3 placeWeights = weights;
#endif
    fragment.normalLS = triangleNormal(placeWeights);
#elif SAMPLES > 1 && !IN_ATLAS
    vec2 aside = place.pixel - gl_FragCoord.xy;
    precise vec3 normalAside = normalLS + (aside.x * dFdx(normalLS) + aside.y * dFdy(normalLS));
    fragment.normalLS = aside == vec2(0.0) ? normalLS : normalAside;
#else
    fragment.normalLS = normalLS;
#endif
#if !IN_ATLAS
    fragment.toViewerLS = viewpointFromDepth(gl_FragCoord.xy, 0.5).toViewerLS; // independent of depth
#if BY_TRIANGLE
    fragment.leastFacing = leastFacing(triangleCosine(gl_FragCoord.xy));
#else
    vec2 depthChange = vec2(dFdx(gl_FragCoord.z), dFdy(gl_FragCoord.z));
    fragment.leastFacing = leastFacing(facetCosineOf(gl_FragCoord.xy, gl_FragCoord.z, depthChange, fragment.toViewerLS));
#endif
#endif
#if HAS_TANGENTS
    fragment.tangentLS = tangentLS;
#endif
#if HAS_OBJECT_SPACE_NORMALS
    // The inputs are the rows of the matrix.
    fragment.normalFromObject = transpose(mat3(normalFromObject0, normalFromObject1, normalFromObject2));
#endif
#if HAS_SHADOWS
    fragment.facetNormalLS = rasterisedFacetNormal(fragment.frontFacing);
#endif
#if HAS_SHADOW_LIFT && !IN_ATLAS
    vec3 positionLS = viewpointFromDepth(place.pixel, place.depth).positionLS;
#if BY_TRIANGLE
    float metres = rasterisedLift(placeWeights);
#else
    float metres = rasterisedLift(positionLS, fragment.normalLS, place.pixel - gl_FragCoord.xy);
#endif
    fragment.liftCode = encodeLift(metres, positionLS);
#endif
#if VIEW == VIEW_NORMAL_OBJECT
    fragment.objectFromNormal = mat3(objectRow0, objectRow1, objectRow2) * mat3(view.worldFromLS);
#endif
#endif
#if HAS_TEXCOORDS && BY_TRIANGLE
    dvec4 texCoord = triangleTexCoord(weights);
    fragment.texCoord[0] = texCoord.xy;
    fragment.texCoord[1] = texCoord.zw;
#if HAS_MIXED_FILTERS
    dvec4 texCoordDx = triangleTexCoord(triangleWeightsChange(gl_FragCoord.xy, weights, dvec3(view.rayDxLS.xyz)));
    dvec4 texCoordDy = triangleTexCoord(triangleWeightsChange(gl_FragCoord.xy, weights, dvec3(view.rayDyLS.xyz)));
    fragment.texCoordChange[0] = dmat2(texCoordDx.xy, texCoordDy.xy);
    fragment.texCoordChange[1] = dmat2(texCoordDx.zw, texCoordDy.zw);
#endif
#elif HAS_TEXCOORDS || IN_ATLAS
    fragment.texCoord[0] = texCoord0;
#if HAS_TEXCOORD1
    fragment.texCoord[1] = texCoord1;
#endif
#if FILTER_EXACT && HAS_MIXED_FILTERS
    fragment.texCoordChange[0] = dmat2(dFdx(texCoord0), dFdy(texCoord0));
#if HAS_TEXCOORD1
    fragment.texCoordChange[1] = dmat2(dFdx(texCoord1), dFdy(texCoord1));
#endif
#endif
#endif
#if HOOKED
    fragment.positionOS = hookedOS;
    fragment.instance = int(hookedInstance) - 1;
#endif
#if HAS_VERTEX_COLOR
    if (largestColor != 0.0) fragment.color = vertexColor;
#if SAMPLES > 1
    // A pixel's centre may lie outside the triangle, where colours are extrapolated. `centroid` is no substitute: its
    // position may depend on the depth test, and so on whether there was a prepass.
    fragment.color = clamp(fragment.color, 0.0, max(largestColor, 1.0));
#endif
#endif
    return fragment;
}
