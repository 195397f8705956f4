// Reads every member of the shared structs, so that a driver keeps them all and reports their offsets.
#include "shared/display.h"
#include "shared/frame.h"
#include "shared/material.h"

layout(local_size_x = 64) in;
layout(std140, binding = UNIFORM_VIEW) uniform ViewBlock { ViewConstants view; };
layout(std140, binding = UNIFORM_LIGHTING) uniform LightingBlock { LightingConstants lighting; };
layout(std140, binding = UNIFORM_MATERIAL) uniform MaterialBlock { MaterialConstants material; };
layout(std140, binding = UNIFORM_PASS) uniform DisplayBlock { DisplayConstants display; };
layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };

void main()
{
    if (gl_GlobalInvocationID.x > 0u) return;
    outputs[0] = view.clipFromLS[0];
    outputs[1] = view.clipFromLS[3];
    outputs[2] = view.worldFromLS[0];
    outputs[3] = view.worldFromLS[3];
    outputs[4] = view.eyeLS;
    outputs[5] = view.rayDxLS;
    outputs[6] = view.rayDyLS;
    outputs[7] = view.forwardLS;
    outputs[8] = view.aheadFromDepth;
    outputs[9] = view.background;
    outputs[10] = vec4(lighting.lights);
    outputs[11] = material.baseColor;
    outputs[12] = material.emissive;
    outputs[13] = material.microsurface;
    outputs[14] = material.specular + material.mixed;
    outputs[15] = vec4(material.kind);
    for (int slot = 0; slot < TEXTURE_SLOT_COUNT; ++slot) {
        outputs[16 + slot] = material.uvRow0[slot];
        outputs[16 + TEXTURE_SLOT_COUNT + slot] = material.uvRow1[slot];
    }
    outputs[16 + 2 * TEXTURE_SLOT_COUNT] = display.exposure;
    outputs[17 + 2 * TEXTURE_SLOT_COUNT] = view.rayFromPixel;
    outputs[18 + 2 * TEXTURE_SLOT_COUNT] = vec4(lighting.tileGrid);
    outputs[19 + 2 * TEXTURE_SLOT_COUNT] = view.depthKey;
    outputs[20 + 2 * TEXTURE_SLOT_COUNT] = vec4(view.sizePixels);
    outputs[21 + 2 * TEXTURE_SLOT_COUNT] = vec4(lighting.slices);
    outputs[22 + 2 * TEXTURE_SLOT_COUNT] = display.scales;
}
