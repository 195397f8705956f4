// Filtering of material textures. `hardware`: by the driver and the sampler. `exact`: by OpenGL's definition for a
// texture of one level, computed in fp32 from fetched texels, which the double-precision reference shares: hardware
// bilinear filtering of 8-bit textures may be off by 3.5e-3, and the choice of level is implementation-defined. For the
// same reason `exact` decodes sRGB colours itself, from textures that hold their code values.
#pragma once
#include "shared/material.h"

// Texture coordinates; in double, a coordinate of 30 still resolves a millionth of a texel.
#if FILTER_EXACT
#define TexCoord dvec2
#else
#define TexCoord vec2
#endif

// Wraps a texel index into 0 .. size-1; `mode`: the Wrap of scenes::Sampler.
int wrapTexel(int index, int size, int mode)
{
    if (mode == 1) return clamp(index, 0, size - 1);
    int period = mode == 2 ? 2 * size : size;
    // GLSL leaves % of negative numbers undefined.
    int inside = index >= 0 ? index % period : period - 1 - (-1 - index) % period;
    return inside < size ? inside : period - 1 - inside;
}

#if FILTER_EXACT
// IEC 61966-2-1 for code values 0..1. x^2.4 is x^2 times the fifth root of x^2, and two Newton steps correct pow():
// drivers may be off by 1e-3 in decoding formats, and by less in pow().
vec3 decodeSrgb(vec3 code)
{
    precise vec3 x = (code + 0.055) / 1.055;
    precise vec3 x2 = x * x;
    precise vec3 root = pow(x, vec3(0.4));
    for (int i = 0; i < 2; ++i) {
        precise vec3 power4 = (root * root) * (root * root);
        precise vec3 better = root - (power4 * root - x2) / (5.0 * power4);
        root = better;
    }
    precise vec3 curve = x2 * root;
    precise vec3 line = code / 12.92;
    return mix(curve, line, lessThanEqual(code, vec3(0.04045)));
}

// A texel as linear values; modes as in sampleFiltered().
vec4 linearTexel(sampler2D image, int x, int y, int modes)
{
    vec4 texel = texelFetch(image, ivec2(x, y), 0);
    if ((modes & TEXTURE_MODE_SRGB) != 0) texel.rgb = decodeSrgb(texel.rgb);
    return texel;
}
#endif

#if FILTER_EXACT && HAS_MIXED_FILTERS
// Whether the sampler uses nearest filtering, by the level of detail: log2 of the longer column of `change`, the change
// of the coordinate to the next pixels, in texels. Source: OpenGL 4.5 core, sections 8.14.1 and 8.15.
bool usesNearest(sampler2D image, dmat2 change, int modes)
{
    dvec2 size = dvec2(textureSize(image, 0));
    dvec2 right = change[0] * size, up = change[1] * size;
    double length2 = max(dot(right, right), dot(up, up));
    bool magnified = length2 <= ((modes & TEXTURE_MODE_HALF_LEVEL) != 0 ? 2.0 : 1.0);
    return (modes & (magnified ? TEXTURE_MODE_MAGNIFIES_NEAREST : TEXTURE_MODE_MINIFIES_NEAREST)) != 0;
}
#endif

// modes: MaterialConstants::uvRow1[slot].w; nearest: whether filtering is nearest, for `exact`.
vec4 sampleFiltered(sampler2D image, TexCoord uv, int modes, bool nearest)
{
#if FILTER_EXACT
    ivec2 size = textureSize(image, 0);
    precise dvec2 place = uv * dvec2(size) - (nearest ? 0.0 : 0.5);
    precise dvec2 corner = floor(place);
    precise vec2 weight = nearest ? vec2(0.0) : vec2(place - corner);
    int modeU = modes & 3;
    int modeV = (modes >> 2) & 3;
    int x0 = wrapTexel(int(corner.x), size.x, modeU);
    int x1 = wrapTexel(int(corner.x) + 1, size.x, modeU);
    int y0 = wrapTexel(int(corner.y), size.y, modeV);
    int y1 = wrapTexel(int(corner.y) + 1, size.y, modeV);
    // a + (b - a) w keeps equal texels to the last bit: a normal without length must not gain one.
    precise vec4 upperLeft = linearTexel(image, x0, y0, modes);
    precise vec4 lowerLeft = linearTexel(image, x0, y1, modes);
    precise vec4 upper = upperLeft + (linearTexel(image, x1, y0, modes) - upperLeft) * weight.x;
    precise vec4 lower = lowerLeft + (linearTexel(image, x1, y1, modes) - lowerLeft) * weight.x;
    precise vec4 texel = upper + (lower - upper) * weight.y;
    return texel;
#else
    return texture(image, uv);
#endif
}
