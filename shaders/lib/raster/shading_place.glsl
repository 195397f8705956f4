// Where a fragment is lit. One function for every pass that shades, or that stores the depth of shading.
#pragma once

struct ShadingPlace {
    vec2 pixel;  // window coordinates
    float depth; // of the triangle there, as the depth buffer has it
};

#if SAMPLES > 1
// With several samples, a pixel is lit once for all those that a triangle covers: in the middle of them. The pixel's own
// centre may lie beside the triangle, where its plane goes on behind what stands next to it, or past the horizon; light
// and shadow there are not the triangle's. Samples are those that the triangle covers, whatever the depth test leaves
// (ARB_post_depth_coverage has the other kind), so a prepass does not move the place. Where a triangle
// seen edge-on is so steep that the sum loses its digits, kLeastDepth keeps it before the horizon.
ShadingPlace shadingPlace()
{
    const vec2 kPlaces[SAMPLES] = vec2[](SAMPLE_PLACES); // from the pixel's lower left corner
    const float kLeastDepth = 1e-6;
    precise vec2 sum = vec2(0.0);
    int covered = 0;
    for (int i = 0; i < SAMPLES; ++i) {
        if ((gl_SampleMaskIn[0] >> i & 1) == 0) continue;
        sum += kPlaces[i];
        ++covered;
    }
    ShadingPlace place = ShadingPlace(gl_FragCoord.xy, min(gl_FragCoord.z, 1.0));
    precise vec2 slope = vec2(dFdx(gl_FragCoord.z), dFdy(gl_FragCoord.z));
    // A pixel that is covered as a whole is lit in its centre, and so is one that is run for derivatives alone.
    if (covered > 0 && covered < SAMPLES) {
        precise vec2 aside = sum / float(covered) - 0.5;
        precise vec2 pixel = gl_FragCoord.xy + aside;
        precise float depth = gl_FragCoord.z + (aside.x * slope.x + aside.y * slope.y);
        place.pixel = pixel;
        place.depth = min(depth, 1.0);
    }
    if (!(place.depth > 0.0)) place.depth = kLeastDepth;
    return place;
}
#else
ShadingPlace shadingPlace()
{
    // As the depth buffer holds it: where the near plane cuts a triangle, rounding may leave it beyond 0 to 1.
    precise float depth = clamp(gl_FragCoord.z, 0.0, 1.0);
    return ShadingPlace(gl_FragCoord.xy, depth);
}
#endif
