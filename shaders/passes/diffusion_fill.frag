// Hands on the light of an object's texels, and fills those outside of charts, and where the rasteriser left a hole,
// with the light of the places where the surface goes on. Alpha says whether there is any.
#include "shared/slots.h"
#include "shared/diffusion.h"

layout(binding = TEXTURE_UNIT_DIFFUSION_STEPS) uniform sampler2D steps;
layout(binding = TEXTURE_UNIT_DIFFUSION_CONTINUED) uniform sampler2D continued;
#if STORES
layout(std140, binding = UNIFORM_PASS) uniform DiffusionStoreBlock
{
    DiffusionStoreConstants constants;
};
// What leaves the surface: the share that texels show as they are lit, and the sum of what has spread.
layout(binding = TEXTURE_UNIT_DIFFUSION_UNBLURRED) uniform sampler2D unblurred;
#if SUMS
layout(binding = TEXTURE_UNIT_DIFFUSION_LIGHT) uniform sampler2D sum;
#endif
#else
layout(binding = TEXTURE_UNIT_DIFFUSION_LIGHT) uniform sampler2D light;
#endif

layout(location = 0) out vec4 filled;

vec4 lightAt(ivec2 texel)
{
#if STORES && SUMS
    vec4 own = texelFetch(unblurred, texel, 0);
    precise vec3 both = own.rgb + texelFetch(sum, texel, 0).rgb;
    return vec4(both, own.a);
#elif STORES
    return texelFetch(unblurred, texel, 0);
#else
    return texelFetch(light, texel, 0);
#endif
}

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy);
#if STORES
    at -= ivec2(constants.store.xy);
#endif
    float chart = texelFetch(steps, at, 0).w;
    vec4 own = lightAt(at);
    filled = vec4(own.rgb, 1.0);
    if (chart > 0.0 && own.a > 0.0) return;
    filled = vec4(0.0);
    if (chart == 0.0) return;
    vec2 place = texelFetch(continued, at, 0).xy - 0.5;
    vec2 corner = floor(place);
    // A hole takes from its own tile alone.
    if (chart > 0.0) corner -= vec2(equal(at % DIFFUSION_TILE_TEXELS, ivec2(DIFFUSION_TILE_TEXELS - 1)));
    vec2 share = place - corner;
    // Of the four texels around it those in charts; at least the nearest one is near one.
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
}
