// Stores the measured lower bound's surface in a G-buffer for the product's passes.
#define GBUFFER_WRITE
#include "bench/bound_surface.glsl"
#include "lib/gbuffer/gbuffer.glsl"

void main()
{
    float depth = boundDepth(gl_FragCoord.xy);
    writeGBuffer(boundSurface(gl_FragCoord.xy, viewpointFromDepth(gl_FragCoord.xy, depth)));
    gl_FragDepth = depth;
}
