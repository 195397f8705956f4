// Reads the surfaces back from the G-buffer, in the form that store.frag takes them.
#include "lib/gbuffer.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };

void main()
{
    int i = int(gl_GlobalInvocationID.x);
    if (i * 5 >= outputs.length()) return;
    Surface surface = surfaceFromGBuffer(ivec2(i % WIDTH, i / WIDTH));
    outputs[i * 5] = vec4(surface.albedo, surface.metallic);
    outputs[i * 5 + 1] = vec4(surface.normalLS, surface.alpha);
    outputs[i * 5 + 2] = vec4(surface.specular, surface.iorOrF90);
    outputs[i * 5 + 3] = vec4(surface.emission, float(surface.model));
    outputs[i * 5 + 4] = vec4(surface.normalTexel, 0.0);
}
