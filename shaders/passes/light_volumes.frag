// Light of one volume, blended additively onto the pixel. Alpha stays: the pixel is covered already.
#include "shared/slots.h"
#include "lib/gbuffer/gbuffer.glsl"
#include "lib/lighting/views.glsl"

layout(binding = TEXTURE_UNIT_DEPTH) uniform sampler2D depthChannel;
layout(location = 0) flat in int light;
layout(location = 0) out vec4 radiance;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    Surface surface = surfaceFromGBuffer(pixel);
    if (!isLit(surface)) discard;
    Viewpoint viewpoint = viewpointFromDepth(gl_FragCoord.xy, texelFetch(depthChannel, pixel, 0).r);
    precise vec3 given = vec3(0.0); // the blending adds
    SeenSurface seen = seenSurface(surface, viewpoint.toViewerLS);
    prepareForLights(seen);
    vec3 passed = vec3(0.0);
    addLightOnSurface(light, true, seen, viewpoint, given, passed);
    radiance = vec4(given, 0.0);
}
