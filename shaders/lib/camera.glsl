// The frame's constants and the one way from a pixel and its depth back to a position. Forward uses it with gl_FragCoord.z
// and deferred with the stored depth, which are the same number, so both light the very same point.
#pragma once
#include "shared/slots.h"
#include "shared/frame.h"
#include "lib/surface.glsl"

layout(std140, binding = UNIFORM_FRAME) uniform FrameBlock
{
    FrameConstants frame;
};

Viewpoint viewpointFromDepth(vec2 pixel, float depth)
{
#if HAS_ORTHOGRAPHIC_CAMERA
    precise float viewDepth = (frame.depthToViewDepth.x + frame.depthToViewDepth.y * depth)
                              / (frame.depthToViewDepth.z + frame.depthToViewDepth.w * depth);
#else
    // y is 0 and w is 1 for a perspective camera: the same number, and two constants less to read.
    precise float viewDepth = frame.depthToViewDepth.x / (frame.depthToViewDepth.z + depth);
#endif
    precise vec3 ray = frame.rayOriginLS.xyz + pixel.x * frame.rayDxLS.xyz + pixel.y * frame.rayDyLS.xyz;
    Viewpoint viewpoint;
    viewpoint.depth = depth;
#if HAS_ORTHOGRAPHIC_CAMERA
    if (frame.forwardLS.w != 0.0) {
        precise vec3 position = ray + viewDepth * frame.forwardLS.xyz;
        viewpoint.positionLS = position;
        viewpoint.toViewerLS = -frame.forwardLS.xyz;
        return viewpoint;
    }
#endif
    precise vec3 position = viewDepth * ray;
    precise vec3 toViewer = -ray / sqrt(dot(ray, ray));
    viewpoint.positionLS = position;
    viewpoint.toViewerLS = toViewer;
    return viewpoint;
}
