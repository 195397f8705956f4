// The light texels as fetched, with as many vec4 per light as in C++.
#include "bench/light_store.glsl"
#include "lib/light/light.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };

#if HAS_POLYGON_LIGHTS
const int kShapeTexels = LIGHT_SHAPE_TEXELS + LIGHT_CORNER_TEXELS;
#else
const int kShapeTexels = LIGHT_SHAPE_TEXELS;
#endif

void main()
{
    int i = int(gl_GlobalInvocationID.x);
    int first = i * (LIGHT_TEXELS + kShapeTexels);
    if (first >= outputs.length()) return;
    for (int texel = 0; texel < LIGHT_TEXELS; ++texel) outputs[first + texel] = lightTexel(i, texel);
    for (int texel = 0; texel < kShapeTexels; ++texel) outputs[first + LIGHT_TEXELS + texel] = lightShapeTexel(i, texel);
}
