#pragma once
// Where everything is bound. One list for C++ and GLSL; a number stands here and nowhere else.
#include "interop.h"

SHARED_BEGIN

// Vertex attributes. The first group advances per vertex, the second per draw (baseInstance selects the draw).
#define ATTRIBUTE_POSITION 0
#define ATTRIBUTE_NORMAL 1
#define ATTRIBUTE_TANGENT 2
#define ATTRIBUTE_TEXCOORD0 3
#define ATTRIBUTE_TEXCOORD1 4
#define ATTRIBUTE_COLOR 5
#define ATTRIBUTE_DRAW_POSITION_ROW0 6
#define ATTRIBUTE_DRAW_NORMAL_ROW0 9

// Uniform blocks.
#define UNIFORM_VIEW 0
#define UNIFORM_MATERIAL 1
#define UNIFORM_DISPLAY 2
#define UNIFORM_LIGHTS 3
#define UNIFORM_LIGHT_SHAPES 4
#define UNIFORM_LIST_ROUND 5
#define UNIFORM_LIGHTING 6

// Storage blocks. OpenGL 4.5 guarantees 0 to 7; shaders that build light lists never read lights from storage blocks.
#define STORAGE_LIGHT_TILES 0
#define STORAGE_LIGHT_CELLS 1
#define STORAGE_LIGHT_ENTRIES 2
#define STORAGE_LIGHT_REACH 3
#define STORAGE_TILE_DEPTHS 4
#define STORAGE_TILE_COUNTS 5
#define STORAGE_LIST_TOTALS 6
#define STORAGE_LIGHT_SHAPES 6
#define STORAGE_LIGHTS 7

// Texture units: the slots of scenes::TextureSlot in that order, then what passes read. OpenGL 4.5 guarantees 96 units,
// of which one stage may use 16; a material that fills every slot, lit from light lists, needs 18, and drivers
// offer 32.
#define TEXTURE_SLOT_BASE_COLOR 0
#define TEXTURE_SLOT_NORMAL 1
#define TEXTURE_SLOT_METALLIC_ROUGHNESS 2
#define TEXTURE_SLOT_EMISSIVE 3
#define TEXTURE_SLOT_SPECULAR_FACTOR 4
#define TEXTURE_SLOT_SPECULAR_COLOR 5
#define TEXTURE_SLOT_IOR 6
#define TEXTURE_SLOT_ANISOTROPY 7
#define TEXTURE_SLOT_CLEARCOAT 8
#define TEXTURE_SLOT_CLEARCOAT_ROUGHNESS 9
#define TEXTURE_SLOT_CLEARCOAT_NORMAL 10
#define TEXTURE_SLOT_SHEEN_COLOR 11
#define TEXTURE_SLOT_SHEEN_ROUGHNESS 12
#define TEXTURE_SLOT_COUNT 13
#define TEXTURE_UNIT_GBUFFER 24 // to 31
#define TEXTURE_UNIT_DEPTH 13
#define TEXTURE_UNIT_LIGHTS 14
#define TEXTURE_UNIT_RADIANCE 15
#define TEXTURE_UNIT_LIGHT_SHAPES 19
#define TEXTURE_UNIT_LIGHT_TILES 16
#define TEXTURE_UNIT_LIGHT_CELLS 17
#define TEXTURE_UNIT_LIGHT_ENTRIES 18
#define TEXTURE_UNIT_TRANSPARENT_DEPTH 20
#define TEXTURE_UNIT_CULL_LIGHTS 21
#define TEXTURE_UNIT_LIGHT_REACH 22
#define TEXTURE_UNIT_MATERIALS 23
#define TEXTURE_UNIT_SAMPLES 15 // no pass reads samples and radiance

// Image units.
#define IMAGE_UNIT_RADIANCE 0

SHARED_END
