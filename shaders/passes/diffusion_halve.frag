// Halves the resolution: the mean of those of four texels that hold light.
#include "shared/diffusion.h"

layout(binding = TEXTURE_UNIT_DIFFUSION_LIGHT) uniform sampler2D light;
layout(binding = TEXTURE_UNIT_DIFFUSION_UNDIFFUSED) uniform sampler2D undiffused;

layout(location = 0) out vec4 halvedLight;
layout(location = 1) out vec4 halvedUndiffused;

vec4 halvedOf(sampler2D whole)
{
    precise vec4 all = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        vec4 own = texelFetch(whole, 2 * ivec2(gl_FragCoord.xy) + ivec2(i & 1, i >> 1), 0);
        if (own.a > 0.0) all += vec4(own.rgb, 1.0);
    }
    return all.a > 0.0 ? vec4(all.rgb / all.a, 1.0) : vec4(0.0);
}

void main()
{
    halvedLight = halvedOf(light);
    halvedUndiffused = halvedOf(undiffused);
}
