// How packed channels keep what only some surfaces have: an anisotropic lobe, a coat, a sheen.
#pragma once
#include "lib/gbuffer_encodings.glsl"

#if HAS_TANGENT_FRAME
// Two directions at right angles to n, which turn smoothly with it: the first is also at right angles to the coordinate axis of
// that number, which must not be near n.
void axisFrame(vec3 n, uint axis, out vec3 first, out vec3 second)
{
    vec3 across = axis == 0u ? vec3(0.0, -n.z, n.y) : axis == 1u ? vec3(n.z, 0.0, -n.x) : vec3(-n.y, n.x, 0.0);
    first = across / length(across);
    second = cross(n, first);
}

// The tangent has no sign, so it is a point p on half of a diamond, (p, 1 - |p|) in the frame of the axis farthest from the
// normal; the decoder has a normal that is off by its own packing and must be told the axis.
void putTangent(Surface surface, ivec4 widths)
{
    vec3 n = abs(surface.normalLS);
    uint axis = n.x <= n.y && n.x <= n.z ? 0u : n.y <= n.z ? 1u : 2u;
    vec3 first, second;
    axisFrame(surface.normalLS, axis, first, second);
    vec2 direction = vec2(dot(surface.tangentLS, first), dot(surface.tangentLS, second));
    if (direction.y < 0.0) direction = -direction;
    putField(axis, widths.x);
    putField(encodeSigned(direction.x / (abs(direction.x) + direction.y), widths.y, DITHER_NOT), widths.y);
    putField(encodeAlpha(surface.alphaBitangent, widths.z, DITHER_ALPHA), widths.z);
}

void takeTangent(ivec4 widths, inout Surface surface)
{
    vec3 first, second;
    axisFrame(surface.normalLS, takeField(widths.x), first, second);
    float point = decodeSigned(takeField(widths.y), widths.y);
    surface.tangentLS = normalize(point * first + (1.0 - abs(point)) * second);
    surface.alphaBitangent = decodeAlpha(takeField(widths.z), widths.z);
}
#endif

#if HAS_CLEARCOAT
void putClearcoat(Surface surface, ivec4 widths)
{
    putOctahedral(surface.coatNormalCode, widths, DITHER_NOT);
    putField(encodeShare(surface.coatFactor, largestCode(widths.z), DITHER_COAT), widths.z);
    putField(encodeAlpha(surface.coatAlpha, widths.w, DITHER_COAT_ALPHA), widths.w);
}

void takeClearcoat(ivec4 widths, inout Surface surface)
{
    surface.coatNormalCode = takeOctahedral(widths);
    surface.coatFactor = decodeShare(takeField(widths.z), largestCode(widths.z));
    surface.coatAlpha = decodeAlpha(takeField(widths.w), widths.w);
}
#endif

#if HAS_SHEEN
void putSheen(Surface surface, ivec4 widths)
{
    putRoots(surface.sheenColor, widths, DITHER_SHEEN);
    putField(encodeAlpha(surface.sheenAlpha, widths.w, DITHER_SHEEN_ALPHA), widths.w);
}

void takeSheen(ivec4 widths, inout Surface surface)
{
    surface.sheenColor = takeRoots(widths);
    surface.sheenAlpha = decodeAlpha(takeField(widths.w), widths.w);
}
#endif
