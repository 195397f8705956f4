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

/// The same with materials that are constant over a surface: of its textures it keeps normal maps, and no vertex
/// colours and no anisotropy.
scenes::Scene evenScene();

/// The same of metal alone, but for its masked card and its two panes of glass. Its shaders know one lobe and compile
/// in a fraction of the time: for what does not depend on the lobes of a surface.
scenes::Scene metalScene();

/// The same in Lambert materials that keep their colour, opacity and its texture: for tests of which lights, or which
/// casters, a pixel has, whose subject is no model. Its shaders take a fraction of the time to compile.
scenes::Scene lambertScene();

/// The scene with one of everything that nothing draws: materials, pictures and meshes of everythingScene() in front of
/// its own, so that those have other numbers; behind them colours above 1, masking by the half vector, these materials
/// on a mesh without triangles, and cameras.
scenes::Scene withUnusedOfEverything(scenes::Scene scene);

/// For sweeps over scenes whose subject is not spread light: an atlas of 64 texels a side, for speed.
frame::DiffusionSettings coarseDiffusion();

/// The same for sweeps whose subject is not the number of lights: a built-in scene, of 256 lights or more only 100
/// unless the sweep is a whole one (Sweep.h).
scenes::Scene builtinForSweep(const scenes::BuiltinScene& builtin, scenes::LoadOptions options = {});

/// The built-in scenes that a sweep goes through: all in a whole one, else three. Of all threes theirs leave out the
/// fewest of the features that some built-in scene has, and everythingScene() and the suites of lights have those.
std::vector<scenes::BuiltinScene> builtinsForSweep();
bool isTakenBySweep(const scenes::BuiltinScene& builtin); ///< whether it is one of these three
/// The features that those three lack; tests/unit/engine/sweep_scenes.cpp proves that there is no other.
std::span<const frame::Feature> featuresThatNoBuiltinForSweepHas();

/// 2 x 2 m in the plane z = 0 facing +z, its picture upright: u grows along x, v (down) along -y.
scenes::Mesh quad();

/// One quad of 2 x 2 m in the plane z = 0 facing +z, lit by nothing, seen by a camera at (0, 0, 3) that it fills.
scenes::Scene quadScene(const scenes::Material& material);

/// A model's file, seen whole in a picture of that width over height, in the light that it brings; without any under a
/// sun that casts shadows, from above the eye's shoulder.
scenes::Scene modelUnderSun(const std::filesystem::path& file, double aspect);

/// A point light without range.
scenes::Light pointLight(const glm::dvec3& positionWS, float candela);

} // namespace tessera::test
