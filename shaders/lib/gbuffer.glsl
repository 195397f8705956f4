// The G-buffer's channels: how a surface is stored in them and read back.
// Which channels exist, at which attachment and in which encoding comes from the table kGBufferChannels
// (renderer/frame/GBufferLayout.h) as defines: GBUFFER_<NAME> is the attachment, GBUFFER_<NAME>_PACKED its encoding.
// GBUFFER_SPARE_COMPONENTS: metallic and alpha are the fourth components of albedo and normal.
// GBUFFER_WRITE declares the channels as outputs, otherwise they are textures.
#pragma once
#include "shared/slots.h"
#include "lib/surface.glsl"
#include "lib/gbuffer_encodings.glsl"

#ifdef GBUFFER_WRITE
#include "lib/gbuffer_write.glsl"
#else
#include "lib/gbuffer_read.glsl"
#endif
