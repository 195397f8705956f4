// Writes the neutral surface over other values of every member. In: those values. Out: eight vec4.
#include "lib/surface/surface.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(inputs.length())) return;
    vec3 before = inputs[i].xyz;
    Surface surface;
    surface.model = uint(before.x);
    surface.albedo = surface.specular = surface.emission = surface.normalLS = surface.normalTexel = before;
    surface.metallic = surface.alpha = surface.iorOrF90 = surface.parameter = before.x;
    surface.masking = uint(before.x);
    surface.tangentLS = surface.sheenColor = before;
    surface.coatNormalCode = before.xy;
    surface.alphaBitangent = surface.coatFactor = surface.coatAlpha = surface.sheenAlpha = before.x;
    setNeutralValues(surface);
    outputs[i * 8u] = vec4(surface.albedo, surface.metallic);
    outputs[i * 8u + 1u] = vec4(surface.normalLS, surface.alpha);
    outputs[i * 8u + 2u] = vec4(surface.specular, surface.iorOrF90);
    outputs[i * 8u + 3u] = vec4(surface.emission, float(surface.model));
    outputs[i * 8u + 4u] = vec4(surface.normalTexel, surface.parameter);
    outputs[i * 8u + 5u] = vec4(surface.tangentLS, surface.alphaBitangent);
    outputs[i * 8u + 6u] = vec4(surface.coatNormalCode, surface.coatFactor, surface.coatAlpha);
    outputs[i * 8u + 7u] = vec4(surface.sheenColor, surface.sheenAlpha);
}
