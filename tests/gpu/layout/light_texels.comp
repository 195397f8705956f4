// The light texels as they are fetched, four vec4 a light as C++ has them.
#include "bench/light_store.glsl"
#include "lib/light/light.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };

void main()
{
    int i = int(gl_GlobalInvocationID.x);
    if (i * 4 >= outputs.length()) return;
    for (int texel = 0; texel < 2; ++texel) {
        outputs[i * 4 + texel] = lightTexel(i, texel);
        outputs[i * 4 + 2 + texel] = lightShapeTexel(i, texel);
    }
}
