// Reads every member of the shared structs, so that a driver keeps them all and reports their places.
#include "shared/display.h"
#include "shared/frame.h"
#include "shared/material.h"

layout(local_size_x = 64) in;
layout(std140, binding = UNIFORM_FRAME) uniform FrameBlock { FrameConstants frame; };
layout(std140, binding = UNIFORM_MATERIAL) uniform MaterialBlock { MaterialConstants material; };
layout(std140, binding = UNIFORM_DISPLAY) uniform DisplayBlock { DisplayConstants display; };
layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };

void main()
{
    if (gl_GlobalInvocationID.x > 0u) return;
    outputs[0] = frame.clipFromLS[0];
    outputs[1] = frame.clipFromLS[3];
    outputs[2] = frame.worldFromLS[0];
    outputs[3] = frame.worldFromLS[3];
    outputs[4] = frame.eyeLS;
    outputs[5] = frame.rayDxLS;
    outputs[6] = frame.rayDyLS;
    outputs[7] = frame.forwardLS;
    outputs[8] = frame.aheadFromDepth;
    outputs[9] = frame.background;
    outputs[10] = vec4(frame.lights);
    outputs[11] = material.baseColor;
    outputs[12] = material.emissive;
    outputs[13] = material.microsurface;
    outputs[14] = material.specular + material.dielectric;
    outputs[15] = vec4(material.kind);
    for (int slot = 0; slot < TEXTURE_SLOT_COUNT; ++slot) {
        outputs[16 + slot] = material.uvRow0[slot];
        outputs[16 + TEXTURE_SLOT_COUNT + slot] = material.uvRow1[slot];
    }
    outputs[16 + 2 * TEXTURE_SLOT_COUNT] = display.exposure;
    outputs[17 + 2 * TEXTURE_SLOT_COUNT] = vec4(display.mapping);
    outputs[18 + 2 * TEXTURE_SLOT_COUNT] = frame.lensVS;
    outputs[19 + 2 * TEXTURE_SLOT_COUNT] = vec4(frame.tileGrid);
    outputs[20 + 2 * TEXTURE_SLOT_COUNT] = frame.depthKey;
    outputs[21 + 2 * TEXTURE_SLOT_COUNT] = vec4(frame.sizePixels);
}
