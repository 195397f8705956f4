// The depth at which a fragment is lit. One function for every pass that shades, or that stores the depth of shading.
#pragma once

#if SAMPLES > 1
// With several samples, a pixel is still lit once, where the triangle's plane meets the ray through the pixel's centre.
// A triangle that covers other samples only may have left the depths there: its plane passes the far end or, with depth
// as 1/distance, behind the eye (0 or less), or passes before the near end (more than 1). The samples it does cover lie
// within half a pixel, so within `reach` of the centre's depth: where the plane could end within the pixel, the nearest
// depth a sample can have stands in. The result is finite, never before the near end, and with depth as 1/distance at
// most twice as far away as a covered sample. The minimum kLeastDepth matters only where a triangle seen edge-on is so steep
// that the sum loses its digits.
float shadingDepth()
{
    const float kLeastDepth = 1e-6;
    precise float reach = 0.5 * (abs(dFdx(gl_FragCoord.z)) + abs(dFdy(gl_FragCoord.z)));
    precise float nearest = max(gl_FragCoord.z + reach, kLeastDepth);
    precise float depth = min(gl_FragCoord.z > reach ? gl_FragCoord.z : nearest, 1.0);
    return depth;
}
#else
float shadingDepth()
{
    // As the depth buffer holds it: where the near plane cuts a triangle, rounding may leave it beyond 0 to 1.
    precise float depth = clamp(gl_FragCoord.z, 0.0, 1.0);
    return depth;
}
#endif
