// The channels of the G-buffer: functions that store (put) and load (take) each of them, in both encodings.
// channelDefines() (renderer/frame/GBufferLayout.h) defines which exist, and where, as the list GBUFFER_CHANNELS of
//   EXACT_CHANNEL(put, take, attachment)
//   PACKED_CHANNEL(put, take, first bit, widths of its fields)
#pragma once
#include "lib/gbuffer/gbuffer_encodings.glsl"

// Encoding of a channel: an fp32 texel, or the next fields of the words. The texel is a function argument; compilers
// take long to split an array of texels.
struct Encoding {
    bool isPacked;
    ivec4 widths;
};
const Encoding kExact = Encoding(false, ivec4(0));

// fp32: the fourth component is metallic, used with GBUFFER_SPARE_COMPONENTS, or the occlusion code.
void putAlbedo(Encoding encoding, Surface surface, inout vec4 texel)
{
    if (encoding.isPacked)
        putRoots(surface.albedo, encoding.widths, DITHER_ALBEDO);
    else
#ifdef GBUFFER_OCCLUSION_IN_ALBEDO
        texel = vec4(surface.albedo, float(surface.openCode));
#else
        texel = vec4(surface.albedo, surface.metallic);
#endif
}

void takeAlbedo(Encoding encoding, vec4 texel, inout Surface surface)
{
    if (encoding.isPacked) {
        surface.albedo = takeRoots(encoding.widths);
        return;
    }
    surface.albedo = texel.rgb;
#ifdef GBUFFER_SPARE_COMPONENTS
    surface.metallic = texel.a;
#endif
#ifdef GBUFFER_OCCLUSION_IN_ALBEDO
    surface.openCode = uint(texel.a);
#endif
}

#ifdef GBUFFER_MATERIAL_NUMBER
// The normal's code, then the number of the material.
void putNormal(Encoding encoding, Surface surface, inout vec4 texel)
{
    putField(surface.normalCode.shares.x, encoding.widths.x);
    putField(surface.normalCode.shares.y, encoding.widths.y);
    putField(surface.normalCode.axis, encoding.widths.z);
    putField(surface.material, encoding.widths.w);
}

void takeNormal(Encoding encoding, vec4 texel, inout Surface surface)
{
    NormalCode code;
    code.shares.x = takeField(encoding.widths.x);
    code.shares.y = takeField(encoding.widths.y);
    code.axis = takeField(encoding.widths.z);
    surface.normalLS = decodeNormal(code);
    surface.material = takeField(encoding.widths.w);
}
#else
// fp32: the fourth component is alpha, used with GBUFFER_SPARE_COMPONENTS, or the lift code.
void putNormal(Encoding encoding, Surface surface, inout vec4 texel)
{
    if (encoding.isPacked)
        putOctahedral(encodeOctahedral(surface.normalLS), encoding.widths, DITHER_NORMAL);
    else
#ifdef GBUFFER_LIFT_IN_NORMAL
        texel = vec4(surface.normalLS, float(surface.liftCode));
#else
        texel = vec4(surface.normalLS, surface.alpha);
#endif
}

void takeNormal(Encoding encoding, vec4 texel, inout Surface surface)
{
    if (encoding.isPacked) {
        surface.normalLS = decodeOctahedral(takeOctahedral(encoding.widths));
        return;
    }
    surface.normalLS = texel.xyz;
#ifdef GBUFFER_SPARE_COMPONENTS
    surface.alpha = texel.w;
#endif
#ifdef GBUFFER_LIFT_IN_NORMAL
    surface.liftCode = uint(texel.w);
#endif
}
#endif

// fp32: alpha, model, ior or F90, metallic. A model with one parameter stores it in place of ior; a microfacet model
// stores its masking-shadowing option in place of metallic. Packed: model and masking-shadowing option, then alpha, F90
// and metallic. A microfacet model has its ior in the last two fields; a model with one parameter has it in all three.
void putMicrosurface(Encoding encoding, Surface surface, inout vec4 texel)
{
    bool hasParameter = HAS_PARAMETER(surface.model), isMicrofacet = IS_MICROFACET(surface.model);
    if (!encoding.isPacked) {
        float third = hasParameter ? surface.parameter : surface.iorOrF90, fourth = surface.metallic;
#if HAS_MASKING_OPTIONS
        if (isMicrofacet) fourth = float(surface.masking);
#endif
        texel = vec4(surface.alpha, float(surface.model), third, fourth);
        return;
    }
    ivec4 widths = encoding.widths;
    int tail = widths.z + widths.w;
    putField(encodeKind(surface), widths.x);
    if (hasParameter) {
        putField(encodeFloat(surface.parameter, widths.y + tail, DITHER_ALPHA), widths.y + tail);
        return;
    }
    putField(encodeAlpha(surface.alpha, widths.y, DITHER_ALPHA), widths.y);
    uint code;
    if (isMicrofacet) {
        code = encodeIor(surface.iorOrF90, tail, DITHER_F90);
    } else {
        code = encodeShare(surface.iorOrF90, largestCode(widths.z), DITHER_F90) |
               (encodeShare(surface.metallic, largestCode(widths.w), DITHER_METALLIC) << widths.z);
    }
    putField(code, tail);
}

void takeExactMicrosurface(vec4 texel, inout Surface surface)
{
    surface.alpha = texel.x;
    surface.model = surfaceModel(uint(texel.y));
    surface.iorOrF90 = texel.z;
    surface.metallic = texel.w;
    if (HAS_PARAMETER(surface.model)) {
        surface.parameter = texel.z;
        surface.iorOrF90 = 1.0;
    }
#if HAS_MASKING_OPTIONS
    if (IS_MICROFACET(surface.model)) {
        surface.masking = uint(texel.w);
        surface.metallic = 0.0;
    }
#endif
}

void takePackedMicrosurface(ivec4 widths, inout Surface surface)
{
    decodeKind(takeField(widths.x), surface);
    int tail = widths.z + widths.w;
    uint code = takeField(widths.y + tail);
    if (HAS_PARAMETER(surface.model)) {
        surface.parameter = decodeFloat(code, widths.y + tail);
        return;
    }
    surface.alpha = decodeAlpha(code & largestCode(widths.y), widths.y);
    code >>= widths.y;
    if (IS_MICROFACET(surface.model)) {
        surface.iorOrF90 = decodeIor(code, tail);
    } else {
        surface.iorOrF90 = decodeShare(code & largestCode(widths.z), largestCode(widths.z));
        surface.metallic = decodeShare(code >> widths.z, largestCode(widths.w));
    }
}

void takeMicrosurface(Encoding encoding, vec4 texel, inout Surface surface)
{
    if (encoding.isPacked)
        takePackedMicrosurface(encoding.widths, surface);
    else
        takeExactMicrosurface(texel, surface);
    surface.specular = defaultSpecular(surface.model); // unless a channel stores it
}

void putSpecular(Encoding encoding, Surface surface, inout vec4 texel)
{
    if (encoding.isPacked)
        putRoots(surface.specular, encoding.widths, DITHER_SPECULAR);
    else
#ifdef GBUFFER_FACETS_IN_SPECULAR
        texel = vec4(surface.specular, float(surface.facetCode)); // 24 bits, which fp32 holds
#else
        texel = vec4(surface.specular, 0.0);
#endif
}

void takeSpecular(Encoding encoding, vec4 texel, inout Surface surface)
{
    surface.specular = encoding.isPacked ? takeRoots(encoding.widths) : texel.rgb;
#ifdef GBUFFER_FACETS_IN_SPECULAR
    surface.facetNormalLS = decodeFacet(uint(texel.w));
#endif
}

void putEmission(Encoding encoding, Surface surface, inout vec4 texel)
{
    if (encoding.isPacked)
        putRadiance(surface.emission, encoding.widths);
    else
#ifdef GBUFFER_SUBSURFACE_IN_EMISSION
        texel = vec4(surface.emission, float(surface.subsurface));
#else
        texel = vec4(surface.emission, 0.0);
#endif
}

void takeEmission(Encoding encoding, vec4 texel, inout Surface surface)
{
    surface.emission = encoding.isPacked ? takeRadiance(encoding.widths) : texel.rgb;
#ifdef GBUFFER_SUBSURFACE_IN_EMISSION
    surface.subsurface = uint(texel.w);
#endif
}

void putNormalTexel(Encoding encoding, Surface surface, inout vec4 texel)
{
    if (encoding.isPacked)
        putTexel(surface.normalTexel, encoding.widths);
    else
        texel = vec4(surface.normalTexel, 0.0);
}

void takeNormalTexel(Encoding encoding, vec4 texel, inout Surface surface)
{
    surface.normalTexel = encoding.isPacked ? takeTexel(encoding.widths) : texel.rgb;
}

#if HAS_TANGENT_FRAME
void putTangent(Encoding encoding, Surface surface, inout vec4 texel)
{
    if (!encoding.isPacked) {
        texel = vec4(surface.tangentLS, surface.alphaBitangent);
        return;
    }
    putDirectionAcross(surface.normalLS, surface.tangentLS, encoding.widths);
    putField(encodeAlpha(surface.alphaBitangent, encoding.widths.z, DITHER_ALPHA), encoding.widths.z);
}

void takeTangent(Encoding encoding, vec4 texel, inout Surface surface)
{
    if (!encoding.isPacked) {
        surface.tangentLS = texel.xyz;
        surface.alphaBitangent = texel.w;
        return;
    }
    surface.tangentLS = takeDirectionAcross(surface.normalLS, encoding.widths);
    surface.alphaBitangent = decodeAlpha(takeField(encoding.widths.z), encoding.widths.z);
}
#endif

#if HAS_CLEARCOAT
void putClearcoat(Encoding encoding, Surface surface, inout vec4 texel)
{
    if (!encoding.isPacked) {
        texel = vec4(surface.coatNormalCode, surface.coatFactor, surface.coatAlpha);
        return;
    }
    putOctahedral(surface.coatNormalCode, encoding.widths, DITHER_NOT);
    putField(encodeShare(surface.coatFactor, largestCode(encoding.widths.z), DITHER_COAT), encoding.widths.z);
    putField(encodeAlpha(surface.coatAlpha, encoding.widths.w, DITHER_COAT_ALPHA), encoding.widths.w);
}

void takeClearcoat(Encoding encoding, vec4 texel, inout Surface surface)
{
    if (!encoding.isPacked) {
        surface.coatNormalCode = texel.xy;
        surface.coatFactor = texel.z;
        surface.coatAlpha = texel.w;
        return;
    }
    surface.coatNormalCode = takeOctahedral(encoding.widths);
    surface.coatFactor = decodeShare(takeField(encoding.widths.z), largestCode(encoding.widths.z));
    surface.coatAlpha = decodeAlpha(takeField(encoding.widths.w), encoding.widths.w);
}
#endif

#if HAS_SHEEN
void putSheen(Encoding encoding, Surface surface, inout vec4 texel)
{
    if (!encoding.isPacked) {
        texel = vec4(surface.sheenColor, surface.sheenAlpha);
        return;
    }
    putRoots(surface.sheenColor, encoding.widths, DITHER_SHEEN);
    putField(encodeAlpha(surface.sheenAlpha, encoding.widths.w, DITHER_SHEEN_ALPHA), encoding.widths.w);
}

void takeSheen(Encoding encoding, vec4 texel, inout Surface surface)
{
    if (!encoding.isPacked) {
        surface.sheenColor = texel.rgb;
        surface.sheenAlpha = texel.a;
        return;
    }
    surface.sheenColor = takeRoots(encoding.widths);
    surface.sheenAlpha = decodeAlpha(takeField(encoding.widths.w), encoding.widths.w);
}
#endif
