// Linear radiance to display code values: exposure, tone map, sRGB transfer function. DISPLAY_MAPPING is one of
// DISPLAY_*, TONE_MAP one of TONEMAP_*; as defines, since a rasteriser that masks lanes would run all of them.
#include "shared/slots.h"
#include "shared/display.h"
#include "shared/face_colors.h"
#include "shared/faults.h"
#include "shared/heat.h"
#include "shared/tonemap.h"

layout(std140, binding = UNIFORM_PASS) uniform DisplayBlock
{
    DisplayConstants display;
};
layout(binding = TEXTURE_UNIT_RADIANCE) uniform sampler2D radianceImage;
layout(location = 0) out vec4 code;

// Neighbouring ids get very different colours; 0 is black.
vec3 colorOfIds(vec3 value)
{
    uvec3 ids = uvec3(value);
    uint mixed = (ids.x * 0x9E3779B1u ^ ids.y * 0x85EBCA6Bu ^ ids.z * 0xC2B2AE35u);
    mixed = (mixed ^ (mixed >> 15)) * 0x2C1B3C6Du;
    return vec3(uvec3(mixed >> 24, mixed >> 16, mixed >> 8) & 255u) / 255.0;
}

// Compresses 0..infinity. Source: Reinhard et al. 2002, "Photographic Tone Reproduction for Digital Images", eq. 3.
vec3 compressed(vec3 value)
{
    vec3 positive = max(value, 0.0);
    return encodeSrgb(positive / (1.0 + positive));
}

vec3 faultsOf(vec3 value)
{
    uvec3 bits = floatBitsToUint(value);
    int fault = max(faultOfBits(bits.x), max(faultOfBits(bits.y), faultOfBits(bits.z)));
    return fault == FAULT_NONE ? compressed(vec3(dot(value * display.exposure.x, vec3(0.2126, 0.7152, 0.0722))))
                               : faultColor(fault);
}

// Colour of a texel of the atlas as written by passes/shadow_atlas.frag.
vec3 atlasColor(vec4 value)
{
    if (value.a == 0.0) return vec3(0.0);
    if (value.b == 0.0) return vec3(0.12);
    vec3 color = faceColor(int(abs(value.b)) - 1);
    if (value.b < 0.0) return color;
    return value.r == 0.0 ? 0.2 * color : vec3(value.g);
}

vec3 codeValues(vec4 shown)
{
    vec3 value = shown.rgb;
#if DISPLAY_MAPPING == DISPLAY_RAW
    return value;
#elif DISPLAY_MAPPING == DISPLAY_SIGNED
    return value * 0.5 + 0.5;
#elif DISPLAY_MAPPING == DISPLAY_DISTANCE
    return vec3(10.0 / (10.0 + max(value, 0.0)));
#elif DISPLAY_MAPPING == DISPLAY_COUNT
    return heatColor(heatPositionOfCount(value.r, display.scales.x));
#elif DISPLAY_MAPPING == DISPLAY_IDS
    return colorOfIds(value);
#elif DISPLAY_MAPPING == DISPLAY_COMPRESSED
    return compressed(value * display.exposure.x);
#elif DISPLAY_MAPPING == DISPLAY_FAULTS
    return faultsOf(value);
#elif DISPLAY_MAPPING == DISPLAY_SHADOW_ATLAS
    return atlasColor(shown);
#else
    return encodeSrgb(toneMapped(value * display.exposure.x, TONE_MAP));
#endif
}

void main()
{
    vec4 value = texelFetch(radianceImage, ivec2(gl_FragCoord.xy), 0);
    code = vec4(codeValues(value), 1.0);
}
