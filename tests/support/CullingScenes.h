#pragma once
#include <cstdint>

#include "scenes/Scene.h"

namespace tessera::test {

/// A random scene to try light culling on: a floor, boxes and cards, some of them transparent, seen by a perspective or
/// orthographic camera of random place, lens and depth range, and lit by lights of every kind, falloff, range and cone,
/// some of which hold the camera or lie behind it. The same for the same seed.
scenes::Scene randomLitScene(std::uint64_t seed);

/// The scene with four faint lights without end besides its own, one of each kind: all such scenes are drawn by the
/// same programs.
scenes::Scene withEveryKindOfLight(scenes::Scene scene);

/// The same picture, nearly, from so many times as far away: the eye stands back along its axis, a perspective lens is
/// the narrower, and the near and far planes stay where they are.
scenes::Camera seenFromAfar(scenes::Camera camera, double times);

/// Deep discontinuities of depth: two rows of columns and a curtain of leaf-like cards before a far wall, with `lights`
/// small lights in the room between.
scenes::Scene columnsBeforeWall(int lights);

/// A scene with `lights` white lights of that range, anywhere within its bounds, in place of its own, seen along its
/// longest horizontal side from within: a fifth of it from the one end, 30 % of its height up.
scenes::Scene litFromWithin(scenes::Scene scene, int lights, float rangeMetres);

} // namespace tessera::test
