#pragma once
// Binding points for C++ and GLSL; these numbers are defined nowhere else.
#include "interop.h"

SHARED_BEGIN

// Vertex attributes. The first group advances per vertex, the second per draw (baseInstance selects the draw).
#define ATTRIBUTE_POSITION 0
#define ATTRIBUTE_NORMAL 1
#define ATTRIBUTE_TANGENT 2
#define ATTRIBUTE_TEXCOORD0 3
#define ATTRIBUTE_TEXCOORD1 4
#define ATTRIBUTE_COLOR 5
#define ATTRIBUTE_FACET_NORMAL 12
#define ATTRIBUTE_DRAW_POSITION_ROW0 6
#define ATTRIBUTE_DRAW_NORMAL_ROW0 9

// Uniform blocks.
#define UNIFORM_VIEW 0
#define UNIFORM_MATERIAL 1
#define UNIFORM_PASS 2 // constants of the pass that runs
#define UNIFORM_LIGHTS 3
#define UNIFORM_LIGHT_SHAPES 4
#define UNIFORM_LIGHTING 5
#define UNIFORM_CASTER_TREE 6
#define UNIFORM_SUBSURFACE 7
#define UNIFORM_ENVIRONMENT 8
#define UNIFORM_HOOK 9

// Storage blocks. OpenGL 4.5 guarantees 0 to 7 to fragment and compute shaders; shaders that build light
// lists never read lights from storage blocks.
#define STORAGE_LIGHT_TILES 0
#define STORAGE_LIGHT_CELLS 1
#define STORAGE_LIGHT_ENTRIES 2
#define STORAGE_LIGHT_REACH 3
#define STORAGE_TILE_DEPTHS 4
#define STORAGE_TILE_COUNTS 5
#define STORAGE_LIST_TOTALS 6
#define STORAGE_LIGHT_SHAPES 6
#define STORAGE_LIGHTS 7
#define STORAGE_HOOK_REST 0 // of passes/hook_vertices.comp
#define STORAGE_HOOK_MOVED 1
#define STORAGE_HOOK_POINTS 0 // of passes/hook_surfaces.comp, for the reference
#define STORAGE_HOOK_SURFACES 1

// Texture units. OpenGL 4.5 guarantees 16 per stage and 80 in all; drivers allow 32 per stage. A frame whose programs
// would exceed the driver's limit omits some material textures (renderer/frame/TextureRoom.h). Textures that no program
// samples together share a unit.
#define TEXTURE_UNITS_A_STAGE 32
#define TEXTURE_UNITS_GUARANTEED 16
#define TEXTURE_UNITS_IN_ALL 80

// Lighting, forward and deferred. Tiles and cells of light lists are storage blocks, since a pixel reads one of each,
// whereas it reads lights and entries in a loop. Deferred has a unit left for the tiles.
#define TEXTURE_UNIT_LIGHTS 18
#define TEXTURE_UNIT_SHADOWS 19
#define TEXTURE_UNIT_LIGHT_ENTRIES 20
#define TEXTURE_UNIT_ENVIRONMENT 21
#define TEXTURE_UNIT_ENVIRONMENT_SAMPLES 22
#define TEXTURE_UNIT_ENVIRONMENT_FILTERED 23
#define TEXTURE_UNIT_LOBES 24
#define TEXTURE_UNIT_LOBE_SHAPES 25
#define TEXTURE_UNIT_LIGHT_PICTURES 26

// Refraction: the image of opaque surfaces, its coarser levels and its depths; the back faces of glass bodies.
#define TEXTURE_UNIT_BEHIND 27
#define TEXTURE_UNIT_BEHIND_LEVELS 28
#define TEXTURE_UNIT_BEHIND_DEPTH 29
#define TEXTURE_UNIT_FAR_SIDES 30

// Materials: the slots of scenes::TextureSlot, whose numbers TEXTURE_SLOT_<NAME> follow from its table
// (renderer/frame/FeatureDefines.cpp).
#define TEXTURE_SLOT_COUNT 18

// Passes that read the G-buffer and images.
#define TEXTURE_UNIT_GBUFFER 0 // to 7
#define TEXTURE_UNIT_DEPTH 8
#define TEXTURE_UNIT_MATERIALS 9
#define TEXTURE_UNIT_RADIANCE 10
#define TEXTURE_UNIT_SAMPLES 11
#define TEXTURE_UNIT_LIGHT_TILES 12

// The pass that draws area lights, besides the depths.
#define TEXTURE_UNIT_SEEN_LIGHTS 9

// Passes that build light lists, besides the depths.
#define TEXTURE_UNIT_TRANSPARENT_DEPTH 9
#define TEXTURE_UNIT_CULL_LIGHTS 10
#define TEXTURE_UNIT_LIGHT_REACH 11

// Image units.
#define IMAGE_UNIT_RADIANCE 0
#define IMAGE_UNIT_DIFFUSED_LIGHT 1

#ifdef __cplusplus
static_assert(TEXTURE_SLOT_COUNT <= TEXTURE_UNIT_LIGHTS, "lights would hide a material's texture");
static_assert(TEXTURE_UNIT_GBUFFER + 8 <= TEXTURE_UNIT_DEPTH && TEXTURE_UNIT_LIGHT_TILES < TEXTURE_UNIT_LIGHTS,
              "a pass that lights stored surfaces samples them and lights");
static_assert(TEXTURE_UNIT_FAR_SIDES < TEXTURE_UNITS_A_STAGE, "more than drivers let a stage sample");
static_assert(TEXTURE_UNITS_A_STAGE < TEXTURE_UNITS_IN_ALL, "more than OpenGL 4.5 guarantees all stages");
#endif

SHARED_END
