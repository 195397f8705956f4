// The G-buffer: how a surface is stored in its channels and read back.
// Which channels exist, where and in which encoding comes from the table channelTable() (renderer/frame/GBufferLayout.h) as
// defines; lib/gbuffer/gbuffer_channels.glsl defines their contents. A channel in fp32 has the attachment GBUFFER_<NAME>, one
// of GBUFFER_EXACT_CHANNELS. The fields of the others lie end to end in GBUFFER_WORDS words, from the bit
// GBUFFER_<NAME> on, GBUFFER_<NAME>_WIDTHS bits wide; the words are in attachments from GBUFFER_WORD_TEXTURE on, four,
// then two, then one of them in each. GBUFFER_SPARE_COMPONENTS: metallic and alpha are the fourth components of albedo
// and normal. GBUFFER_MATERIAL_NUMBER: the fields of the normal are its code and the number of the material, whose values
// are read from the table of all materials. GBUFFER_MARKS is the attachment of a word or two with the marks of
// lib/gbuffer/gbuffer_marks.glsl. GBUFFER_FACETS_IN_SPECULAR, GBUFFER_SUBSURFACE_IN_EMISSION and
// GBUFFER_OCCLUSION_IN_ALBEDO put them into the fourth components of those channels.
// GBUFFER_WRITE declares the channels as outputs, otherwise they are textures.
#pragma once
#include "shared/slots.h"
#include "lib/surface/surface.glsl"
#include "lib/gbuffer/gbuffer_channels.glsl"
#include "lib/gbuffer/gbuffer_marks.glsl"

#ifdef GBUFFER_WRITE
#include "lib/gbuffer/gbuffer_write.glsl"
#else
#include "lib/gbuffer/gbuffer_read.glsl"
#endif
