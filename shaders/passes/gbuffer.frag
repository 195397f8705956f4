// Stores the visible surface of each pixel.
#define GBUFFER_WRITE
#include "lib/raster/rasterised.glsl"
#include "lib/raster/diffused_light.glsl"
#include "lib/raster/filmed.glsl"
#include "lib/gbuffer/gbuffer.glsl"

void main()
{
    Fragment fragment = rasterisedFragment();
    vec4 baseColor = materialBaseColor(fragment);
    Surface surface = surfaceFromMaterial(fragment, baseColor);
    takeDiffusedLight(fragment, surface);
    coverWithFilm(fragment, surface);
    if (materialCutOut(baseColor)) discard;
    writeGBuffer(surface);
}
