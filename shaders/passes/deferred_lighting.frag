// Fragment entry of lib/deferred_lighting.glsl.
#include "lib/deferred_lighting.glsl"

layout(location = 0) out vec4 radiance;

void main()
{
    radiance = deferredRadiance(ivec2(gl_FragCoord.xy));
}
