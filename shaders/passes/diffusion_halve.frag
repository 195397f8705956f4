// Halves the resolution: the mean of those texels of four that hold light.
#include "shared/diffusion.h"

layout(binding = TEXTURE_UNIT_DIFFUSION_LIGHT) uniform sampler2D light;

layout(location = 0) out vec4 halved;

void main()
{
    precise vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        vec4 own = texelFetch(light, 2 * ivec2(gl_FragCoord.xy) + ivec2(i & 1, i >> 1), 0);
        if (own.a > 0.0) sum += vec4(own.rgb, 1.0);
    }
    halved = sum.a > 0.0 ? vec4(sum.rgb / sum.a, 1.0) : vec4(0.0);
}
