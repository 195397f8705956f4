// Stores a surface in the channels of the G-buffer and reads it back. channelTable() (renderer/frame/GBufferLayout.h)
// defines which channels exist, where and in which encoding; lib/gbuffer/gbuffer_channels.glsl defines their contents.
// An fp32 channel has the attachment GBUFFER_<NAME>, one of GBUFFER_EXACT_CHANNELS. The fields of the others lie end to
// end in GBUFFER_WORDS words, from the bit GBUFFER_<NAME> on, GBUFFER_<NAME>_WIDTHS bits wide; the words are in
// attachments from GBUFFER_WORD_TEXTURE on, four in each, then two, then one. GBUFFER_SPARE_COMPONENTS: metallic and
// alpha are the fourth components of albedo and normal. GBUFFER_MATERIAL_NUMBER: the fields of the normal are its code
// and the number of the material, whose values are read from the table of all materials. GBUFFER_MARKS: attachment of
// one or two words with the integers of lib/gbuffer/gbuffer_marks.glsl. GBUFFER_FACETS_IN_SPECULAR,
// GBUFFER_LIFT_IN_NORMAL, GBUFFER_SUBSURFACE_IN_EMISSION and GBUFFER_OCCLUSION_IN_ALBEDO store them in the fourth
// components of those channels instead. GBUFFER_WRITE declares the channels as outputs, otherwise they are textures.
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
