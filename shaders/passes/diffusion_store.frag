// Stores the light leaving an object in its atlas cell; texels outside charts get it from where the surface continues.
#include "passes/filled_light.glsl"

layout(std140, binding = UNIFORM_PASS) uniform DiffusionStoreBlock
{
    DiffusionStoreConstants constants;
};

// Light that leaves the surface: undiffused light, and the sum of diffused light.
layout(binding = TEXTURE_UNIT_DIFFUSION_UNDIFFUSED) uniform sampler2D undiffused;
#if SUMS
layout(binding = TEXTURE_UNIT_DIFFUSION_LIGHT) uniform sampler2D sum;
#endif

layout(location = 0) out vec4 stored;

vec4 lightAt(ivec2 texel)
{
    vec4 own = texelFetch(undiffused, texel, 0);
#if SUMS
    precise vec3 both = own.rgb + texelFetch(sum, texel, 0).rgb;
    return vec4(both, own.a);
#else
    return own;
#endif
}

void main()
{
    stored = filledLightAt(ivec2(gl_FragCoord.xy) - ivec2(constants.store.xy));
}
