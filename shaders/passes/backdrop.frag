// Draws the environment behind everything.
#include "shared/slots.h"
#include "lib/surface/camera.glsl"
#if BACKDROP_BLURRED
#include "lib/environment/filtered_map.glsl"
#else
#include "lib/environment/environment_map.glsl"
#endif

layout(location = 0) out vec4 radiance;

void main()
{
    precise vec3 ray = view.forwardLS.xyz;
    if (view.forwardLS.w == 0.0) ray += acrossOfPixel(gl_FragCoord.xy);
    vec3 direction = mapDirection(normalize(ray));
#if BACKDROP_BLURRED
    int level = int(filteredPlace(ENVIRONMENT_BACKDROP_ALPHA) + 0.5);
    vec3 seen = filteredLevel(encodeOctahedral(direction), level);
#else
    vec3 seen = mapRadiance(direction).rgb;
#endif
    radiance = vec4(seen * environmentIntensity(), 0.0);
}
