// Culling bounds of the lights, and the rows and columns of tiles that each may touch.
#pragma once
#include "lib/surface/camera.glsl"
#include "shared/culling.h"
#include "shared/light_lists.h"

layout(binding = TEXTURE_UNIT_CULL_LIGHTS) uniform samplerBuffer cullLightTexels;

#define CULL_LIGHT_TEXELS 3

vec4 cullSphere(uint light)
{
    return texelFetch(cullLightTexels, int(light) * CULL_LIGHT_TEXELS);
}

CullLight cullLight(uint light)
{
    int at = int(light) * CULL_LIGHT_TEXELS;
    CullLight cull;
    cull.sphere = texelFetch(cullLightTexels, at);
    cull.apex = texelFetch(cullLightTexels, at + 1);
    cull.axis = texelFetch(cullLightTexels, at + 2);
    return cull;
}

uint lightCount()
{
    return lighting.lights.x;
}

// Lights of this round, x the first, y one beyond the last. There is a single round if it holds all lights.
layout(std140, binding = UNIFORM_PASS) uniform ListRound
{
    uvec4 listRound;
};

bool isFirstRound()
{
    return listRound.x == 0u;
}

bool isLastRound()
{
    return listRound.y == lightCount();
}

// Bounds of the rays of a tile.
vec4 raysOfTile(uint column, uint row)
{
    return tileRays(view.rayFromPixel, column, row, 1u << lighting.tileGrid.w, view.sizePixels);
}

// Whether a run of columns or rows, first | last << 16, overlaps first..last.
bool reaches(uint run, uint first, uint last)
{
    return (run & 0xffffu) <= last && (run >> 16) >= first;
}
