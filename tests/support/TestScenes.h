#pragma once
#include <filesystem>
#include <span>
#include <vector>

#include "renderer/frame/Features.h"
#include "renderer/frame/FrameSettings.h"
#include "scenes/Load.h"
#include "scenes/Scene.h"

namespace tessera::test {

/// A small scene that uses every feature there is: all shaded models, textures in every slot, both normal-map spaces,
/// two texture-coordinate sets, texture transforms, vertex colours, alpha mask and blend, double-sided and mirrored
/// geometry, emission, every light type and falloff. The camera looks at a grid of quads and spheres in front of a
/// floor.
scenes::Scene everythingScene();

/// The same with constant materials: it keeps the normal maps, but no other textures, no vertex colours and no
/// anisotropy.
scenes::Scene evenScene();

/// The same in one metal, except for its masked card and its two panes of glass. Its shaders have one lobe and compile
/// in a fraction of the time: for tests that do not depend on a surface's lobes.
scenes::Scene metalScene();

/// The same in Lambert materials that keep their colour, opacity and its texture: for tests of which lights or casters
/// affect a pixel, not of a material model. Its shaders take a fraction of the time to compile.
scenes::Scene lambertScene();

/// Adds one of everything that nothing draws: materials, images and meshes of everythingScene() in front of the
/// scene's, which get other indices; behind them colours above 1, masking by the half vector, these materials on a mesh
/// without triangles, and cameras.
scenes::Scene withUnusedOfEverything(scenes::Scene scene);

/// For sweeps over scenes that do not test diffusion: an atlas of 64 texels a side, for speed.
frame::DiffusionSettings coarseDiffusion();

/// Loads a built-in scene for sweeps that do not test the number of lights: one of 256 lights or more gets only 100,
/// unless the sweep is whole (Sweep.h).
scenes::Scene builtinForSweep(const scenes::BuiltinScene& builtin, scenes::LoadOptions options = {});

/// The built-in scenes that a sweep covers: all in a whole sweep, else three. Of all threes, these leave out the fewest
/// features of the built-in scenes; everythingScene() and the suites of lights have those features.
std::vector<scenes::BuiltinScene> builtinsForSweep();
bool isTakenBySweep(const scenes::BuiltinScene& builtin); ///< whether it is one of these three
/// The features that those three lack; tests/unit/engine/sweep_scenes.cpp proves that the list is complete.
std::span<const frame::Feature> featuresThatNoBuiltinForSweepHas();

/// A quad of 2 x 2 m in the plane z = 0 facing +z. u grows along x, v (down) along -y.
scenes::Mesh quad();

/// A quad of 2 x 2 m in the plane z = 0 facing +z, without lights. It fills the view of a camera at (0, 0, 3).
scenes::Scene quadScene(const scenes::Material& material);

/// Loads a model, framed whole for the given aspect ratio, with its lights; a model without lights gets a sun that
/// casts shadows, from above the viewer's shoulder.
scenes::Scene modelUnderSun(const std::filesystem::path& file, double aspect);

/// A point light of infinite range.
scenes::Light pointLight(const glm::dvec3& positionWS, float candela);

} // namespace tessera::test
