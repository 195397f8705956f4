#pragma once
#include "scenes/Load.h"
#include "scenes/LoadLedger.h"

/// The built-in scenes, one function each; builtinScenes() lists them. All are the same on every machine. The ledger is
/// charged for the files that they read.
namespace tessera::scenes::builtin {

/// A colonnaded hall; `lights` point lights (256 by default, weaker where there are more) and one directional.
Scene makeHall(const LoadOptions& options, LoadLedger& ledger);
/// Spheres in rows of growing metalness and columns of growing roughness.
Scene makeSpheres(const LoadOptions& options, LoadLedger& ledger);
/// Every material model and layer, with and without textures, on three steps.
Scene makeModels(const LoadOptions& options, LoadLedger& ledger);
/// The benchmark scene: 256 spheres and boxes, `lights` point lights (256 by default), every number specified.
Scene makeLattice(const LoadOptions& options, LoadLedger& ledger);
/// A closed room whose radiance is known in closed form (Room.h); `lights` lights share the position and intensity of
/// the one lamp.
Scene makeRoom(const LoadOptions& options, LoadLedger& ledger);
/// Soft shadows whose visible fractions of light are known in closed form (ShadowTruth.h).
Scene makeShadowTruth(const LoadOptions& options, LoadLedger& ledger);
Scene makeHeadSkin(const LoadOptions& options, LoadLedger& ledger);
Scene makeHeadMarble(const LoadOptions& options, LoadLedger& ledger);
Scene makeDiffusionTruth(const LoadOptions& options, LoadLedger& ledger);
/// A reading hall at night; `lights` rectangles (1000 by default, weaker where there are more).
Scene makeLamps(const LoadOptions& options, LoadLedger& ledger);
/// Seven materials before a paper sweep, lit by lights of every shape.
Scene makeProductStudio(const LoadOptions& options, LoadLedger& ledger);
/// Bottles, tumblers, a prism and coloured panes on a table in the studio (docs/glass.md).
Scene makeGlass(const LoadOptions& options, LoadLedger& ledger);
/// A bust with an object-space normal map; a scanned head where TESSERA_ASSETS holds one and `useAssets` is set.
Scene makeHead(const LoadOptions& options, LoadLedger& ledger);

} // namespace tessera::scenes::builtin
