// One instance per light: two triangles over the part of the image in which its surface may be visible.
#include "shared/slots.h"
#include "shared/seen_lights.h"

layout(binding = TEXTURE_UNIT_SEEN_LIGHTS) uniform samplerBuffer seenLightTexels;
layout(location = 0) flat out int light;

void main()
{
    light = gl_InstanceID;
    vec4 window = texelFetch(seenLightTexels, gl_InstanceID * SEEN_LIGHT_TEXELS);
    int corner = gl_VertexID < 3 ? gl_VertexID : 6 - gl_VertexID; // 0 1 2, 3 2 1
    gl_Position = vec4((corner & 1) != 0 ? window.z : window.x, (corner & 2) != 0 ? window.w : window.y, 0.0, 1.0);
}
