// Light of an object's texels; outside charts, and where the rasteriser left a hole, the light from where the surface
// continues. The including file defines lightAt(), whose alpha is 0 where there is no light.
#pragma once
#include "shared/slots.h"
#include "shared/diffusion.h"

layout(binding = TEXTURE_UNIT_DIFFUSION_STEPS) uniform sampler2D steps;
layout(binding = TEXTURE_UNIT_DIFFUSION_CONTINUED) uniform sampler2D continued;

vec4 lightAt(ivec2 texel);

vec4 filledLightAt(ivec2 at)
{
    float chart = texelFetch(steps, at, 0).w;
    vec4 own = lightAt(at);
    if (chart > 0.0 && own.a > 0.0) return vec4(own.rgb, 1.0);
    vec4 filled = vec4(0.0);
    if (chart == 0.0) return filled;
    vec2 place = texelFetch(continued, at, 0).xy - 0.5;
    vec2 corner = floor(place);
    // A hole reads from its own tile only.
    if (chart > 0.0) corner -= vec2(equal(at % DIFFUSION_TILE_TEXELS, ivec2(DIFFUSION_TILE_TEXELS - 1)));
    vec2 share = place - corner;
    // Bilinear over those of the four texels that lie in charts; a minimum weight, in case only a far one does.
    precise vec3 lit = vec3(0.0);
    precise float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 step = ivec2(i & 1, i >> 1);
        ivec2 texel = clamp(ivec2(corner) + step, ivec2(0), textureSize(steps, 0) - 1);
        vec4 there = lightAt(texel);
        if (texelFetch(steps, texel, 0).w <= 0.0 || there.a == 0.0) continue;
        vec2 weight = mix(1.0 - share, share, vec2(step));
        precise float product = max(weight.x * weight.y, 1e-6);
        lit += product * there.rgb;
        weights += product;
    }
    if (weights > 0.0) filled = vec4(lit / weights, 1.0);
    return filled;
}
