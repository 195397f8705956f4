// Constants of the view and its lights, and reconstruction of positions from pixel and depth. Forward uses
// gl_FragCoord.z and deferred the stored depth, which are the same number, so both shade the same point.
#pragma once
#include "shared/slots.h"
#include "shared/frame.h"
#include "lib/surface/surface.glsl"

#ifdef FLAT_CONSTANTS
// Outputs of passes/fullscreen.vert: Mesa's software rasteriser broadcasts them, whereas it gathers every number of a
// uniform block for each lane.
layout(location = 0) flat in ViewConstants view;
layout(location = VIEW_CONSTANT_ROWS) flat in LightingConstants lighting;
#else
layout(std140, binding = UNIFORM_VIEW) uniform ViewBlock
{
    ViewConstants view;
};

layout(std140, binding = UNIFORM_LIGHTING) uniform LightingBlock
{
    LightingConstants lighting;
};
#endif

// Whether this is a helper invocation, which may lie outside the image or beyond its triangle's edges.
#if defined(LIGHTING_IN_COMPUTE) && LIGHTING_IN_COMPUTE
#define IS_HELPER false
#else
#define IS_HELPER gl_HelperInvocation
#endif

// Depth-buffer value at a distance ahead of the origin of lighting space.
float depthFromAhead(float ahead)
{
    vec4 lens = view.aheadFromDepth;
    precise float depth = (lens.x - ahead * lens.z) / (ahead * lens.w - lens.y);
    return depth;
}

// Component of a pixel's ray across the view axis, in metres; at one metre ahead of the eye unless orthographic.
vec3 acrossOfPixel(vec2 pixel)
{
    precise vec2 place = pixel - view.rayFromPixel.zw;
    precise vec3 across = place.x * view.rayDxLS.xyz + place.y * view.rayDyLS.xyz;
    return across;
}

// Scale of pixel rays: s metres ahead of the origin of lighting space they lie (x + y s) times as wide as rayFromPixel.
vec2 raySpread()
{
    return view.forwardLS.w != 0.0 ? vec2(1.0, 0.0) : vec2(view.eyeLS.w, 1.0);
}

// Maximum distance in metres by which vertex snapping moves a rasterised point off its triangle.
float snappingMetres(vec3 positionLS)
{
    vec2 spread = raySpread();
    precise float metres = view.depthKey.z * (spread.x + spread.y * dot(view.forwardLS.xyz, positionLS));
    return metres;
}

Viewpoint viewpointFromDepth(vec2 pixel, float depth)
{
#if HAS_ORTHOGRAPHIC_CAMERA
    precise float ahead = (view.aheadFromDepth.x + view.aheadFromDepth.y * depth)
                          / (view.aheadFromDepth.z + view.aheadFromDepth.w * depth);
#else
    // aheadFromDepth.w is 1 for a perspective camera.
    precise float ahead = (view.aheadFromDepth.x + view.aheadFromDepth.y * depth) / (view.aheadFromDepth.z + depth);
#endif
    precise vec3 across = acrossOfPixel(pixel);
    Viewpoint viewpoint;
    viewpoint.depth = depth;
    viewpoint.pixel = pixel;
#if HAS_ORTHOGRAPHIC_CAMERA
    if (view.forwardLS.w != 0.0) {
        precise vec3 position = across + ahead * view.forwardLS.xyz;
        viewpoint.positionLS = position;
        viewpoint.toViewerLS = -view.forwardLS.xyz;
        return viewpoint;
    }
#endif
    // Split along and across the view axis: each part is as small as the visible scene, wherever the eye is.
    precise float viewDepth = view.eyeLS.w + ahead;
    precise vec3 position = viewDepth * across + ahead * view.forwardLS.xyz;
    precise vec3 ray = across + view.forwardLS.xyz;
    precise float perLength = 1.0 / sqrt(dot(ray, ray));
    precise vec3 toViewer = -ray * perLength;
    viewpoint.positionLS = position;
    viewpoint.toViewerLS = toViewer;
    return viewpoint;
}
