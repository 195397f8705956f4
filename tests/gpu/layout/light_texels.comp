// The light texels as they are fetched, four a light.
#include "lib/light.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };

void main()
{
    int i = int(gl_GlobalInvocationID.x);
    if (i * LIGHT_TEXELS >= outputs.length()) return;
    for (int texel = 0; texel < LIGHT_TEXELS; ++texel) {
        outputs[i * LIGHT_TEXELS + texel] = texelFetch(lightTexels, i * LIGHT_TEXELS + texel);
    }
}
