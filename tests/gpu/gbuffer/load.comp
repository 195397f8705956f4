// Reads the surfaces back from the G-buffer, in the layout that store.frag reads.
#include "lib/gbuffer/gbuffer.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };

void main()
{
    int i = int(gl_GlobalInvocationID.x);
    if (i * 9 >= outputs.length()) return;
    Surface surface = surfaceFromGBuffer(ivec2(i % WIDTH, i / WIDTH));
    outputs[i * 9] = vec4(surface.albedo, surface.metallic);
    outputs[i * 9 + 1] = vec4(surface.normalLS, surface.alpha);
    outputs[i * 9 + 2] = vec4(surface.specular, surface.iorOrF90);
    outputs[i * 9 + 3] = vec4(surface.emission, float(surface.model));
    outputs[i * 9 + 4] = vec4(surface.normalTexel, surface.parameter);
    outputs[i * 9 + 5] = vec4(surface.tangentLS, surface.alphaBitangent);
    outputs[i * 9 + 6] = vec4(surface.coatNormalCode, surface.coatFactor, surface.coatAlpha);
    outputs[i * 9 + 7] = vec4(surface.sheenColor, surface.sheenAlpha);
    outputs[i * 9 + 8] = vec4(float(surface.masking), 0.0, 0.0, 0.0);
}
