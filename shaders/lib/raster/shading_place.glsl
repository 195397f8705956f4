// Position at which a fragment is shaded, for every pass that shades or that stores the shading depth.
#pragma once

struct ShadingPlace {
    vec2 pixel;  // window coordinates
    float depth; // depth-buffer value of the triangle there
};

#if SAMPLES > 1
// With multisampling, a pixel is shaded once for all samples that a triangle covers, at their centroid. The pixel's
// centre may lie outside the triangle, where its plane continues behind adjacent surfaces, or past the horizon; light
// and shadow there are not the triangle's. Coverage is taken before the depth test (unlike ARB_post_depth_coverage), so
// a prepass does not move the position. If a triangle seen edge-on is so steep that the sum loses its digits,
// kLeastDepth keeps the depth in front of the horizon.
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
    // Fully covered pixels and helper invocations are shaded at the centre.
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
    // Clamped as in the depth buffer: where the near plane cuts a triangle, rounding may exceed 0 to 1.
    precise float depth = clamp(gl_FragCoord.z, 0.0, 1.0);
    return ShadingPlace(gl_FragCoord.xy, depth);
}
#endif
