// Shades a procedural surface at every pixel with the renderer's loop over all lights; reads no G-buffer.
#include "bench/light_store.glsl"
#include "bench/bound_surface.glsl"
#include "lib/lighting/lighting.glsl"

layout(location = 0) out vec4 radiance;

void main()
{
    Viewpoint viewpoint = viewpointFromDepth(gl_FragCoord.xy, boundDepth(gl_FragCoord.xy));
    precise vec3 lit = shadeSurface(boundSurface(gl_FragCoord.xy, viewpoint), viewpoint, gl_FragCoord.xy);
    radiance = vec4(lit, 1.0);
}
