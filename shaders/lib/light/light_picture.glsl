// Light textures of area lights: look-ups averaged over a lobe, from Gaussian levels (shared/light_pictures.h). Source:
// Heitz, Dupuy, Hill, Neubelt 2016, "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines", section 5,
// with other Gaussians, and looked up near the light's mean position (area_picture.glsl).
#pragma once
#include "shared/slots.h"
#include "shared/light_pictures.h"

layout(binding = TEXTURE_UNIT_LIGHT_PICTURES) uniform samplerBuffer lightPictureTexels;

vec3 lightPictureMean(int picture)
{
    return texelFetch(lightPictureTexels, picture * LIGHT_PICTURE_HEADER_TEXELS).rgb;
}

// Variances of surface positions along the light's two axes.
vec2 lightPictureVariances(int picture)
{
    return texelFetch(lightPictureTexels, picture * LIGHT_PICTURE_HEADER_TEXELS + LIGHT_PICTURE_VARIANCES).xy;
}

// a + share (b - a) is exactly a if both are equal.
vec3 mixedFactor(vec3 a, vec3 b, float share)
{
    precise vec3 mixed = a + share * (b - a);
    return mixed;
}

// Bilinear look-up in a level; `place`: x from the left and y from the top, 0..1.
vec3 lightPictureLevel(int picture, int level, vec2 place)
{
    vec4 record = texelFetch(lightPictureTexels, picture * LIGHT_PICTURE_HEADER_TEXELS + LIGHT_PICTURE_FIRST_LEVEL + level);
    precise vec2 fromCentre = clamp(place * record.yz - 0.5, vec2(0.0), record.yz - 1.0);
    ivec2 size = ivec2(record.yz);
    ivec2 least = ivec2(fromCentre);
    ivec2 most = min(least + 1, size - 1);
    precise vec2 share = fromCentre - vec2(least);
    int above = int(record.x) + least.y * size.x, below = int(record.x) + most.y * size.x;
    vec3 top = mixedFactor(texelFetch(lightPictureTexels, above + least.x).rgb,
                           texelFetch(lightPictureTexels, above + most.x).rgb, share.x);
    vec3 bottom = mixedFactor(texelFetch(lightPictureTexels, below + least.x).rgb,
                              texelFetch(lightPictureTexels, below + most.x).rgb, share.x);
    return mixedFactor(top, bottom, share.y);
}

// Look-up filtered by a Gaussian; `deviation` is relative to the texture's sides.
vec3 lightPictureFiltered(int picture, vec2 place, float deviation)
{
    vec4 header = texelFetch(lightPictureTexels, picture * LIGHT_PICTURE_HEADER_TEXELS);
    int levels = int(texelFetch(lightPictureTexels, picture * LIGHT_PICTURE_HEADER_TEXELS + LIGHT_PICTURE_FIRST_LEVEL).w);
    precise float texels = deviation * header.a;
    precise float wanted = texels < 1.0 ? texels : 1.0 + log2(texels);
    if (!(wanted < float(levels - 1))) return lightPictureLevel(picture, levels - 1, place);
    int level = int(wanted);
    vec3 sharper = lightPictureLevel(picture, level, place);
    vec3 smoother = lightPictureLevel(picture, level + 1, place);
    return mixedFactor(sharper, smoother, wanted - float(level));
}
