#pragma once
// Colours of heat maps, for C++ and GLSL.
#include "interop.h"

// log2 of the scale's end if the largest count is unknown: of lights, and of surfaces.
#define HEAT_LIGHTS_LOG2 9
#define HEAT_SURFACES_LOG2 4

SHARED_BEGIN

// The inferno map at ten equal steps, sRGB code values 0..1. Source: Smith and van der Walt 2015 (matplotlib, CC0).
SHARED_FUNCTION vec3 heatAnchor(int step) {
    vec3 code = vec3(252.0f, 255.0f, 164.0f);
    if (step == 0) code = vec3(0.0f, 0.0f, 4.0f);
    if (step == 1) code = vec3(27.0f, 12.0f, 66.0f);
    if (step == 2) code = vec3(75.0f, 12.0f, 107.0f);
    if (step == 3) code = vec3(120.0f, 28.0f, 109.0f);
    if (step == 4) code = vec3(165.0f, 44.0f, 96.0f);
    if (step == 5) code = vec3(207.0f, 68.0f, 70.0f);
    if (step == 6) code = vec3(237.0f, 105.0f, 37.0f);
    if (step == 7) code = vec3(251.0f, 154.0f, 6.0f);
    if (step == 8) code = vec3(247.0f, 208.0f, 60.0f);
    return code / 255.0f;
}

// Colour at 0..1 (clamped) as sRGB code values: black, violet, red, orange, pale yellow, with increasing lightness;
// linear between the steps.
SHARED_FUNCTION vec3 heatColor(float position) {
    float steps = min(max(position, 0.0f), 1.0f) * 9.0f;
    int lower = min(int(steps), 8);
    float share = steps - float(lower);
    return heatAnchor(lower) * (1.0f - share) + heatAnchor(lower + 1) * share;
}

// Position of a count on the logarithmic scale of 1 + count: 0 for none, 1 for 2^log2Most - 1.
SHARED_FUNCTION float heatPositionOfCount(float count, float log2Most) {
    return log2(1.0f + max(count, 0.0f)) / log2Most;
}

// log2 of the scale's end for a known largest count; the scale covers at least 0 to 7.
SHARED_FUNCTION float heatScaleLog2(float most) {
    return log2(1.0f + max(most, 7.0f));
}

SHARED_END
