// One light direction on a surface of any model and layers. In: (albedo, metallic), (normal, alpha), (specular, ior or
// F90), (l, model), (v, exponent), (tangent, alpha along the bitangent), (coat normal, factor), (sheen colour, alpha),
// (coat alpha, masking, 0, 0).
// Out: (BRDF times cosine, n.l), (d, v, F.g, 0).
#include "lib/reflectance/reflectance.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i * 9u >= uint(inputs.length())) return;
    Surface surface;
    surface.albedo = inputs[i * 9u].rgb;
    surface.metallic = inputs[i * 9u].w;
    surface.normalLS = inputs[i * 9u + 1u].xyz;
    surface.alpha = inputs[i * 9u + 1u].w;
    surface.specular = inputs[i * 9u + 2u].rgb;
    surface.iorOrF90 = inputs[i * 9u + 2u].w;
    surface.model = uint(inputs[i * 9u + 3u].w);
    surface.parameter = inputs[i * 9u + 4u].w;
    surface.tangentLS = inputs[i * 9u + 5u].xyz;
    surface.alphaBitangent = inputs[i * 9u + 5u].w;
    surface.coatNormalCode = encodeOctahedral(inputs[i * 9u + 6u].xyz);
    surface.coatFactor = inputs[i * 9u + 6u].w;
    surface.sheenColor = inputs[i * 9u + 7u].rgb;
    surface.sheenAlpha = inputs[i * 9u + 7u].w;
    surface.coatAlpha = inputs[i * 9u + 8u].x;
    surface.masking = uint(inputs[i * 9u + 8u].y);
    surface.emission = vec3(0.0);
    surface.normalTexel = vec3(0.5, 0.5, 1.0);
    vec3 l = inputs[i * 9u + 3u].xyz;
    vec3 v = inputs[i * 9u + 4u].xyz;
    precise float nl = dot(surface.normalLS, l);
    SeenSurface seen = seenSurface(surface, v);
    SpecularTerms terms = reflection(seen, directionsOn(seen, l, nl)).terms;
    outputs[i * 2u] = vec4(layeredBrdfCosine(seen, l), nl);
    outputs[i * 2u + 1u] = vec4(terms.d, terms.v, terms.f.g, 0.0);
}
